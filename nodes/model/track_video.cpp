// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/track_video.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/model/likeness.h"
#include "nodes/model/pixel_normal.h"
#include "nodes/model/pixel_rows.h"
#include "nodes/model/pose_model.h"
#include "nodes/model/robust_weights.h"
#include "nodes/model/start_view.h"
#include "nodes/model/tracked_person.h"

namespace face::model {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// Distance of the outer corners of the eyes, and how many times the steps: a mouth that opens by 10 mm within a frame
// is caught in the smallest picture. With half as many steps there the lip gap lags: off by 1.28 in place of 1.14 mm at
// worst (mean of ten made persons, those that were worst among them).
struct Stage {
  double eyes_px, steps;
};
constexpr Stage stages[] = {{30, 5}, {60, 1.5}, {110, 1}};
constexpr std::size_t likeness_stage = 1;  // whose size is about likeness_eyes_px
constexpr double usual_eye_distance_mm = 90;
// Eyes and mouth are drawn dark, so shut lids and teeth look unlike: 32 of 146 frames of a made person. Up to this
// difference the skin alone decides. The same person's frames come to 0.013, other persons' to 0.034 and more.
constexpr double same_skin_rms = 0.02;
constexpr double scale_sigma = 0.05, overlap_sigma_mm = 0.3;
constexpr double held_sigma = 1e-6;  // of what stays as it is
constexpr double most_sigmas = 1;    // that a coefficient moves in a step
// Where colours are as fine as the picture, what is far off by them is highlight or shadow.
constexpr double fine_kernel = 1.25;
constexpr std::size_t judged_points = 2000;

// What a frame is compared with, and how.
struct Tracker {
  const MorphableModel& model;
  const TrackVideoOptions& options;
  TrackedPerson person;
  std::vector<double> expression_before;
  double eyes_px = 0;  // distance of the outer corners of the eyes in the frame
  Random random;
};

// A size of the frame, and of the start's picture where there is one.
struct Size {
  const PictureLevel& frame;
  std::optional<StartView> start;
};

// Where a frame has come to.
struct Frame {
  PictureState state;
  std::array<double, FacePose::size> moved{};  // since the frame before
};

PixelColumns columns_of(const Tracker& tracker) { return {0, 0, tracker.person.lidless.expressions, false, true}; }

PixelRows compared_rows(Tracker& tracker, const Size& size, const PictureState& state) {
  const TrackedPerson& person = tracker.person;
  const std::vector<Vec3f> posed_mm = posed_skin(person.lidless, as_is, state.expression);
  const DrawnSkin drawn = draw_skin(person.lidless, posed_mm, state.pose, size.frame);
  std::size_t visible = 0;
  std::vector<SkinPoint> points =
      choose_points(person.lidless, drawn, static_cast<std::size_t>(tracker.options.points), tracker.random, visible);
  if (size.start) colour_points(*size.start, person.lidless, person.lips.at(state.expression), points);
  return rows_at(points, person.lidless, posed_mm, person.colours, state, size.frame, columns_of(tracker));
}

// Normal equations a x = b of a step.
struct Normal {
  Matrix a;
  Vector b;

