// SPDX-License-Identifier: Apache-2.0
// Renders the faces that matter most and measures in the pictures what one would look for: light from the front, lips
// that meet, teeth and a dark red mouth behind open ones, eyes with irises and lids that hide them. On both heads.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/mouth.h"
#include "nodes/base/pose.h"
#include "nodes/decode/read_rig.h"
#include "nodes/phantom/make_head.h"
#include "nodes/render/render_head.h"
#include "nodes/types/arkit.h"
#include "tests/support/data.h"
#include "tests/support/folder_file.h"

namespace face::render {
namespace {

constexpr int size_px = 480;
using Pose = std::vector<std::pair<std::string, float>>;  // a name without Left or Right means both sides
using Rgb = std::array<int, 3>;
using Outline = std::vector<ScreenPoint>;

Weights weights_of(const Pose& pose) {
  Weights weights;
  weights.values.assign(arkit_count, 0.0f);
  for (const auto& [name, value] : pose)
    for (const char* side : {"", "Left", "Right"})
      if (const std::size_t shape = arkit_index(name + side); shape < arkit_count) weights.values[shape] = value;
  return weights;
}

int luminance(const Rgb& p) {
  return (54 * p[0] + 183 * p[1] + 19 * p[2]) / 256;
}  // Rec. 709, of codes: good to compare
bool is_skin(const Rgb& p) { return p[0] > 60 && p[0] > p[1] + 12 && p[1] >= p[2] - 2; }
// Bright and of little colour: teeth, or the white of an eye. Lips and skin have half as much blue as red.
bool is_white(const Rgb& p) {
  const auto [low, high] = std::minmax({p[0], p[1], p[2]});
  return high > 130 && high - low < 0.24 * high;
}
bool is_dark_red(const Rgb& p) { return p[0] < 175 && p[0] > 1.6 * p[1] && p[0] > 1.6 * p[2]; }

// A picture of a pose, and where the marks of the face are in it.
struct Shot {
  Image image;
  Camera camera;
  std::vector<Vec3f> points_mm;
  const Rig* rig;

  Shot(const Rig& head, const Pose& pose, double yaw_deg = 0) : rig(&head) {
    RenderHeadOptions options;
    options.width_px = options.height_px = size_px;
    options.framing = Framing::face;
    options.yaw_deg = yaw_deg;
    image = render_head(head, weights_of(pose), options);
    camera = head_camera(head, options);
    points_mm = pose_points(head, weights_of(pose));
  }

  Rgb at(int x, int y) const {
    if (x < 0 || y < 0 || x >= size_px || y >= size_px) return {0, 0, 0};
    const std::uint8_t* p = &image.pixels[static_cast<std::size_t>((y * size_px + x) * 3)];
    return {p[0], p[1], p[2]};
  }
  Vec3f mark_mm(std::size_t k) const { return points_mm[rig->landmarks68[k]]; }
  ScreenPoint mark(std::size_t k) const { return project(camera, mark_mm(k)); }
  Outline outline(std::size_t first, std::size_t last) const {
    Outline points;
    for (std::size_t k = first; k <= last; ++k) points.push_back(mark(k));
    return points;
  }
  // Mean over the 9 x 9 pixels about a point.
  double brightness_about(const Vec3f& point_mm) const {
    const ScreenPoint p = project(camera, point_mm);
    double sum = 0;
    for (int y = -4; y <= 4; ++y)
      for (int x = -4; x <= 4; ++x) sum += luminance(at(static_cast<int>(p.x_px) + x, static_cast<int>(p.y_px) + y));
    return sum / 81;
  }
  // The pixels inside an outline, by the even-odd rule.
  std::vector<Rgb> inside(const Outline& outline) const {
    std::vector<Rgb> pixels;
    for (int y = 0; y < size_px; ++y)
      for (int x = 0; x < size_px; ++x) {
        bool in = false;
        for (std::size_t i = 0; i < outline.size(); ++i) {
          const ScreenPoint &a = outline[i], &b = outline[(i + 1) % outline.size()];
          const auto row = static_cast<float>(y);
          if ((a.y_px > row) != (b.y_px > row) &&
              static_cast<float>(x) < a.x_px + (b.x_px - a.x_px) * (row - a.y_px) / (b.y_px - a.y_px))
            in = !in;
        }
        if (in) pixels.push_back(at(x, y));
      }
    return pixels;
  }
};

double share(const std::vector<Rgb>& pixels, const std::function<bool(const Rgb&)>& of) {
  return static_cast<double>(std::count_if(pixels.begin(), pixels.end(), of)) / static_cast<double>(pixels.size());
}

// Rows between the lips that are much darker than they are, the most in any of the columns about the middle.
int gap_rows(const Shot& shot) {
  const auto middle = static_cast<int>(shot.mark(51).x_px);
  const auto top = static_cast<int>(shot.mark(51).y_px), bottom = static_cast<int>(shot.mark(57).y_px);
  int most = 0;
  for (int x = middle - 12; x <= middle + 12; x += 4) {
    std::vector<int> column;
    for (int y = top; y <= bottom; ++y) column.push_back(luminance(shot.at(x, y)));
    std::vector<int> sorted = column;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 3 / 4), sorted.end());
    const int lips = sorted[sorted.size() * 3 / 4];
    most = std::max(
        most, static_cast<int>(std::count_if(column.begin(), column.end(), [&](int l) { return l < 0.4 * lips; })));
  }
  return most;
}

