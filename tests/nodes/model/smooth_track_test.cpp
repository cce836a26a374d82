// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/smooth_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "nodes/base/random.h"
#include "tests/nodes/model/material.h"

namespace face::model {
namespace {

std::vector<double> second_differences(const std::vector<double>& path) {
  std::vector<double> result;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) result.push_back(path[i - 1] - 2 * path[i] + path[i + 1]);
  return result;
}

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// Frames of a head that sways from side to side by 8 degrees.
std::vector<double> swaying(std::size_t frames) {
  std::vector<double> path;
  for (std::size_t f = 0; f < frames; ++f) path.push_back(8 * std::sin(0.05 * static_cast<double>(f)));
  return path;
}

std::vector<double> trembling(std::vector<double> path, double sigma) {
  Random random(3);
  for (double& value : path) value += sigma * random.normal();
  return path;
}

std::vector<double> smoothed(std::vector<double> path) {
  const std::vector<double> added = most_probable_correction(second_differences(path));
  for (std::size_t f = 0; f < path.size(); ++f) path[f] += added[f];
  return path;
}

std::vector<double> difference(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

TEST(MostProbableCorrection, TakesHalfOfTheTrembleOutOfASwayingHead) {
  const std::vector<double> path = swaying(150);
  EXPECT_NEAR(rms(difference(trembling(path, 0.1), path)), 0.1, 0.01);
  EXPECT_LT(rms(difference(smoothed(trembling(path, 0.1)), path)), 0.05);
}

TEST(MostProbableCorrection, LeavesWhatDoesNotTrembleAsItIs) {
  // The largest ratio is where accelerations are the only randomness there is: half a percent of 8 degrees.
  const std::vector<double> path = swaying(150);
  EXPECT_LT(rms(difference(smoothed(path), path)), 0.04);
  Random random(4);
  std::vector<double> jerky = {0, 0};
  while (jerky.size() < 150) jerky.push_back(2 * jerky.back() - jerky[jerky.size() - 2] + 0.1 * random.normal());
  EXPECT_LT(rms(difference(smoothed(jerky), jerky)), 0.03);
}

TEST(MostProbableCorrection, IsNothingForAHeadThatTurnsEvenly) {
  for (const double added : most_probable_correction(std::vector<double>(20, 0.0))) EXPECT_EQ(added, 0);
}

TEST(MostProbableCorrection, GrowsWithTheUnit) {
  std::vector<double> values = second_differences(trembling(swaying(60), 0.1));
  const std::vector<double> once = most_probable_correction(values);
  for (double& value : values) value *= 1000;
  const std::vector<double> grown = most_probable_correction(values);
  for (std::size_t f = 0; f < once.size(); ++f) EXPECT_NEAR(grown[f], 1000 * once[f], 1e-6);
}

// Fits of a head that sways and nods by what it trembles.
std::vector<FaceFit> track(std::size_t frames, double sigma_deg) {
  const std::vector<double> sway = swaying(frames), nod = trembling(std::vector<double>(frames, 0.0), sigma_deg);
  std::vector<FaceFit> fits(frames);
  constexpr double rad = std::numbers::pi / 180;
  for (std::size_t f = 0; f < frames; ++f) {
    fits[f].camera = camera_of(moved(test::pose_in_front(), {nod[f] * rad, sway[f] * rad, 0, 0, 0, 0, 0}));
    fits[f].converged = true;
    fits[f].expression = {static_cast<float>(f)};
  }
  return fits;
}

std::vector<FaceFit> smoothed(const std::vector<FaceFit>& fits, std::string* ids = nullptr,
                              std::vector<std::string>* warnings = nullptr) {
  struct Heard : engine::Progress {
    void warn(const std::string& text) override { texts.push_back(text); }
    std::vector<std::string> texts;
  } heard;
  std::vector<FaceFit> result;
  engine::SeqWriter<FaceFit> writer([&](const std::string& id, FaceFit fit) {
    if (ids != nullptr) *ids += id + " ";
    result.push_back(std::move(fit));
  });
  std::vector<std::string> names;
  for (std::size_t f = 0; f < fits.size(); ++f) names.push_back("f" + std::to_string(f));
  smooth_track(test::head_model(), engine::Seq<FaceFit>(fits, names), writer, heard);
  if (warnings != nullptr) *warnings = heard.texts;
  return result;
}

// How far each head nods, in degrees: its forehead comes down.
std::vector<double> nods(const std::vector<FaceFit>& fits) {
  std::vector<double> result;
  for (const FaceFit& fit : fits)
    result.push_back(std::asin(static_cast<double>(fit.camera.cam_from_world[7])) * 180 / std::numbers::pi);
  return result;
}

TEST(SmoothTrack, TakesMostOfANodThatTremblesOutOfAHeadThatSways) {
  const std::vector<FaceFit> fits = track(120, 0.1);
  EXPECT_GT(rms(nods(fits)), 0.08);
  EXPECT_LT(rms(nods(smoothed(fits))), 0.03);
}

// A clip whose face was lost was drawn over to its end without a word.
TEST(SmoothTrack, NamesTheFramesThatAreNotBelieved) {
  std::vector<FaceFit> fits = track(9, 0.1);
  for (const std::size_t f : {2, 5, 6, 7}) {
    fits[f].converged = false;
    fits[f].problem = "the face is lost here, " + std::to_string(f);
  }
  std::vector<std::string> warnings;
  EXPECT_EQ(smoothed(fits, nullptr, &warnings).size(), 9u);
  EXPECT_EQ(warnings, (std::vector<std::string>{"frame f2 is not believed: the face is lost here, 2",
                                                "frames f5 to f7 are not believed: the face is lost here, 5"}));
}

TEST(SmoothTrack, KeepsTheMiddleOfTheFaceWhereItIsInThePicture) {
  const std::vector<FaceFit> fits = track(60, 0.1), after = smoothed(fits);
  ASSERT_EQ(after.size(), fits.size());
  for (std::size_t f = 0; f < fits.size(); ++f) {
    const Vec3f middle = turning_point(test::head_model());
    const FacePose a = pose_of(fits[f].camera, middle), b = pose_of(after[f].camera, middle);
    EXPECT_NEAR(a.u_px, b.u_px, 1e-3);  // a camera's numbers are floats
    EXPECT_NEAR(a.v_px, b.v_px, 1e-3);
    EXPECT_NEAR(a.log_scale, b.log_scale, 1e-5);
    EXPECT_EQ(fits[f].expression, after[f].expression);
  }
}

TEST(SmoothTrack, LeavesFramesThatAreNotBelievedAndShortStretchesAsTheyAre) {
  std::vector<FaceFit> fits = track(60, 0.1);
  fits[8].converged = fits[30].converged = false;
  std::string ids;
  const std::vector<FaceFit> after = smoothed(fits, &ids);
  ASSERT_EQ(after.size(), fits.size());
  EXPECT_EQ(ids.substr(0, 12), "f0 f1 f2 f3 ");
  for (std::size_t f = 0; f < fits.size(); ++f) {
    const bool kept = f <= 8 || f == 30;
    EXPECT_EQ(after[f].camera.cam_from_world == fits[f].camera.cam_from_world, kept) << f;
    EXPECT_EQ(after[f].converged, fits[f].converged);
  }
}

TEST(SmoothTrack, OfNoFrameIsNone) { EXPECT_TRUE(smoothed(std::vector<FaceFit>{}).empty()); }

}  // namespace
}  // namespace face::model