  // What is `value` away from where it is held by sigma.
  void hold(std::size_t column, double value, double sigma) {
    const auto k = static_cast<Eigen::Index>(column);
    a(k, k) += 1 / (sigma * sigma);
    b[k] -= value / (sigma * sigma);
  }
};

Normal pixel_equations(const PixelRows& rows, double kernel, double image_weight) {
  const PixelNormal pixels = pixel_normal(rows, kernel);
  const double weight = image_weight / pixels.points / (pixels.noise * pixels.noise);
  const auto width = static_cast<Eigen::Index>(rows.columns);
  return {weight * Eigen::Map<const Matrix>(pixels.a.data(), width, width),
          weight * Eigen::Map<const Vector>(pixels.b.data(), width)};
}

// Changes from frame to frame, coefficients and shading are small.
void add_priors(const Tracker& tracker, const Frame& frame, Normal& normal) {
  const TrackVideoOptions& options = tracker.options;
  const double turn_sigma = options.turn_sigma_deg * std::numbers::pi / 180.0, place_sigma_px = 0.1 * tracker.eyes_px;
  const double pose_sigmas[] = {turn_sigma,     turn_sigma,  turn_sigma, place_sigma_px,
                                place_sigma_px, scale_sigma, held_sigma};
  for (std::size_t k = 0; k < FacePose::size; ++k) normal.hold(k, frame.moved[k], pose_sigmas[k]);
  const std::vector<double>& expression = frame.state.expression;
  for (std::size_t k = 0; k < expression.size(); ++k) {
    const double sigma = tracker.model.expression.sigmas[k];
    const std::size_t column = columns_of(tracker).expression_first() + k;
    normal.hold(column, expression[k] - tracker.expression_before[k], options.change_sigma * sigma);
    normal.hold(column, expression[k], 2 * sigma);
  }
  for (std::size_t k = 0; k < shading_parameters; ++k)
    normal.hold(columns_of(tracker).shading_first() + k, frame.state.shading[k], options.shading_sigma);
}

// Lips do not run into each other.
void part_lips(const Tracker& tracker, const std::vector<double>& expression, Normal& normal) {
  const auto first = static_cast<Eigen::Index>(columns_of(tracker).expression_first()),
             count = static_cast<Eigen::Index>(expression.size());
  for (const std::vector<double>& row : tracker.person.gaps) {
    const Eigen::Map<const Vector> g(row.data(), count);
    const double gap_mm = std::inner_product(expression.begin(), expression.end(), row.begin(), 0.0);
    if (gap_mm >= 0) continue;
    constexpr double weight = 1 / (overlap_sigma_mm * overlap_sigma_mm);
    normal.a.block(first, first, count, count) += weight * g * g.transpose();
    normal.b.segment(first, count) -= weight * gap_mm * g;
  }
}

void apply(const Tracker& tracker, const Vector& step, Frame& frame) {
  const PixelColumns columns = columns_of(tracker);
  std::array<double, FacePose::size> turn{};
  for (std::size_t k = 0; k < FacePose::size; ++k) {
    turn[k] = step[static_cast<Eigen::Index>(k)];
    frame.moved[k] += turn[k];
  }
  PictureState& state = frame.state;
  state.pose = moved(state.pose, turn);
  for (std::size_t k = 0; k < shading_parameters; ++k)
    state.shading[k] += step[static_cast<Eigen::Index>(columns.shading_first() + k)];
  for (std::size_t k = 0; k < state.expression.size(); ++k) {
    const double most = most_sigmas * tracker.model.expression.sigmas[k];
    state.expression[k] += std::clamp(step[static_cast<Eigen::Index>(columns.expression_first() + k)], -most, most);
  }
}

void take_step(Tracker& tracker, const Size& size, Frame& frame) {
  const PixelRows rows = compared_rows(tracker, size, frame.state);
  if (rows.residual.size() < 30) return;
  Normal normal = pixel_equations(rows, size.start ? fine_kernel : usual_kernel, tracker.options.image_weight);
  add_priors(tracker, frame, normal);
  part_lips(tracker, frame.state.expression, normal);
  apply(tracker, normal.a.ldlt().solve(normal.b), frame);
}

// Why the face is not believed to be where the state has it; empty where it is. image_rms: of frame and face.
std::string doubt(const Tracker& tracker, const PictureLevel& level, const PictureState& state, double image_rms) {
  if (!(image_rms <= tracker.options.max_image_rms))
    return message("frame and model differ by ", std::lround(100 * image_rms),
                   " % of the scale: the face is lost here; start anew after it");
  const TrackedPerson& person = tracker.person;
  LikenessFace face{tracker.model, person.skin, as_is, state, tracker.eyes_px, &person.colours};
  double seen = likeness(face, level);
  if (seen < tracker.options.min_likeness && image_rms <= same_skin_rms) {
    face.skin_alone = true;
    seen = likeness(face, level);
  }
  if (seen >= tracker.options.min_likeness) return "";
  return message("the frame does not look like the face of the first one (likeness ",
                 std::round(100 * seen) / 100 + 0.0, ", expected at least ", tracker.options.min_likeness,
                 "): the face is lost here; start anew after it");
}

void check_sizes(const Image& frame, const FaceFit& start, const AlbedoMap& albedo, const Image* picture) {
  check(frame.width == start.image_width_px && frame.height == start.image_height_px, "the frame is ", frame.width,
        " x ", frame.height, " pixels, the start was fitted on ", start.image_width_px, " x ", start.image_height_px);
  check(picture == nullptr || (picture->width == frame.width && picture->height == frame.height), "the picture is ",
        picture != nullptr ? picture->width : 0, " x ", picture != nullptr ? picture->height : 0,
        " pixels, the start was fitted on ", start.image_width_px, " x ", start.image_height_px);
  if (!start.converged) return;  // it has no colours
  check(albedo.width > 0 && albedo.height > 0 &&
            albedo.albedo.size() == static_cast<std::size_t>(albedo.width) * static_cast<std::size_t>(albedo.height),
        "albedo has ", albedo.albedo.size(), " texels, expected ", albedo.width, " x ", albedo.height);
}

// Sizes at which a frame is compared, the smallest first.
std::vector<double> factors_of(double eyes_px) {
  std::vector<double> factors;
  for (const Stage& stage : stages) {
    factors.push_back(std::min(1.0, stage.eyes_px / eyes_px));
    if (stage.eyes_px >= eyes_px) break;
  }
  return factors;
}

// levels: of the frame, and of the start's picture where there is one.
void follow(Tracker& tracker, const std::vector<PictureLevel>& levels, std::vector<PictureLevel> start_levels,
            Frame& frame) {
  for (std::size_t i = 0; i < levels.size(); ++i) {
    Size size{levels[i], std::nullopt};
    if (!start_levels.empty())
      size.start = start_view(tracker.person.skin, as_is, tracker.person.first, std::move(start_levels[i]));
    const std::int64_t steps = std::llround(stages[i].steps * static_cast<double>(tracker.options.steps));
    for (std::int64_t n = 0; n < steps; ++n) take_step(tracker, size, frame);
  }
}

}  // namespace