std::vector<Rgb> lips_and_between(const Shot& shot) { return shot.inside(shot.outline(48, 59)); }

// The pose of M with the mouthClose that brings the lips together, as the trajectory does it.
Pose lips_closed(const Rig& rig) {
  Pose pose = {{"jawOpen", 0.1f},
               {"mouthPress", 0.16f},
               {"mouthRollLower", 0.06f},
               {"mouthRollUpper", 0.05f},
               {"mouthClose", 0}};
  while (pose.back().second < 1 && lip_gap_mm(rig, pose_points(rig, weights_of(pose))) > 0)
    pose.back().second += 0.005f;
  return pose;
}

std::unique_ptr<Rig> ict_head(const std::string& folder) {
  return std::make_unique<Rig>(decode::read_rig(test::folder_file(folder), nullptr));
}

class KeyPictures : public testing::TestWithParam<const char*> {
 protected:
  static void TearDownTestSuite() { heads().clear(); }
  void SetUp() override {
    for (const auto& [name, head] : heads())
      if (name == GetParam()) head_ = head.get();
    if (head_) return;
    std::unique_ptr<Rig> head;
    if (GetParam() == std::string("Embedded")) {
      head = std::make_unique<Rig>(phantom::make_head());
    } else {
      DATA_FILE(folder, "ict-face/FaceXModel");
      head = ict_head(folder);
    }
    head_ = heads().emplace_back(GetParam(), std::move(head)).second.get();
  }
  const Rig& head() const { return *head_; }

 private:
  // Reading a head takes longer than a test.
  static std::vector<std::pair<std::string, std::unique_ptr<Rig>>>& heads() {
    static std::vector<std::pair<std::string, std::unique_ptr<Rig>>> kept;
    return kept;
  }
  const Rig* head_ = nullptr;
};

INSTANTIATE_TEST_SUITE_P(Heads, KeyPictures, testing::Values("Embedded", "Ict"),
                         [](const auto& head) { return std::string(head.param); });

TEST_P(KeyPictures, LightTheFaceFromTheFront) {
  const Shot shot(head(), {});
  // The two halves of the face, from brows to chin between the temples.
  Outline left, right;
  for (const std::size_t k : {0, 1, 2, 3, 4, 5, 6, 7, 8, 33, 27}) right.push_back(shot.mark(k));
  for (const std::size_t k : {16, 15, 14, 13, 12, 11, 10, 9, 8, 33, 27}) left.push_back(shot.mark(k));
  const auto mean = [](const std::vector<Rgb>& pixels) {
    double sum = 0;
    for (const Rgb& p : pixels) sum += luminance(p);
    return sum / static_cast<double>(pixels.size());
  };
  const double right_mean = mean(shot.inside(right)), left_mean = mean(shot.inside(left));
  EXPECT_GT(right_mean, left_mean);         // the key light comes from the picture's left...
  EXPECT_GT(left_mean, 0.75 * right_mean);  // ...and leaves no dark side
  EXPECT_GT(left_mean, 100);
  EXPECT_LT(right_mean, 215);
  Vec3f forehead = shot.mark_mm(27), under_chin = shot.mark_mm(8), nose = shot.mark_mm(30);
  forehead[1] += 25;
  under_chin[1] -= 6;
  EXPECT_GT(shot.brightness_about(forehead), 1.15 * shot.brightness_about(under_chin));
  EXPECT_GT(shot.brightness_about(nose), shot.brightness_about(under_chin));
}

