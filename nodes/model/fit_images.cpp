// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/fit_images.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "nodes/base/check.h"
#include "nodes/model/fit_joint.h"
#include "nodes/model/fit_landmarks.h"
#include "nodes/model/landmark_basis.h"
#include "nodes/model/light_model.h"
#include "nodes/model/likeness.h"
#include "nodes/model/pixel_normal.h"
#include "nodes/model/pixel_rows.h"
#include "nodes/model/pose_model.h"
#include "nodes/model/robust_weights.h"
#include "nodes/model/settle_mouths.h"

namespace face::model {
namespace {

using Vector = Eigen::VectorXd;

// Prior spread of the rendering parameters (sigma_R of equation 8), about their start.
constexpr double turn_sigma = 0.5, place_sigma_px = 1e3, scale_sigma = 0.5, focal_sigma = 0.12;
constexpr double light_sigma[light_parameters] = {0.4,  0.4,  0.4,  0.5,  0.5,  0.5,  0.8,  0.8, 0.15,
                                                  0.15, 0.15, 0.15, 0.04, 0.04, 0.04, 0.05, 0.05};
constexpr double held_sigma = 1e-6;  // of what stays as it is
constexpr double overlap_sigma_mm = 0.3, closed_sigma_mm = 0.1;
// Made persons come out within 0.005 of their pictures, photographs within 0.02: the rest is what no component
// explains, and shape must not bend to explain it. From explained on, points and priors of the shape gain what pixels
// lose in a proper likelihood, up to most_doubt times; light and albedo stay free.
constexpr double explained = 0.01, most_doubt = 4;
constexpr double usual_brightness = 0.75;  // of skin; darker pictures are fitted as if they had it
constexpr double least_exposure = 0.1;     // below, what is seen is noise
constexpr int mouth_steps = 8;
constexpr int light_steps = 6;

// One size of the picture: of the eye distance on it, how much the points still weigh, how much of the picture's weight
// is used already (E_F first, E_I growing).
struct Stage {
  double eyes_px, landmark_weight, image_share;
  double points, steps;  // factors of the options
  bool mirror;           // whether highlights are sought: a mouth and its teeth are to be in place before
};
constexpr Stage stages[] = {{28, 1.0, 0.3, 1, 1, false},
                            {55, 0.5, 0.7, 1, 1, false},
                            {110, 0.2, 1.0, 1, 1, true},
                            {160, 0.2, 1.0, 4, 1.5, true}};

struct Normal {
  Eigen::MatrixXd a;
  Vector b;
};

// Adds one picture's pixels. Columns of the picture's own follow the shared ones.
void add_pixels(Joint& joint, std::size_t index, const PictureLevel& level, double share, Random& random,
                Normal& normal) {
  const PixelColumns columns = joint.columns();
  const PixelRows rows =
      pixel_rows(joint.basis, joint.identity, skin_albedo(joint.basis, joint.albedo), joint.pictures[index].state,
                 level, columns, static_cast<std::size_t>(joint.options.points), random);
  if (rows.residual.empty()) return;
  const PixelNormal found = pixel_normal(rows);
  // The larger the differences, the more of them is what no coefficients explain; that is alike over whole regions, so
  // the picture counts as fewer independent points.
  const double noise = found.noise;
  joint.pictures[index].doubt = std::clamp(std::pow(found.median / explained, 2), 1.0, most_doubt);
  const double trust = (least_noise / noise) * (least_noise / noise);
  const double weight = share * trust * joint.options.image_weight / found.points / (noise * noise);
  const auto width = static_cast<Eigen::Index>(rows.columns);
  const Eigen::Map<const Eigen::MatrixXd> a(found.a.data(), width, width);
  const Eigen::Map<const Vector> b(found.b.data(), width);
  const auto shared = static_cast<Eigen::Index>(joint.shared()), own = static_cast<Eigen::Index>(joint.own());
  const Eigen::Index first = shared + own * static_cast<Eigen::Index>(index);
  normal.a.topLeftCorner(shared, shared) += weight * a.topLeftCorner(shared, shared);
  normal.a.block(0, first, shared, own) += weight * a.topRightCorner(shared, own);
  normal.a.block(first, 0, own, shared) += weight * a.bottomLeftCorner(own, shared);
  normal.a.block(first, first, own, own) += weight * a.bottomRightCorner(own, own);
  normal.b.head(shared) += weight * b.head(shared);
  normal.b.segment(first, own) += weight * b.tail(own);
}

void add_landmarks(Joint& joint, std::size_t index, double weight, Normal& normal) {
  Picture& picture = joint.pictures[index];
  const std::vector<Vec3f> points = posed(picture.landmarks, joined(joint.identity, picture.state.expression));
  assign_contours(points, picture.state.pose, picture.landmarks);
  const LandmarkRows rows = landmark_rows(picture.landmarks, points, picture.state.pose);
  const double sigma = joint.options.point_sigma * eye_distance_px(picture.landmarks, points, picture.state.pose);
  const auto shared = static_cast<Eigen::Index>(joint.shared()), own = static_cast<Eigen::Index>(joint.own());
  const Eigen::Index first = shared + own * static_cast<Eigen::Index>(index);
  Vector row = Vector::Zero(normal.b.size());
  for (std::size_t i = 0; i < rows.residual_px.size(); ++i) {
    const double* from = rows.jacobian.data() + i * rows.columns;
    for (Eigen::Index k = 0; k < FacePose::size; ++k) row[first + k] = from[k];
    for (std::size_t k = 0; k < joint.basis.identities; ++k)
      row[static_cast<Eigen::Index>(k)] = from[FacePose::size + k];
    for (std::size_t k = 0; k < joint.basis.expressions; ++k)
      row[first + FacePose::size + static_cast<Eigen::Index>(k)] = from[FacePose::size + joint.basis.identities + k];
    const double error = std::abs(rows.residual_px[i]) / sigma;
    const double w = picture.doubt * weight * (error > huber_sigmas ? huber_sigmas / error : 1.0) / (sigma * sigma);
    normal.a.selfadjointView<Eigen::Lower>().rankUpdate(row, w);
    normal.b -= row * (w * rows.residual_px[i]);
  }
}

// Priors (equation 8) and lips that do not run into each other.
void add_priors(const Joint& joint, bool frozen, Normal& normal) {
  const auto add = [&](Eigen::Index column, double value, double sigma) {
    normal.a(column, column) += 1 / (sigma * sigma);
    normal.b[column] -= value / (sigma * sigma);
  };
  double doubt = 0;
  for (const Picture& picture : joint.pictures) doubt += picture.doubt / static_cast<double>(joint.pictures.size());
  for (std::size_t k = 0; k < joint.identity.size(); ++k)
    add(static_cast<Eigen::Index>(k), joint.identity[k], joint.model->identity.sigmas[k] / std::sqrt(doubt));
  for (std::size_t k = 0; k < joint.albedo.size(); ++k)
    add(static_cast<Eigen::Index>(joint.basis.identities + k), joint.albedo[k], joint.model->albedo.sigmas[k]);
  for (std::size_t m = 0; m < joint.pictures.size(); ++m) {
    const Picture& picture = joint.pictures[m];
    const auto first = static_cast<Eigen::Index>(joint.shared() + m * joint.own());
    const double narrower = 1 / std::sqrt(picture.doubt);
    // The turn, place and size are held near the present ones only: their start is no prior knowledge.
    for (Eigen::Index k = 0; k < 3; ++k) add(first + k, 0, turn_sigma);
    add(first + 3, 0, place_sigma_px);
    add(first + 4, 0, place_sigma_px);
    add(first + 5, 0, scale_sigma);
    add(first + 6, picture.state.pose.log_focal - picture.log_focal, focal_sigma * narrower);
    const Eigen::Index expression = first + FacePose::size;
    for (std::size_t k = 0; k < joint.basis.expressions; ++k)
      add(expression + static_cast<Eigen::Index>(k), picture.state.expression[k],
          joint.model->expression.sigmas[k] * narrower);
    for (const std::vector<double>& row : joint.gaps) {
      const Eigen::Map<const Vector> g(row.data(), static_cast<Eigen::Index>(joint.basis.expressions));
      double gap = 0;
      for (std::size_t k = 0; k < joint.basis.expressions; ++k) gap += row[k] * picture.state.expression[k];
      if (picture.held_gap_mm > 0 && gap >= 0) continue;
      const double sigma = picture.closed ? closed_sigma_mm : gap < 0 ? overlap_sigma_mm : joint.options.mouth_sigma_mm;
      const double wide = gap / sigma;
      const double weight =
          picture.doubt / (sigma * sigma) /
          (picture.closed || gap < 0 ? 1.0 : static_cast<double>(joint.gaps.size()) * (1 + wide * wide));
      normal.a.block(expression, expression, g.size(), g.size()) += weight * g * g.transpose();
      normal.b.segment(expression, g.size()) -= weight * gap * g;
    }
    if (picture.held_gap_mm > 0) {
      const std::vector<double> row = mean_gap_row(joint);
      const Eigen::Map<const Vector> g(row.data(), static_cast<Eigen::Index>(row.size()));
      const double weight = picture.doubt / (closed_sigma_mm * closed_sigma_mm);
      normal.a.block(expression, expression, g.size(), g.size()) += weight * g * g.transpose();
      normal.b.segment(expression, g.size()) -= weight * (gap_of(joint, m) - picture.held_gap_mm) * g;
    }
    const Eigen::Index light = expression + static_cast<Eigen::Index>(joint.basis.expressions);
    const FaceLight& now = picture.state.light;
    const FaceLight usual;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto k = static_cast<Eigen::Index>(c);
      add(light + k, now.ambient[c] - usual.ambient[c], light_sigma[0]);
      add(light + 3 + k, now.parallel[c] - usual.parallel[c], light_sigma[3]);
      add(light + 9 + k, now.gain[c] - 1.0, light_sigma[9]);
      add(light + 12 + k, now.offset[c], light_sigma[12]);
    }
    add(light + 6, 0, light_sigma[6]);
    add(light + 7, 0, light_sigma[7]);
    add(light + 8, now.contrast - 1.0, light_sigma[8]);
    for (std::size_t k = 0; k < now.mirror.size(); ++k)
      if (joint.mirror_held)
        add(light + static_cast<Eigen::Index>(first_mirror + k), 0, held_sigma);
      else
        add(light + static_cast<Eigen::Index>(first_mirror + k), now.mirror[k], light_sigma[first_mirror + k]);
  }
  if (!frozen) return;
  // Light and tone alone: everything else stays.
  for (std::size_t k = 0; k < joint.shared(); ++k)
    if (k < joint.basis.identities || k >= joint.basis.identities + 3) add(static_cast<Eigen::Index>(k), 0, held_sigma);
  for (std::size_t m = 0; m < joint.pictures.size(); ++m)
    for (std::size_t k = 0; k < FacePose::size + joint.basis.expressions; ++k)
      add(static_cast<Eigen::Index>(joint.shared() + m * joint.own() + k), 0, held_sigma);
}

void apply(const Vector& step, Joint& joint) {
  const auto clamped = [](double value, double limit) { return std::clamp(value, -limit, limit); };
  for (std::size_t k = 0; k < joint.identity.size(); ++k)
    joint.identity[k] += clamped(step[static_cast<Eigen::Index>(k)], joint.model->identity.sigmas[k]);
  for (std::size_t k = 0; k < joint.albedo.size(); ++k)
    joint.albedo[k] +=
        clamped(step[static_cast<Eigen::Index>(joint.basis.identities + k)], joint.model->albedo.sigmas[k]);
  for (std::size_t m = 0; m < joint.pictures.size(); ++m) {
    PictureState& state = joint.pictures[m].state;
    const auto first = static_cast<Eigen::Index>(joint.shared() + m * joint.own());
    std::array<double, FacePose::size> turn{};
    const double limits[] = {0.15, 0.15, 0.15, 0.1 * joint.pictures[m].eyes_px, 0.1 * joint.pictures[m].eyes_px,
                             0.1,  0.2};
    for (std::size_t k = 0; k < FacePose::size; ++k)
      turn[k] = clamped(step[first + static_cast<Eigen::Index>(k)], limits[k]);
    state.pose = moved(state.pose, turn);
    for (std::size_t k = 0; k < state.expression.size(); ++k)
      state.expression[k] +=
          clamped(step[first + static_cast<Eigen::Index>(FacePose::size + k)], joint.model->expression.sigmas[k]);
    std::array<double, light_parameters> light{};
    for (std::size_t k = 0; k < light_parameters; ++k)
      light[k] = clamped(step[first + static_cast<Eigen::Index>(FacePose::size + state.expression.size() + k)],
                         light_sigma[k]);
    state.light = moved(state.light, light.data());
  }
}

// The step that the equations ask for, with skin that mirrors no less than nothing: a lobe that would is held at 0 and
// the rest is solved anew. Cut off after the solution, all else would go on making up for a lobe that is not there: a
// smile came out half as wide, and photographs up to 22 % farther from the model than without lobes.
Vector solved(const Joint& joint, Normal normal) {
  Vector found = normal.a.selfadjointView<Eigen::Lower>().ldlt().solve(normal.b);
  for (std::size_t round = 0; round < lobe_count; ++round) {
    bool any = false;
    for (std::size_t m = 0; m < joint.pictures.size(); ++m)
      for (std::size_t k = 0; k < lobe_count; ++k) {
        const double now = joint.pictures[m].state.light.mirror[k];
        const auto column = static_cast<Eigen::Index>(joint.shared() + m * joint.own() + FacePose::size +
                                                      joint.basis.expressions + first_mirror + k);
        if (now + found[column] > -held_sigma) continue;
        any = true;
        const double weight = 1 / (held_sigma * held_sigma);
        normal.a(column, column) += weight;
        normal.b[column] -= weight * now;
      }
    if (!any) break;
    found = normal.a.selfadjointView<Eigen::Lower>().ldlt().solve(normal.b);
  }
  return found;
}

void step(Joint& joint, const std::vector<PictureLevel>& levels, const Stage& stage, bool frozen, Random& random) {
  const auto size = static_cast<Eigen::Index>(joint.shared() + joint.own() * joint.pictures.size());
  Normal normal{Eigen::MatrixXd::Zero(size, size), Vector::Zero(size)};
  for (std::size_t m = 0; m < joint.pictures.size(); ++m) {
    if (!frozen) joint.pictures[m].state.seen = shadow_of(joint.basis, joint.identity, joint.pictures[m].state);
    add_pixels(joint, m, levels[m], stage.image_share, random, normal);
    add_landmarks(joint, m, stage.landmark_weight, normal);
  }
  add_priors(joint, frozen, normal);
  apply(solved(joint, normal), joint);
}

// What to divide a picture by so that its skin is of usual brightness. A camera's gain does this to all that is seen.
double exposure_of(const Joint& joint, std::size_t index, Random& random) {
  const Picture& picture = joint.pictures[index];
  const PictureLevel level = make_level(*picture.image, std::min(1.0, stages[0].eyes_px / picture.eyes_px));
  const PixelRows rows = pixel_rows(joint.basis, joint.identity, skin_albedo(joint.basis, joint.albedo), picture.state,
                                    level, {0, 0, 0, false}, static_cast<std::size_t>(joint.options.points), random);
  return rows.residual.empty() ? 1.0 : std::clamp(rows.brightness / usual_brightness, least_exposure, 1.0);
}

std::vector<float> floats(const std::vector<double>& values) { return {values.begin(), values.end()}; }

}  // namespace

