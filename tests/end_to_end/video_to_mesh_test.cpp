// SPDX-License-Identifier: Apache-2.0
// The graphs of graphs/video_to_mesh, as a person runs them.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "tests/end_to_end/command.h"

namespace {

using test::operator+;
using test::Ended;
using test::Words;

class VideoToMesh : public test::CommandTest {
 protected:
  // The row `row` of a table that the graph wrote, by column.
  std::map<std::string, double> row(const std::string& name, const std::string& row) const {
    const std::vector<std::string> lines = test::lines_of(read(name));
    std::map<std::string, double> values;
    for (std::size_t i = 1; i < lines.size(); ++i) {
      std::istringstream columns(lines[0]), cells(lines[i]);
      std::string column, cell;
      std::getline(columns, column, ',');
      std::getline(cells, cell, ',');
      if (cell != row) continue;
      while (std::getline(columns, column, ','))
        if (std::getline(cells, cell, ',') && !cell.empty()) values[column] = std::stod(cell);
    }
    return values;
  }
};

TEST_F(VideoToMesh, FollowsThePhantomsLipsAndSaysSomethingNew) {
  const Ended ended = wait(start(
      {"--store", path("store"), "run", graph("video_to_mesh/phantom_tiny.json"), "--quiet", "--out", path("out")}));
  ASSERT_EQ(ended.code, 0) << ended.output;
  EXPECT_LT(row("out/track.csv", "all")["rms_px"], 1.5);
  EXPECT_GT(row("out/mapped.csv", "all")["lip_error_mm"], 0);
  EXPECT_LT(row("out/mapped.csv", "all")["mve_mm"], 1);
  EXPECT_GT(row("out/spoken_closures.csv", "own")["closure_percent"],
            row("out/plain_closures.csv", "own")["closure_percent"]);
  for (const char* film : {"compare.mp4", "talk.mp4"}) EXPECT_GT(read(std::string("out/") + film).size(), 10000u);
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