TEST_P(KeyPictures, ShowTeethAndADarkRedMouthBehindOpenLips) {
  const Shot shot(head(), {{"jawOpen", 0.45f}, {"mouthUpperUp", 0.1f}, {"mouthLowerDown", 0.15f}});  // about AA
  const std::vector<Rgb> mouth = shot.inside(shot.outline(60, 67));
  ASSERT_GT(mouth.size(), 400u);
  EXPECT_GT(share(mouth, is_white), 0.02) << "no teeth";
  EXPECT_LT(share(mouth, is_white), 0.35);
  EXPECT_GT(share(mouth, is_dark_red), 0.6) << "no red mouth";
  EXPECT_EQ(share(mouth, [](const Rgb& p) { return p[0] < 12; }), 0) << "black in the mouth";
  // It is in shade: darker than the lips about it.
  double inside = 0;
  for (const Rgb& p : mouth) inside += luminance(p) / static_cast<double>(mouth.size());
  EXPECT_LT(inside, 0.8 * shot.brightness_about(shot.mark_mm(57)));
  EXPECT_GT(gap_rows(shot), 15);
}

TEST_P(KeyPictures, KeepTheShadeInTheMouthWarm) {
  for (const double yaw_deg : {-25.0, 0.0, 25.0}) {  // from the side the molars are seen
    const Shot shot(head(), {{"jawOpen", 0.4f}}, yaw_deg);
    for (const Rgb& p : shot.inside(shot.outline(60, 67))) {
      if (luminance(p) > 110) continue;
      ASSERT_GT(p[0], 1.1 * p[1]) << "green: " << p[0] << " " << p[1] << " " << p[2] << " at yaw " << yaw_deg;
      ASSERT_GE(p[1] + 6, p[2]) << "blue: " << p[0] << " " << p[1] << " " << p[2] << " at yaw " << yaw_deg;
    }
  }
}

TEST_P(KeyPictures, ShowLipsThatMeetAtM) {
  const Pose closed = lips_closed(head());
  const Shot shot(head(), closed), open(head(), {{"jawOpen", 0.15f}});
  EXPECT_LE(gap_rows(shot), 2);  // 0.7 mm
  EXPECT_GE(gap_rows(open), 4);
  EXPECT_LT(share(lips_and_between(shot), is_white), 0.002) << "teeth between closed lips";
  EXPECT_GT(share(lips_and_between(open), is_white), 0.02);
}

TEST_P(KeyPictures, ShowUpperTeethOnTheLowerLipAtF) {
  const Shot shot(head(), {{"jawOpen", 0.05f},
                           {"mouthRollLower", 0.3f},
                           {"mouthShrugLower", 0.1f},
                           {"mouthUpperUp", 0.22f},
                           {"mouthShrugUpper", 0.06f}});
  EXPECT_GT(share(lips_and_between(shot), is_white), 0.03) << "no teeth";
  EXPECT_LE(gap_rows(shot), 4) << "a gap between teeth and lower lip";
}

TEST_P(KeyPictures, ShowIrisesThatABlinkHides) {
  const Shot open(head(), {}), shut(head(), {{"eyeBlink", 1}});
  for (const std::size_t first : {std::size_t{36}, std::size_t{42}}) {
    const Outline eye = open.outline(first, first + 5);
    const std::vector<Rgb> seen = open.inside(eye), hidden = shut.inside(eye);
    ASSERT_GT(seen.size(), 200u);
    const auto is_iris = [](const Rgb& p) { return p[2] > p[0] + 8 || luminance(p) < 45; };
    EXPECT_GT(share(seen, is_iris), 0.2) << "no iris";
    EXPECT_GT(share(seen, is_white), 0.08) << "no white";
    // The pupil is dark, in the middle of the eye.
    ScreenPoint centre{0, 0, 0};
    for (const ScreenPoint& p : eye) {
      centre.x_px += p.x_px / 6;
      centre.y_px += p.y_px / 6;
    }
    int darkest = 255;
    for (int y = -4; y <= 4; ++y)
      for (int x = -4; x <= 4; ++x)
        darkest =
            std::min(darkest, luminance(open.at(static_cast<int>(centre.x_px) + x, static_cast<int>(centre.y_px) + y)));
    EXPECT_LT(darkest, 40) << "no pupil";
    EXPECT_EQ(share(hidden, [](const Rgb& p) { return p[2] > p[0]; }), 0) << "an iris through the lid";
    EXPECT_LT(share(hidden, is_white), 0.01) << "white through the lid";
    EXPECT_GT(share(hidden, is_skin), 0.75) << "no lid";
  }
}

}  // namespace
}  // namespace face::render