std::vector<FaceFit> fit_pictures(const MorphableModel& model, const std::vector<const Image*>& pictures,
                                  const std::vector<const Landmarks*>& landmarks, const FitImageOptions& options) {
  check(pictures.size() == landmarks.size(), "there are ", pictures.size(), " pictures and ", landmarks.size(),
        " sets of points");
  check(!pictures.empty(), "there is no picture");
  Joint joint;
  joint.model = &model;
  joint.options = options;
  FitLandmarksOptions landmark_options;
  landmark_options.identities = options.identities;
  landmark_options.expressions = options.expressions;
  landmark_options.point_sigma = options.point_sigma;
  std::vector<FaceFit> fits;
  for (std::size_t m = 0; m < pictures.size(); ++m)
    fits.push_back(fit_landmarks(model, *landmarks[m], *pictures[m], landmark_options));
  if (std::any_of(fits.begin(), fits.end(), [](const FaceFit& fit) { return !fit.converged; })) {
    // A picture whose points are no use spoils them all; those without a problem of their own say so.
    for (FaceFit& fit : fits) {
      if (fit.converged) fit.problem = "the points of another picture of this person could not be used";
      fit.converged = false;
    }
    return fits;
  }
  joint.basis =
      make_skin_basis(model, static_cast<std::size_t>(options.identities),
                      static_cast<std::size_t>(options.expressions), static_cast<std::size_t>(options.albedos));
  joint.gaps = lip_gap_rows(model);
  joint.identity.assign(joint.basis.identities, 0.0);
  joint.albedo.assign(joint.basis.albedos, 0.0);
  for (std::size_t k = 0; k < joint.identity.size(); ++k)
    for (const FaceFit& fit : fits) joint.identity[k] += fit.identity[k] / static_cast<double>(fits.size());
  const Vec3f centre = turning_point(model);
  for (std::size_t m = 0; m < pictures.size(); ++m) {
    Picture& picture = joint.pictures.emplace_back();
    picture.image = pictures[m];
    picture.landmarks = make_landmark_basis(model, *landmarks[m], joint.basis.identities, joint.basis.expressions);
    picture.state.pose = pose_of(fits[m].camera, centre);
    picture.state.expression.assign(fits[m].expression.begin(), fits[m].expression.end());
    picture.log_focal = std::log(landmark_options.focal_share * std::max(pictures[m]->width, pictures[m]->height));
    const std::vector<Vec3f> points = posed(picture.landmarks, joined(joint.identity, picture.state.expression));
    picture.eyes_px = eye_distance_px(picture.landmarks, points, picture.state.pose);
    // The usual light over the camera, from a little above.
    picture.state.light.direction = {0.0f, 0.4f, 0.9165f};
  }
  Random random(static_cast<std::uint64_t>(options.seed));
  for (std::size_t m = 0; m < pictures.size(); ++m) joint.pictures[m].exposure = exposure_of(joint, m, random);
  std::vector<PictureLevel> levels;
  for (const Stage& stage : stages) {
    levels.clear();
    for (const Picture& picture : joint.pictures)
      levels.push_back(make_level(*picture.image, std::min(1.0, stage.eyes_px / picture.eyes_px), picture.exposure));
    joint.mirror_held = !stage.mirror;
    if (&stage == stages)
      for (int i = 0; i < light_steps; ++i) step(joint, levels, stage, true, random);
    joint.options.points = std::llround(stage.points * static_cast<double>(options.points));
    const std::int64_t steps = std::llround(stage.steps * static_cast<double>(options.steps));
    for (std::int64_t i = 0; i < steps; ++i) step(joint, levels, stage, false, random);
  }
  joint.mirror_held = true;  // or teeth pass for highlights of lips
  settle_mouths(
      levels,
      [&](Joint& tried) {
        for (int i = 0; i < mouth_steps; ++i) step(tried, levels, stages[std::size(stages) - 1], false, random);
      },
      joint);
  for (std::size_t m = 0; m < fits.size(); ++m) {
    FaceFit& fit = fits[m];
    PictureState& state = joint.pictures[m].state;
    const double exposure = joint.pictures[m].exposure;
    for (std::size_t c = 0; c < 3; ++c) {
      state.light.gain[c] = static_cast<float>(exposure * state.light.gain[c]);
      state.light.offset[c] = static_cast<float>(exposure * state.light.offset[c]);
    }
    fit.identity = floats(joint.identity);
    fit.albedo = floats(joint.albedo);
    fit.expression = floats(state.expression);
    fit.camera = camera_of(state.pose);
    fit.light = state.light;
    report(joint, m, make_level(*pictures[m], levels[m].factor),
           make_level(*pictures[m], std::min(1.0, likeness_eyes_px / joint.pictures[m].eyes_px)), fit);
  }
  return fits;
}

engine::Seq<FaceFit> fit_images(const MorphableModel& model, const engine::Seq<Image>& pictures,
                                const engine::Seq<Landmarks>& landmarks, const FitImageOptions& options) {
  std::vector<std::shared_ptr<const Image>> images;
  std::vector<std::shared_ptr<const Landmarks>> points;
  std::vector<const Image*> image_list;
  std::vector<const Landmarks*> point_list;
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    images.push_back(pictures.at(i));
    image_list.push_back(images.back().get());
    ids.push_back(pictures.id(i));
  }
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    points.push_back(landmarks.at(i));
    point_list.push_back(points.back().get());
  }
  return {fit_pictures(model, image_list, point_list, options), ids};
}

}  // namespace face::model