TrackVideoResult track_video(const MorphableModel& model, const Image& frame, const FaceFit& start,
                             const AlbedoMap& albedo, const Image* picture,
                             const engine::Prior<TrackVideoResult>& prior, const TrackVideoOptions& options) {
  check_sizes(frame, start, albedo, picture);
  const FaceFit& before = prior ? prior->fit : start;
  TrackVideoResult result{before};
  FaceFit& fit = result.fit;
  fit.landmark_rms_px = fit.landmark_nme = 0;
  if (!start.converged) {
    fit.converged = false;
    fit.problem = "the start could not be fitted: " + start.problem;
    return result;
  }
  Tracker tracker{model, options, tracked_person(model, start, albedo, static_cast<std::size_t>(options.expressions)),
                  {},    0,       Random(static_cast<std::uint64_t>(options.seed))};
  TrackedPerson& person = tracker.person;
  tracker.expression_before = expression_of(before, person.skin.expressions);
  // Highlights move over a head that turns; colours at vertices hold those of the first frame.
  if (picture == nullptr) person.first.light.mirror = {0, 0};
  Frame moving{person.first};
  PictureState& state = moving.state;
  state.pose = pose_of(before.camera, turning_point(model));
  state.expression = tracker.expression_before;
  state.seen = shadow_of(person.skin, as_is, state);
  tracker.eyes_px = usual_eye_distance_mm * std::exp(state.pose.log_scale);
  const std::vector<double> factors = factors_of(tracker.eyes_px);
  const std::vector<PictureLevel> levels = make_levels(frame, factors);
  std::vector<PictureLevel> start_levels;
  if (picture != nullptr) {
    person.first.seen = shadow_of(person.skin, as_is, person.first);
    start_levels = make_levels(*picture, factors);
  }
  follow(tracker, levels, std::move(start_levels), moving);

  state.light.mirror = {0, 0};
  const PixelRows rows = pixel_rows(person.skin, as_is, person.colours, state, levels.back(), {0, 0, 0, false},
                                    judged_points, tracker.random);
  fit.image_rms = trimmed_rms(rows.residual);
  fit.problem = doubt(tracker, levels[std::min(likeness_stage, levels.size() - 1)], state, fit.image_rms);
  fit.converged = fit.problem.empty();
  // The next frame starts from the last one that was believed, not from where a lost one has drifted to.
  if (!fit.converged) return result;
  fit.expression.assign(state.expression.begin(), state.expression.end());
  fit.camera = camera_of(state.pose);
  fit.lip_gap_mm = lip_gap_of(model, fit.expression);
  return result;
}

}  // namespace face::model
