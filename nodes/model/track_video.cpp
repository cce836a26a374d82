// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/track_video.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "nodes/base/check.h"
#include "nodes/model/likeness.h"
#include "nodes/model/lip_rims.h"
#include "nodes/model/pixel_normal.h"
#include "nodes/model/pixel_rows.h"
#include "nodes/model/pose_model.h"
#include "nodes/model/robust_weights.h"
#include "nodes/model/skin_atlas.h"
#include "nodes/model/start_view.h"

namespace face::model {
namespace {

using Vector = Eigen::VectorXd;

// Distance of the outer corners of the eyes, and how many times the steps: a mouth that opens by 10 mm within a frame
// is caught in the smallest picture.
struct Stage {
  double eyes_px, steps;
};
constexpr Stage stages[] = {{30, 2.5}, {60, 1.5}, {110, 1}};
constexpr double usual_eye_distance_mm = 90;
// Eyes and mouth are drawn dark, so shut lids and teeth look unlike: 32 of 146 frames of a made person. Up to this
// difference the skin alone decides. The same person's frames come to 0.013, other persons' to 0.034 and more.
constexpr double same_skin_rms = 0.02;
constexpr double scale_sigma = 0.05, overlap_sigma_mm = 0.3;
// Lids that shut bring skin to light which the first frame did not show, and turned the head by up to 1.6 degrees: what
// lies within an ellipse about the corners of an eye is not compared.
constexpr double eye_width = 1.4, eye_height_share = 0.8;  // of the distance of the corners; of the width

// Where colours are as fine as the picture, what is far off by them is highlight or shadow.
constexpr double fine_kernel = 1.25;

// The map's colour at every vertex of the basis.
std::vector<Vec3f> vertex_colours(const MorphableModel& model, const SkinBasis& basis, const AlbedoMap& map) {
  std::vector<Vec3f> all = model.mean_albedo;
  const SkinAtlas atlas = make_skin_atlas(model.mean);
  for (std::size_t t = 0; t < atlas.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2f& uv = atlas.uvs[atlas.corners[t][i]];
      const int x = std::clamp(static_cast<int>(uv[0] * static_cast<float>(map.width)), 0, map.width - 1);
      const int y = std::clamp(static_cast<int>((1 - uv[1]) * static_cast<float>(map.height)), 0, map.height - 1);
      const Vec3f& colour =
          map.albedo[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x)];
      if (colour[0] > 0) all[atlas.triangles[t][i]] = colour;
    }
  std::vector<Vec3f> colours;
  colours.reserve(basis.vertices.size());
  for (const std::uint32_t v : basis.vertices) colours.push_back(all[v]);
  return colours;
}

// The basis without the triangles about the eyes.
SkinBasis without_lids(const MorphableModel& model, SkinBasis basis) {
  if (model.landmarks68.size() != 68) return basis;
  std::vector<bool> is_lid(basis.vertices.size());
  for (const std::array<std::size_t, 2>& corners : {std::array<std::size_t, 2>{36, 39}, {42, 45}}) {
    const Vec3f &a = model.mean.points_mm[model.landmarks68[corners[0]]],
                &b = model.mean.points_mm[model.landmarks68[corners[1]]];
    const float half = 0.5f * static_cast<float>(eye_width) * std::abs(a[0] - b[0]);
    for (std::size_t v = 0; v < is_lid.size(); ++v) {
      const float x = (basis.mean_mm[v][0] - 0.5f * (a[0] + b[0])) / half;
      const float y = (basis.mean_mm[v][1] - 0.5f * (a[1] + b[1])) / (static_cast<float>(eye_height_share) * half);
      if (x * x + y * y < 1) is_lid[v] = true;
    }
  }
  std::erase_if(basis.triangles, [&](const auto& t) { return is_lid[t[0]] || is_lid[t[1]] || is_lid[t[2]]; });
  return basis;
}

const std::vector<double> as_is;  // no coefficients of identity: the basis is the person's

struct Tracked {
  const MorphableModel* model = nullptr;
  const TrackVideoOptions* options = nullptr;
  SkinBasis whole, basis;  // of this person; basis: without the lids
  std::vector<Vec3f> colours;
  std::vector<double> centre;  // the frame before's expression
  std::vector<std::vector<double>> gaps;
  std::optional<PartingLips> lips;
};

// A size of the frame, and of the start's picture where there is one.
struct Sizes {
  PictureLevel frame;
  std::optional<StartView> start;
};

void step(const Tracked& tracked, const Sizes& sizes, double eyes_px, Random& random, PictureState& state,
          std::array<double, FacePose::size>& moved_so_far) {
  const PictureLevel& level = sizes.frame;
  const std::size_t expressions = tracked.basis.expressions;
  const PixelColumns columns{0, 0, expressions, false, true};
  const std::vector<Vec3f> posed_mm = posed_skin(tracked.basis, as_is, state.expression);
  const DrawnSkin drawn = draw_skin(tracked.basis, posed_mm, state.pose, level);
  std::size_t visible = 0;
  std::vector<SkinPoint> points =
      choose_points(tracked.basis, drawn, static_cast<std::size_t>(tracked.options->points), random, visible);
  if (sizes.start) colour_points(*sizes.start, tracked.basis, tracked.lips->at(state.expression), points);
  const PixelRows rows = rows_at(points, tracked.basis, posed_mm, tracked.colours, state, level, columns);
  if (rows.residual.size() < 30) return;
  const PixelNormal pixels = pixel_normal(rows, sizes.start ? fine_kernel : usual_kernel);
  const double weight = tracked.options->image_weight / pixels.points / (pixels.noise * pixels.noise);
  const auto width = static_cast<Eigen::Index>(rows.columns);
  Eigen::MatrixXd a = weight * Eigen::Map<const Eigen::MatrixXd>(pixels.a.data(), width, width);
  Vector b = weight * Eigen::Map<const Vector>(pixels.b.data(), width);
  const auto add = [&](Eigen::Index column, double value, double sigma) {
    a(column, column) += 1 / (sigma * sigma);
    b[column] -= value / (sigma * sigma);
  };
  const double turn_sigma = tracked.options->turn_sigma_deg * std::numbers::pi / 180.0;
  const double pose_sigmas[] = {turn_sigma, turn_sigma, turn_sigma, 0.1 * eyes_px, 0.1 * eyes_px, scale_sigma, 1e-6};
  for (std::size_t k = 0; k < FacePose::size; ++k) add(static_cast<Eigen::Index>(k), moved_so_far[k], pose_sigmas[k]);
  for (std::size_t k = 0; k < expressions; ++k) {
    const double sigma = tracked.model->expression.sigmas[k];
    const auto column = static_cast<Eigen::Index>(FacePose::size + k);
    add(column, state.expression[k] - tracked.centre[k], tracked.options->change_sigma * sigma);
    add(column, state.expression[k], 2 * sigma);
  }
  for (std::size_t k = 0; k < shading_parameters; ++k)
    add(static_cast<Eigen::Index>(columns.shading_first() + k), state.shading[k], tracked.options->shading_sigma);
  for (const std::vector<double>& row : tracked.gaps) {
    const Eigen::Map<const Vector> g(row.data(), static_cast<Eigen::Index>(expressions));
    double gap = 0;
    for (std::size_t k = 0; k < expressions; ++k) gap += row[k] * state.expression[k];
    if (gap >= 0) continue;
    const double gap_weight = 1 / (overlap_sigma_mm * overlap_sigma_mm);
    a.block(FacePose::size, FacePose::size, g.size(), g.size()) += gap_weight * g * g.transpose();
    b.segment(FacePose::size, g.size()) -= gap_weight * gap * g;
  }
  const Vector found = a.ldlt().solve(b);
  std::array<double, FacePose::size> turn{};
  for (std::size_t k = 0; k < FacePose::size; ++k) {
    turn[k] = found[static_cast<Eigen::Index>(k)];
    moved_so_far[k] += turn[k];
  }
  state.pose = moved(state.pose, turn);
  for (std::size_t k = 0; k < shading_parameters; ++k)
    state.shading[k] += found[static_cast<Eigen::Index>(columns.shading_first() + k)];
  for (std::size_t k = 0; k < expressions; ++k)
    state.expression[k] +=
        std::clamp(found[static_cast<Eigen::Index>(FacePose::size + k)], -1.0 * tracked.model->expression.sigmas[k],
                   1.0 * tracked.model->expression.sigmas[k]);
}

}  // namespace

