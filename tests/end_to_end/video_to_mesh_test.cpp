// SPDX-License-Identifier: Apache-2.0
// The graphs of graphs/video_to_mesh, as a person runs them.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/end_to_end/command.h"

namespace {

using test::operator+;
using test::Ended;
using test::Words;

class VideoToMesh : public test::CommandTest {
 protected:
  // Runs phantom_tiny.json; how many tasks of each node ran.
  std::map<std::string, int> run_tiny(const Words& more) const {
    const Ended ended = wait(start(Words{"--store", path("store"), "run", graph("video_to_mesh/phantom_tiny.json"),
                                         "--quiet", "--out", path("out"), "--events", path("events.ndjson")} +
                                   more));
    EXPECT_EQ(ended.code, 0) << ended.output;
    std::map<std::string, int> ran;
    for (const std::string& line : test::lines_of(read("events.ndjson"))) {
      const auto event = nlohmann::json::parse(line);
      if (event["event"] == "finished") ++ran[event["node"]];
    }
    return ran;
  }
};

TEST_F(VideoToMesh, FollowsThePhantomsLipsAndSaysSomethingNew) {
  const auto first = run_tiny({});
  EXPECT_LT(test::row_of(read("out/track.csv"), "all").at("rms_px"), 1.5);
  EXPECT_LT(test::row_of(read("out/mapped.csv"), "all").at("lip_error_mm"), 2.5);  // 1.9
  EXPECT_LT(test::row_of(read("out/mapped.csv"), "all").at("mve_mm"), 1);
  EXPECT_EQ(test::row_of(read("out/spoken_closures.csv"), "own").at("closure_percent"), 100);
  for (const char* film : {"compare.mp4", "talk.mp4"}) EXPECT_GT(read(std::string("out/") + film).size(), 10000u);

  // Another lambda: both paths and what follows them, and what is not stored of that sentence; nothing of the clip.
  const int frames = first.at("meshes");
  std::map<std::string, int> most = {{"path", 1}, {"plain_path", 1}, {"new_true_points", 2 * frames}};
  for (const char* node : {"spoken_head", "spoken_score", "closures", "spoken_film", "spoken_csv", "closures_csv",
                           "plain_head", "plain_score", "plain_closures", "plain_csv", "plain_closures_csv"})
    most[node] = 1;
  for (const char* node : {"spoken_picture", "spoken_beside"}) most[node] = frames;
  for (const char* node : {"meshes", "plain_meshes"}) most[node] = 2 * frames;  // not stored, and read by two gathers
  const auto again = run_tiny({"--set", "smoothness=20"});
  for (const auto& [node, count] : again) EXPECT_LE(count, most.contains(node) ? most.at(node) : 0) << node;
  for (const char* node : {"path", "plain_path", "spoken_film"}) EXPECT_EQ(again.contains(node), true) << node;
  EXPECT_EQ(run_tiny({"--set", "smoothness=20"}), (std::map<std::string, int>()));
}

TEST_F(VideoToMesh, GraphsForARealClipAreValid) {
  write("clip.mpg", "");
  write("clip.json", R"({"image_size": [360, 288], "points": {"nose_tip": [157.5, 191.0]}})");
  for (const char* name : {"track", "map", "train", "speak"}) {
    const Ended ended = command({"validate", graph(std::string("video_to_mesh/") + name + ".json"), "--set",
                                 "video=" + path("clip.mpg"), "--set", "points=" + path("clip.json")});
    EXPECT_EQ(ended.code, 0) << name << "\n" << ended.output;
  }
}

}  // namespace
