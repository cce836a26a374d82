// SPDX-License-Identifier: Apache-2.0
// Films with something wrong in them, through the whole of graphs/video_to_mesh/map.json.
#include "tests/end_to_end/odd_film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "tests/end_to_end/command.h"

namespace {

using test::Ended;
using test::Picture;
using test::Words;

class OddFilm : public test::CommandTest {
 protected:
  // A speaker and the points on the first frame. Pictures of 320 x 240 at 25 per second.
  std::vector<Picture> speaker() const {
    const Ended ended = command({"run", graph("phantom/video_tiny.json"), "--quiet", "--out", "speaker", "--set",
                                 "width_px=320", "--set", "height_px=240", "--set", "rate_hz=25"});
    EXPECT_EQ(ended.code, 0) << ended.output;
    std::string points;
    for (const auto& cells : table("speaker/lip_points.csv"))
      if (cells[0] == "0")
        points += (points.empty() ? "\"" : ", \"") + cells[1] + "\": [" + cells[2] + ", " + cells[3] + "]";
    write("points.json", "{\"image_size\": [320, 240], \"points\": {" + points + "}}");
    return test::pictures_of(path("speaker/video.mp4"));
  }

  // The cells of a table without its head.
  std::vector<std::vector<std::string>> table(const std::string& name) const {
    std::vector<std::vector<std::string>> rows;
    for (const std::string& line : test::lines_of(read(name))) {
      rows.emplace_back();
      std::istringstream in(line);
      for (std::string cell; std::getline(in, cell, ',');) rows.back().push_back(cell);
    }
    if (!rows.empty()) rows.erase(rows.begin());
    return rows;
  }

  // How many points of every frame are valid, and whether it has a mesh.
  std::map<int, int> seen_points() const {
    std::map<int, int> seen;
    for (const auto& cells : table("out/tracks.csv")) seen[std::stoi(cells[0])] += cells.at(4) == "1" ? 1 : 0;
    return seen;
  }
  std::map<int, bool> meshes() const {
    std::map<int, bool> there;
    for (const auto& cells : table("out/frames.csv")) there[std::stoi(cells[0])] = cells.at(3) == "1";
    return there;
  }

  // map.json without its pictures, and with a table of the frames that have a mesh.
  Ended map(const std::string& film, const std::string& points) const {
    write("map.json", "{\"facegraph\": 1, \"extends\": \"" + graph("video_to_mesh/map.json") + R"(", "nodes": {
      "same": {"node": "evaluate.mesh_error", "inputs": {"rig": "head", "points": "model.points", "truth": "model.points"}},
      "frames": {"node": "export.table", "inputs": {"table": "same.frames"}}},
      "outputs": {"compare.mp4": null, "key_shapes.png": null, "frames.csv": "frames"}})");
    return command(
        {"run", "map.json", "--quiet", "--out", "out", "--set", "video=" + film, "--set", "points=" + points});
  }
};

bool says(const std::vector<std::string>& lines, const std::string& text) {
  return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) { return line.find(text) != line.npos; });
}

TEST_F(OddFilm, FramesThatShowNoFaceAreNamedAndTheRestIsMapped) {
  const std::vector<Picture> all = speaker();
  ASSERT_GT(all.size(), 20u);
  constexpr int frames = 66, black = 8, cut = 16, slow = 22, leaves = 36, back = 60;
  std::vector<Picture> film;
  std::vector<std::int64_t> times_ms;
  for (int i = 0; i < frames; ++i) {
    const auto n = static_cast<int>(all.size()), turn = i % (2 * n);
    const Picture& face = all[static_cast<std::size_t>(turn < n ? turn : 2 * n - 1 - turn)];
    const int away_px = std::clamp(20 * std::min(i - leaves, back - i), 0, 220);
    if (i == black)
      film.push_back(test::painted(face, [](int plane, int, int) { return plane == 0 ? 16 : 128; }));
    else if (i == cut)
      film.push_back(test::painted(
          face, [](int plane, int x, int y) { return plane == 0 ? 40 + (x * 7 + y * 13 + x * y) % 170 : 128; }));
    else
      film.push_back(away_px == 0 ? face : test::moved(face, away_px));
    times_ms.push_back(40 * i + (i > slow ? 80 : 0));
  }
  test::write_film(path("odd.mkv"), film, times_ms);

  const Ended ended = map("odd.mkv", "points.json");
  ASSERT_EQ(ended.code, 0) << ended.output;
  for (const char* text : {"frame 8: nothing to see: black, white or one colour",
                           "frame 16: a cut: another picture than in the frame before",
                           "frame 22: shown for 120 ms, most for 40 ms: the frame rate varies"})
    EXPECT_TRUE(says(ended.warnings(), text)) << text << "\n" << ended.output;
  EXPECT_TRUE(says(ended.warnings(), "the face is not seen")) << ended.output;
  EXPECT_NE(read("out/report.txt").find("frame 22: shown for 120 ms"), std::string::npos);

  const std::map<int, int> seen = seen_points();
  const std::map<int, bool> mesh = meshes();
  ASSERT_EQ(seen.size(), static_cast<std::size_t>(frames));
  ASSERT_EQ(mesh.size(), static_cast<std::size_t>(frames));
  for (const int gone : {black, cut, 47, 48, 49}) {
    EXPECT_EQ(seen.at(gone), 0) << "frame " << gone;
    EXPECT_FALSE(mesh.at(gone)) << "frame " << gone;
  }
  for (int i = 0; i < frames; ++i) {
    if (i == black || i == cut || (i >= leaves && i <= back + 1)) continue;
    EXPECT_GE(seen.at(i), 15) << "frame " << i;
    EXPECT_TRUE(mesh.at(i)) << "frame " << i;
  }
  EXPECT_GT(read("out/head.glb").size(), 100000u);  // lost frames keep the face before
}

TEST_F(OddFilm, PointsThatAreMissingOrOutsideThePictureAreNamed) {
  const std::vector<Picture> all = speaker();
  ASSERT_GT(all.size(), 3u);
  test::write_film(path("short.mkv"), {all[0], all[1], all[2]}, {0, 40, 80});
  std::string points = read("points.json");
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = points;
    return text.replace(text.find(from), from.size(), to);
  };
  write("named.json", replaced("lip_9", "lip_nine"));
  Ended ended = map("short.mkv", "named.json");
  EXPECT_EQ(ended.code, 1);
  EXPECT_TRUE(says(ended.failures(), "lip_9")) << ended.output;

  const std::string chin = points.substr(points.find("\"chin\": ["),
                                         points.find(']', points.find("\"chin\"")) + 1 - points.find("\"chin\": ["));
  write("far.json", replaced(chin, "\"chin\": [160, 250]"));
  ended = map("short.mkv", "far.json");
  EXPECT_EQ(ended.code, 1);
  EXPECT_TRUE(says(ended.failures(), "/points/chin: found (160, 250), expected a point inside the image of 320 x 240"))
      << ended.output;
}

}  // namespace
