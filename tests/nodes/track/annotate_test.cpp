// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/annotate.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::track;

namespace {

engine::Seq<Image> film(std::size_t count) {
  return engine::Seq<Image>(std::vector<Image>(count, Image{32, 24, 3, std::vector<std::uint8_t>(32 * 24 * 3, 120)}));
}

Landmarks nose(double x_px, bool valid) { return {{{"nose_tip", x_px, 9.04, valid}}}; }

nlohmann::json data_of(const engine::File& page) {
  const std::string text = page.bytes();
  const std::size_t head = annotate_page_head().size(), tail = annotate_page_tail().size();
  return nlohmann::json::parse(text.substr(head, text.size() - head - tail));
}

}  // namespace

TEST(Annotate, HoldsTheFramesThatWereAskedFor) {
  AnnotateOptions options;
  options.first_frame = 2;
  options.every = 3;
  options.max_frames = 3;
  const auto data = data_of(annotate(film(20), nullptr, nullptr, options));
  ASSERT_EQ(data["frames"].size(), 3u);
  EXPECT_EQ(data["frames"][0]["frame"], 2);
  EXPECT_EQ(data["frames"][2]["frame"], 8);
  EXPECT_EQ(data["image_size"], nlohmann::json({32, 24}));
  const std::string picture = data["frames"][0]["picture"];
  EXPECT_EQ(picture.substr(0, 27), "data:image/jpeg;base64,/9j/");  // FF D8 FF
}

TEST(Annotate, AsksForTheLayoutsPointsInItsOrder) {
  const auto data = data_of(annotate(film(1), nullptr, nullptr));
  ASSERT_EQ(data["points"].size(), 18u);
  EXPECT_EQ(data["points"][0]["name"], "eye_inner_r");
  EXPECT_EQ(data["points"][3]["name"], "lip_0");
  EXPECT_EQ(data["points"][17]["name"], "jaw_l");
  AnnotateOptions lips;
  lips.points = PointLayout::lips12;
  EXPECT_EQ(data_of(annotate(film(1), nullptr, nullptr, lips))["points"].size(), 12u);
}

TEST(Annotate, ShowsTracksAndKeepsEarlierCorrections) {
  const engine::Seq<Landmarks> tracks({nose(7.26, true), nose(8, false)}), fixes({nose(8.5, true)}, {"1"});
  const auto data = data_of(annotate(film(2), &tracks, &fixes));
  EXPECT_EQ(data["frames"][0]["points"]["nose_tip"], nlohmann::json({7.3, 9.0, 1}));
  EXPECT_EQ(data["frames"][1]["points"]["nose_tip"][2], 0);
  EXPECT_EQ(data["fixes"]["1"]["nose_tip"], nlohmann::json({8.5, 9.04}));
}

// Elements as a store gives them: of no use once nobody holds them.
struct Stored final : engine::SeqSource<Landmarks> {
  std::size_t size() const override { return 1; }
  std::string id(std::size_t) const override { return "0"; }
  std::shared_ptr<const Landmarks> load(std::size_t) const override {
    return {&kept, [this](const Landmarks*) { kept = nose(-1, false); }};
  }
  mutable Landmarks kept = nose(7.26, true);
};

// A second page of a clip whose tracks were in the store ended with "std::bad_alloc".
TEST(Annotate, ShowsTracksAndCorrectionsThatAreLoadedOneByOne) {
  const engine::Seq<Landmarks> tracks(std::make_shared<Stored>()), fixes(std::make_shared<Stored>());
  const auto data = data_of(annotate(film(1), &tracks, &fixes));
  EXPECT_EQ(data["frames"][0]["points"]["nose_tip"], nlohmann::json({7.3, 9.0, 1}));
  EXPECT_EQ(data["fixes"]["0"]["nose_tip"], nlohmann::json({7.26, 9.04}));
}

TEST(Annotate, NeedsNoNetwork) {
  const std::string page = annotate(film(1), nullptr, nullptr).bytes();
  EXPECT_NE(page.find("</html>"), std::string::npos);
  for (const char* word : {"http:", "https:", "//cdn", "src=\"", "@import", "fetch(", "url(", "<link", "import("})
    EXPECT_EQ(page.find(word), std::string::npos) << word;
}

// The page's first script in node, as a person would use it.
TEST(Annotate, ThePageWritesWhatTheDecodersRead) {
  if (std::system("node --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs node to run the page's script";
  const std::string head(annotate_page_head()), begin = "<script id=\"logic\">";
  const std::size_t from = head.find(begin) + begin.size(), to = head.find("</script>", from);
  const auto folder = std::filesystem::temp_directory_path() / ("annotate_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "page.js") << head.substr(from, to - from) << R"js(
const names = ["nose_tip", "lip_0"].map(name => ({name: name, hint: ""}));
const model = new Model({points: names, image_size: [32, 24], fixes: {"3": {"lip_0": [1, 2]}},
                         frames: [{frame: 0}, {frame: 5, points: {lip_0: [4, 5, 1]}}]});
const out = [];
out.push(model.next());
model.remember(); model.place(0, "nose_tip", [3.14159, 100]);
out.push(model.next());
model.remember(); model.place(0, "lip_0", [4.25, 5.5]);
out.push(model.next());
model.undo();
out.push(model.next());
model.place(0, "lip_0", [4.3, 5.5]);
out.push(model.find(model.data.frames[1], "lip_0").by, model.nearest(model.data.frames[1], [4.2, 5.1], 1));
model.place(5, "lip_0", [6, 7]); model.place(5, "nose_tip", [1, 1]); model.take_back(5, "nose_tip");
out.push(model.find(model.data.frames[1], "lip_0").by);
console.log(JSON.stringify([out, JSON.parse(model.points_json()), JSON.parse(model.fixes_json())]));
)js";
  const std::string result = (folder / "out.json").string();
  ASSERT_EQ(std::system(("node " + (folder / "page.js").string() + " > " + result).c_str()), 0);
  std::ifstream file(result);
  EXPECT_EQ(nlohmann::json::parse(file), nlohmann::json::parse(R"([
    ["nose_tip", "lip_0", null, "lip_0", "track", "lip_0", "fix"],
    {"frame": 0, "image_size": [32, 24], "points": {"nose_tip": [3.1, 23.5], "lip_0": [4.3, 5.5]}},
    [{"frame": 3, "point": "lip_0", "xy": [1, 2]}, {"frame": 5, "point": "lip_0", "xy": [6, 7]}]])"));
  std::filesystem::remove_all(folder);
}

TEST(Annotate, RejectsAFirstFrameBehindTheEnd) {
  AnnotateOptions options;
  options.first_frame = 7;
  EXPECT_THROW_TEXT(annotate(film(5), nullptr, nullptr, options), "first_frame is 7, the clip has 5 frames");
}