TrackVideoResult track_video(const MorphableModel& model, const Image& frame, const FaceFit& start,
                             const AlbedoMap& albedo, const Image* picture,
                             const engine::Prior<TrackVideoResult>& prior, const TrackVideoOptions& options) {
  check(frame.width == start.image_width_px && frame.height == start.image_height_px, "the frame is ", frame.width,
        " x ", frame.height, " pixels, the start was fitted on ", start.image_width_px, " x ", start.image_height_px);
  check(picture == nullptr || (picture->width == frame.width && picture->height == frame.height), "the picture is ",
        picture != nullptr ? picture->width : 0, " x ", picture != nullptr ? picture->height : 0,
        " pixels, the start was fitted on ", start.image_width_px, " x ", start.image_height_px);
  const FaceFit& before = prior ? prior->fit : start;
  TrackVideoResult result;
  result.fit = before;
  result.fit.landmark_rms_px = result.fit.landmark_nme = 0;
  if (!start.converged) {
    result.fit.converged = false;
    result.fit.problem = "the start could not be fitted: " + start.problem;
    return result;
  }
  check(albedo.width > 0 && albedo.height > 0 &&
            albedo.albedo.size() == static_cast<std::size_t>(albedo.width) * static_cast<std::size_t>(albedo.height),
        "albedo has ", albedo.albedo.size(), " texels, expected ", albedo.width, " x ", albedo.height);
  Tracked tracked;
  tracked.model = &model;
  tracked.options = &options;
  tracked.whole = make_skin_basis(model, 0, static_cast<std::size_t>(options.expressions), 0);
  tracked.basis = without_lids(model, tracked.whole);
  tracked.colours = vertex_colours(model, tracked.basis, albedo);
  // The person stays: their head at rest takes the mean's place.
  const std::vector<Vec3f> rest_mm = pose_model(model, start.identity, {});
  for (std::size_t v = 0; v < tracked.whole.vertices.size(); ++v)
    tracked.whole.mean_mm[v] = tracked.basis.mean_mm[v] = rest_mm[tracked.whole.vertices[v]];
  tracked.gaps = lip_gap_rows(model);
  tracked.centre.assign(tracked.basis.expressions, 0.0);
  for (std::size_t k = 0; k < std::min(tracked.centre.size(), before.expression.size()); ++k)
    tracked.centre[k] = before.expression[k];
  PictureState state;
  state.pose = pose_of(before.camera, turning_point(model));
  state.expression = tracked.centre;
  state.light = start.light;
  // Highlights move over a head that turns; colours at vertices hold those of the first frame.
  if (picture == nullptr) state.light.mirror = {0, 0};
  state.seen = shadow_of(tracked.whole, as_is, state);
  PictureState first = state;
  first.pose = pose_of(start.camera, turning_point(model));
  first.expression.assign(tracked.basis.expressions, 0.0);
  for (std::size_t k = 0; k < std::min(first.expression.size(), start.expression.size()); ++k)
    first.expression[k] = start.expression[k];
  tracked.lips.emplace(model, tracked.basis, first.expression);
  if (picture != nullptr) first.seen = shadow_of(tracked.whole, as_is, first);
  Random random(static_cast<std::uint64_t>(options.seed));
  const double eyes_px = usual_eye_distance_mm * std::exp(state.pose.log_scale);
  std::array<double, FacePose::size> moved_so_far{};
  const FloatPicture now = float_picture(frame), then = picture ? float_picture(*picture) : FloatPicture{};
  Sizes sizes;
  for (const Stage& stage : stages) {
    const double factor = std::min(1.0, stage.eyes_px / eyes_px);
    const bool is_last = &stage == stages + std::size(stages) - 1 || stage.eyes_px >= eyes_px;
    sizes.frame = make_level(now, factor);
    if (picture != nullptr) sizes.start = start_view(tracked.whole, as_is, first, then, factor);
    const std::int64_t steps = std::llround(stage.steps * static_cast<double>(options.steps));
    for (std::int64_t i = 0; i < steps; ++i) step(tracked, sizes, eyes_px, random, state, moved_so_far);
    if (is_last) break;
  }
  const PictureLevel& level = sizes.frame;
  state.light.mirror = {0, 0};
  FaceFit& fit = result.fit;
  fit.expression.assign(state.expression.begin(), state.expression.end());
  fit.camera = camera_of(state.pose);
  fit.lip_gap_mm = lip_gap_of(model, fit.expression);
  const PixelRows rows =
      pixel_rows(tracked.whole, as_is, tracked.colours, state, level, {0, 0, 0, false}, 2000, random);
  fit.image_rms = trimmed_rms(rows.residual);
  if (!(fit.image_rms <= options.max_image_rms)) {
    fit.problem = message("frame and model differ by ", std::lround(100 * fit.image_rms),
                          " % of the scale: the face is lost here; start anew after it");
  } else {
    LikenessFace face{model, tracked.whole, as_is, state, eyes_px, &tracked.colours};
    const PictureLevel small = make_level(now, std::min(1.0, likeness_eyes_px / eyes_px));
    double seen = likeness(face, small);
    if (seen < options.min_likeness && fit.image_rms <= same_skin_rms) {
      face.skin_alone = true;
      seen = likeness(face, small);
    }
    fit.problem = seen >= options.min_likeness
                      ? ""
                      : message("the frame does not look like the face of the first one (likeness ",
                                std::round(100 * seen) / 100 + 0.0, ", expected at least ", options.min_likeness,
                                "): the face is lost here; start anew after it");
  }
  fit.converged = fit.problem.empty();
  if (fit.converged) return result;
  // The next frame starts from the last one that was believed, not from where a lost one has drifted to.
  fit.expression = before.expression;
  fit.camera = before.camera;
  fit.lip_gap_mm = before.lip_gap_mm;
  return result;
}

}  // namespace face::model
