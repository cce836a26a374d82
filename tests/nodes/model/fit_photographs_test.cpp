// SPDX-License-Identifier: Apache-2.0
// Fits of the real material's first frames: no truth, but mouths that anybody sees to be shut or open.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "nodes/base/random.h"
#include "nodes/decode/read_identity_modes.h"
#include "nodes/decode/read_landmarks.h"
#include "nodes/decode/read_rig.h"
#include "nodes/decode/read_video.h"
#include "nodes/model/fit_image.h"
#include "nodes/model/from_rig.h"
#include "tests/nodes/model/quiet_fit.h"
#include "tests/support/data.h"
#include "tests/support/folder_file.h"

namespace face::model {
namespace {

const MorphableModel& model_of(const std::string& folder) {
  static const MorphableModel model = [&] {
    const engine::File file = test::folder_file(folder);
    const ShapeSet persons = decode::read_identity_modes(file);
    return from_rig(decode::read_rig(file, nullptr), &persons, {.albedos = 40, .samples = 200, .skins = 40});
  }();
  return model;
}

Image first_frame(const std::string& video) {
  Image first;
  engine::SeqWriter<Image> writer([&](const std::string& id, Image image) {
    if (id == "0") first = std::move(image);
  });
  engine::Progress progress;
  decode::read_video(engine::File::at(video), writer, progress);
  return first;
}

double size_of(const std::vector<float>& coefficients) {
  double squares = 0;
  for (const float c : coefficients) squares += static_cast<double>(c) * static_cast<double>(c);
  return std::sqrt(squares / static_cast<double>(coefficients.size()));
}

#define CLIP(name)                                  \
  DATA_FILE(folder, "ict-face/FaceXModel");         \
  DATA_FILE(video, "grid/" name ".mpg");            \
  DATA_FILE(marks, "grid/" name ".landmarks.json"); \
  const MorphableModel& model = model_of(folder);   \
  const Image picture = first_frame(video);         \
  const Landmarks points = decode::read_landmarks(engine::File::at(marks)).landmarks

TEST(FitPhotographs, FindAShutMouthShut) {
  CLIP("bbaf2n");
  const FaceFit fit = fit_image(model, picture, points);
  EXPECT_TRUE(fit.converged) << fit.problem;
  EXPECT_LT(fit.landmark_nme, 0.04);
  EXPECT_LT(std::abs(fit.lip_gap_mm), 0.5);
}

TEST(FitPhotographs, FindLipsApartWhereTeethShow) {
  CLIP("brbk7n");  // about 4 mm, counted in pixels
  const FaceFit fit = fit_image(model, picture, points);
  EXPECT_TRUE(fit.converged) << fit.problem;
  EXPECT_LT(fit.landmark_nme, 0.04);
  EXPECT_GT(fit.lip_gap_mm, 1.5);
  EXPECT_LT(fit.lip_gap_mm, 6);
}

TEST(FitPhotographs, DoNotBendTheHeadWhereThePictureIsDark) {
  CLIP("pwij3p");
  Image dark = picture;
  for (std::uint8_t& value : dark.pixels) value = static_cast<std::uint8_t>(0.45 * value);
  const FaceFit fit = fit_image(model, dark, points);
  EXPECT_TRUE(fit.converged) << fit.problem;
  EXPECT_LT(fit.landmark_nme, 0.04);
  double sigmas = 0;
  for (const float s : model.identity.sigmas) sigmas += static_cast<double>(s);
  sigmas /= static_cast<double>(model.identity.sigmas.size());
  EXPECT_LT(size_of(fit.identity) / sigmas, 0.9);  // in standard deviations; 1.2 before pictures' brightness counted
  EXPECT_LT(std::abs(fit.lip_gap_mm), 0.5);
}

// A picture with a gamma curve and with noise of so many levels.
Image spoilt(const Image& picture, double exponent, double noise) {
  Image result = picture;
  Random random(1);
  for (std::uint8_t& value : result.pixels)
    value = static_cast<std::uint8_t>(
        std::clamp(255 * std::pow(value / 255.0, exponent) + noise * random.normal(), 0.0, 255.0));
  return result;
}

// Dark pictures full of noise are fitted by their points all but alone: light and skin come out wrong, not the place.
TEST(FitPhotographs, BelieveAFaceThatIsDarkAndNoisy) {
  CLIP("bbaf2n");
  const FaceFit fit = fit_image(model, spoilt(picture, 2, 25), points);
  EXPECT_TRUE(fit.converged) << fit.problem;  // likeness 0.36, of the drawn fit's edges before 0.01 of 0.15
}

TEST(FitPhotographs, BelieveAFaceInMuchNoise) {
  CLIP("pwij3p");
  const FaceFit fit = fit_image(model, spoilt(picture, 1, 25), points);
  EXPECT_TRUE(fit.converged) << fit.problem;
}

// Like ink on paper: 0.26 of the scale is nothing that light and skin explain, but points and features agree.
TEST(FitPhotographs, BelieveAFaceInHardContrast) {
  CLIP("brbk7n");
  Image hard = picture;
  for (std::size_t i = 0; i < hard.pixels.size(); i += 3) {
    const int grey = (hard.pixels[i] + hard.pixels[i + 1] + hard.pixels[i + 2]) / 3;
    const auto ink = static_cast<std::uint8_t>(std::clamp(5 * (grey - 150) + 128, 0, 255));
    std::fill_n(&hard.pixels[i], 3, ink);
  }
  const FaceFit fit = fit_image(model, hard, points);
  EXPECT_TRUE(fit.converged) << fit.problem;
  EXPECT_LT(fit.landmark_nme, 0.04);
  EXPECT_GT(fit.image_rms, 0.18);  // refused before
}

// Skin at the points' middle, but no eyes where eyes should be.
TEST(FitPhotographs, DoNotBelieveAFaceOfAnotherSize) {
  CLIP("lrwp9a");
  Landmarks smaller = points;
  double x = 0, y = 0;
  for (const Landmark& point : points.points) {
    x += point.x_px / static_cast<double>(points.points.size());
    y += point.y_px / static_cast<double>(points.points.size());
  }
  for (Landmark& point : smaller.points) {
    point.x_px = x + 0.6 * (point.x_px - x);
    point.y_px = y + 0.6 * (point.y_px - y);
  }
  const FaceFit fit = fit_image(model, picture, smaller);
  EXPECT_FALSE(fit.converged);  // 0.08
  EXPECT_TRUE(fit.problem.starts_with("what is at the points does not look like a face (likeness ")) << fit.problem;
}

TEST(FitPhotographs, DoNotBelieveAFaceUpsideDown) {
  CLIP("swwp2s");
  Image turned = picture;
  for (std::size_t i = 0, n = picture.pixels.size() / 3; i < n; ++i)
    std::copy_n(&picture.pixels[3 * (n - 1 - i)], 3, &turned.pixels[3 * i]);
  Landmarks moved = points;  // to the middle of the turned face
  double x = 0, y = 0;
  for (const Landmark& point : points.points) {
    x += point.x_px / static_cast<double>(points.points.size());
    y += point.y_px / static_cast<double>(points.points.size());
  }
  for (Landmark& point : moved.points) {
    point.x_px += picture.width - 1 - 2 * x;
    point.y_px += picture.height - 1 - 2 * y;
  }
  const FaceFit fit = fit_image(model, turned, moved);
  EXPECT_FALSE(fit.converged);  // 0.24
  EXPECT_TRUE(fit.problem.starts_with("what is at the points does not look like a face (likeness ")) << fit.problem;
}

// A smile with teeth, of which 7 points tell nothing: a mouth that is taken as closed has to be tried open.
TEST(FitPhotographs, OpenASmileThatNoPointMarks) {
  DATA_FILE(folder, "ict-face/FaceXModel");
  DATA_FILE(portrait, "portraits/astronaut.png");
  const MorphableModel& model = model_of(folder);
  const std::string marks = std::string(FACEGRAPH_SOURCE_DIR) + "/graphs/laser_scan/astronaut.landmarks.json";
  Landmarks points = decode::read_landmarks(engine::File::at(marks)).landmarks;
  const std::set<std::string> few = {"eye_outer_r",    "eye_outer_l", "nose_tip", "mouth_corner_r",
                                     "mouth_corner_l", "chin",        "lower_lip"};
  std::erase_if(points.points, [&](const Landmark& point) { return !few.contains(point.name); });
  ASSERT_EQ(points.points.size(), 7u);
  const FaceFit fit = fit_image(model, first_frame(portrait), points);
  EXPECT_TRUE(fit.converged) << fit.problem;
  EXPECT_GT(fit.lip_gap_mm, 3);  // 7.4 with all points; shut before
  EXPECT_LT(fit.lip_gap_mm, 10);
}

}  // namespace
}  // namespace face::model
