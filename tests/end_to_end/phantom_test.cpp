// SPDX-License-Identifier: Apache-2.0
// The data sets of graphs/phantom, as a person makes them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "tests/end_to_end/command.h"

namespace {

using test::operator+;
using test::Ended;
using test::Words;
namespace fs = std::filesystem;

class Phantom : public test::CommandTest {
 protected:
  // Every file below a folder, by its relative path.
  std::map<std::string, std::string> files(const std::string& name) const {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder() / name))
      if (entry.is_regular_file())
        found[fs::relative(entry.path(), folder() / name).string()] = test::read_file(entry.path());
    return found;
  }
  // Runs a graph in a store of its own.
  Ended run_in(const std::string& store, const std::string& name, const Words& more) const {
    return wait(start(Words{"--store", path(store), "run", graph(name), "--quiet"} + more));
  }
};

TEST_F(Phantom, GraphsAreValid) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(graph("phantom"))) {
    if (entry.path().extension() != ".json" || test::read_file(entry.path()).find("\"facegraph\"") == std::string::npos)
      continue;
    const Ended ended = command({"validate", entry.path().string()});
    EXPECT_EQ(ended.code, 0) << entry.path() << "\n" << ended.output;
    ++count;
  }
  EXPECT_GE(count, 9);
}

TEST_F(Phantom, ScanStreamIsMadeAndIsTheSameForAnyNumberOfThreads) {
  const Words tiny = {"--set", "width_px=80", "--set", "height_px=60"};
  ASSERT_EQ(run_in("one", "phantom/scan_stream_tiny.json", tiny + Words{"--out", "one_out", "--threads", "1"}).code, 0);
  ASSERT_EQ(run_in("two", "phantom/scan_stream_tiny.json", tiny + Words{"--out", "two_out", "--threads", "3"}).code, 0);
  EXPECT_TRUE(files("one_out") == files("two_out"));
  std::vector<std::string> names;
  for (const auto& [name, bytes] : files("one_out")) names.push_back(name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"phones/1.json", "phones/2.json", "scans/1.mp4", "scans/2.mp4", "weights/1.csv",
                                      "weights/2.csv", "world_from_head/1.npy", "world_from_head/2.npy"}));
  const Ended other =
      run_in("one", "phantom/scan_stream_tiny.json", tiny + Words{"--out", "other_out", "--set", "seed=2"});
  ASSERT_EQ(other.code, 0);
  EXPECT_FALSE(files("one_out")["scans/1.mp4"] == files("other_out")["scans/1.mp4"]);
}

TEST_F(Phantom, LaserScansAreMadeOfEveryFaceAndPerson) {
  ASSERT_EQ(run_in("store", "phantom/laser_scans_tiny.json", {"--out", "out"}).code, 0);
  std::vector<std::string> names;
  for (const auto& [name, bytes] : files("out")) names.push_back(name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"expressions/teeth_1_closed.png", "expressions/viseme_01_rest.png",
                                      "expressions/viseme_02_aa.png", "people/1.png", "people/2.png", "people/3.png"}));
}

TEST_F(Phantom, VideoIsWithoutLossInFourTwoZeroAndItsFramesAreNotStored) {
  ASSERT_EQ(run_in("store", "phantom/video_tiny.json", {"--out", "out"}).code, 0);
  const std::string video = test::read_file(folder() / "out" / "video.mp4");
  ASSERT_GT(video.size(), 100000u);
  std::uintmax_t stored = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder() / "store"))
    if (entry.is_regular_file()) stored += entry.file_size();
  // The video, the person (a rig of some MB) and small things: 40 frames as blobs would be 2.3 MB more than this.
  EXPECT_LT(stored, video.size() + 9000000);
  const Ended again = run_in("store", "phantom/video_tiny.json", {"--out", "out", "--summary", path("summary.json")});
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(read("summary.json").find("\"run\": 0"), std::string::npos) << read("summary.json");
  // 68 landmarks, and 18 about the lips, for every frame, and a line of names.
  const auto lines = [&](const std::string& name) { return test::lines_of(read("out/" + name)).size() - 1; };
  const std::size_t frames = lines("weights.csv");
  EXPECT_GT(frames, 20u);
  EXPECT_EQ(lines("landmarks.csv"), 68 * frames);
  EXPECT_EQ(lines("lip_points.csv"), 18 * frames);
}

}  // namespace
