// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/fit_joint.h"

#include <cmath>

#include "nodes/base/check.h"
#include "nodes/model/fit_landmarks.h"
#include "nodes/model/likeness.h"
#include "nodes/model/pose_model.h"
#include "nodes/model/robust_weights.h"

namespace face::model {
namespace {

constexpr double extreme_share = 0.45;
// Of likeness: docs/measured/morphable-model.md says what right and wrong places come to.
constexpr double least_likeness = 0.26;
// Noise, a hard contrast and a painted look are nothing that light and skin explain. Where the place certainly looks
// like a face, and the points agree, they are believed up to `hard_look` times the difference: a posterised or inked
// face is 0.15 to 0.4 off, and of 130 wrong places none that looks like a face was kept out by the difference.
constexpr double sure_likeness = 0.4, hard_look = 4;

}  // namespace

std::vector<double> mean_gap_row(const Joint& joint) {
  std::vector<double> mean(joint.basis.expressions, 0.0);
  for (const std::vector<double>& row : joint.gaps)
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += row[k] / static_cast<double>(joint.gaps.size());
  return mean;
}

double gap_of(const Joint& joint, std::size_t index) {
  const std::vector<double> mean = mean_gap_row(joint);
  double gap = 0;
  for (std::size_t k = 0; k < mean.size(); ++k) gap += mean[k] * joint.pictures[index].state.expression[k];
  return gap;
}

double point_cost(const Joint& joint, std::size_t index) {
  const Picture& picture = joint.pictures[index];
  LandmarkBasis basis = picture.landmarks;
  const std::vector<Vec3f> points = posed(basis, joined(joint.identity, picture.state.expression));
  assign_contours(points, picture.state.pose, basis);
  const LandmarkRows rows = landmark_rows(basis, points, picture.state.pose);
  const double sigma = joint.options.point_sigma * eye_distance_px(basis, points, picture.state.pose);
  double cost = 0;
  for (const double residual : rows.residual_px) {
    const double error = std::abs(residual) / sigma;
    cost += error > huber_sigmas ? huber_sigmas * (2 * error - huber_sigmas) : error * error;
  }
  return cost;
}

double image_cost(const Joint& joint, std::size_t index, const PictureLevel& level) {
  Random random(static_cast<std::uint64_t>(joint.options.seed), 78);
  const PixelRows rows = pixel_rows(joint.basis, joint.identity, skin_albedo(joint.basis, joint.albedo),
                                    joint.pictures[index].state, level, {0, 0, 0, false}, 6000, random);
  double sum = 0;
  for (const float r : rows.residual) {
    const double u = r / (2.5 * least_noise);
    sum += u * u / (1 + u * u);
  }
  return rows.residual.empty() ? 0 : sum / static_cast<double>(rows.residual.size());
}

void report(Joint& joint, std::size_t index, const PictureLevel& level, const PictureLevel& small, FaceFit& fit) {
  Picture& picture = joint.pictures[index];
  const std::vector<Vec3f> points = posed(picture.landmarks, joined(joint.identity, picture.state.expression));
  assign_contours(points, picture.state.pose, picture.landmarks);
  const LandmarkRows marks = landmark_rows(picture.landmarks, points, picture.state.pose);
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < picture.landmarks.points.size(); ++i) {
    const double error = std::hypot(marks.residual_px[2 * i], marks.residual_px[2 * i + 1]);
    sum += error;
    squares += error * error;
  }
  const auto count = static_cast<double>(picture.landmarks.points.size());
  const double eyes = eye_distance_px(picture.landmarks, points, picture.state.pose);
  fit.landmark_rms_px = std::sqrt(squares / count);
  fit.landmark_nme = sum / count / eyes;
  Random random(static_cast<std::uint64_t>(joint.options.seed), 77);
  const PixelRows rows = pixel_rows(joint.basis, joint.identity, skin_albedo(joint.basis, joint.albedo), picture.state,
                                    level, {0, 0, 0, false}, 4000, random);
  fit.image_rms = trimmed_rms(rows.residual);
  fit.lip_gap_mm = lip_gap_of(*joint.model, fit.expression);
  const FitLandmarksOptions limits;
  const double found = likeness({*joint.model, joint.basis, joint.identity, picture.state, picture.eyes_px}, small);
  const double most_image_rms =
      joint.options.max_image_rms * (found >= sure_likeness && fit.landmark_nme <= limits.max_nme ? hard_look : 1);
  if (rows.visible < 200)
    fit.problem = "less than 200 pixels of skin are seen: use a larger picture, or check the points";
  else if (turn_deg(picture.state.pose) > limits.max_turn_deg)
    fit.problem = message("the head came out turned by ", std::lround(turn_deg(picture.state.pose)),
                          " degrees: use a picture in which both eyes are seen");
  else if (rows.overexposed > extreme_share)
    fit.problem = message(std::lround(100 * rows.overexposed),
                          " % of the face is overexposed: use a picture with less or softer light");
  else if (rows.dark > extreme_share)
    fit.problem =
        message(std::lround(100 * rows.dark), " % of the face is all but black: use a picture with more light");
  else if (fit.image_rms > most_image_rms)
    fit.problem =
        message("model and picture differ by ", std::lround(100 * fit.image_rms), " % of the scale, expected at most ",
                std::lround(100 * most_image_rms), " %: is there a face at the points?");
  else if (fit.landmark_nme > limits.max_nme)
    fit.problem = message("the points lie ", std::lround(1000 * fit.landmark_nme) / 10.0,
                          " % of the eye distance off, expected at most ", 100 * limits.max_nme,
                          " %: check their names and places");
  else if (found < least_likeness)
    fit.problem = message("what is at the points does not look like a face (likeness ",
                          std::round(100 * found) / 100 + 0.0, ", expected at least ", least_likeness,
                          "): use points of this picture, on a face that is upright and not hidden");
  fit.converged = fit.problem.empty() && std::isfinite(fit.image_rms);
}

}  // namespace face::model
