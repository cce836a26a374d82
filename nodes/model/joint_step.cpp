// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/joint_step.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "nodes/model/fit_landmarks.h"
#include "nodes/model/light_model.h"
#include "nodes/model/pixel_normal.h"
#include "nodes/model/pose_model.h"

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

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

// The normal equations of a step. Of a the lower triangle counts.
struct Normal {
  explicit Normal(std::size_t size) : a(Eigen::MatrixXd::Zero(at(size), at(size))), b(Vector::Zero(at(size))) {}

  // That what is changed by column comes to value less than it is, give or take sigma.
  void hold(Eigen::Index column, double value, double sigma) {
    a(column, column) += 1 / (sigma * sigma);
    b[column] -= value / (sigma * sigma);
  }
  // That what is changed by the columns from first on comes to error less, which each changes by so much as row says.
  void hold(Eigen::Index first, std::span<const double> row, double error, double weight) {
    const Eigen::Map<const Vector> g(row.data(), at(row.size()));
    a.block(first, first, g.size(), g.size()) += weight * g * g.transpose();
    b.segment(first, g.size()) -= weight * error * g;
  }

  Eigen::MatrixXd a;
  Vector b;
};

// Columns of what is a picture's own; what pictures share comes first: identity, then albedo.
struct OwnColumns {
  OwnColumns(const Joint& joint, std::size_t picture)
      : pose(at(joint.shared() + picture * joint.own())),
        expression(pose + at(FacePose::size)),
        light(expression + at(joint.basis.expressions)),
        mirror(light + at(first_mirror)) {}

  Eigen::Index pose, expression, light, mirror;
};

void add_pixels(std::size_t index, const PictureLevel& level, double share, Random& random, Joint& joint,
                Normal& normal) {
  const PixelRows rows =
      pixel_rows(joint.basis, joint.identity, skin_albedo(joint.basis, joint.albedo), joint.pictures[index].state,
                 level, joint.columns(), static_cast<std::size_t>(joint.options.points), random);
  if (rows.residual.empty()) return;
  const PixelNormal found = pixel_normal(rows);
  // The larger the differences, the more of them is what no coefficients explain; that is alike over whole regions, so
  // the picture counts as fewer independent points.
  const double noise = found.noise;
  joint.pictures[index].doubt = std::clamp(std::pow(found.median / explained, 2), 1.0, most_doubt);
  const double trust = (least_noise / noise) * (least_noise / noise);
  const double weight = share * trust * joint.options.image_weight / found.points / (noise * noise);
  const Eigen::Index width = at(rows.columns), shared = at(joint.shared()), own = at(joint.own());
  const Eigen::Index first = OwnColumns(joint, index).pose;
  const Eigen::Map<const Eigen::MatrixXd> a(found.a.data(), width, width);
  const Eigen::Map<const Vector> b(found.b.data(), width);
  normal.a.topLeftCorner(shared, shared) += weight * a.topLeftCorner(shared, shared);
  normal.a.block(first, 0, own, shared) += weight * a.bottomLeftCorner(own, shared);
  normal.a.block(first, first, own, own) += weight * a.bottomRightCorner(own, own);
  normal.b.head(shared) += weight * b.head(shared);
  normal.b.segment(first, own) += weight * b.tail(own);
}

void add_points(std::size_t index, double share, Joint& joint, Normal& normal) {
  Picture& picture = joint.pictures[index];
  const std::vector<Vec3f> points = posed(picture.landmarks, joined(joint.identity, picture.state.expression));
  assign_contours(points, picture.state.pose, picture.landmarks);
  const LandmarkRows rows = landmark_rows(picture.landmarks, points, picture.state.pose);
  const double sigma = joint.options.point_sigma * eye_distance_px(picture.landmarks, points, picture.state.pose);
  const OwnColumns own(joint, index);
  Vector row = Vector::Zero(normal.b.size());
  for (std::size_t i = 0; i < rows.residual_px.size(); ++i) {
    const double* from = rows.jacobian.data() + i * rows.columns;
    for (std::size_t k = 0; k < FacePose::size; ++k) row[own.pose + at(k)] = *from++;
    for (std::size_t k = 0; k < joint.basis.identities; ++k) row[at(k)] = *from++;
    for (std::size_t k = 0; k < joint.basis.expressions; ++k) row[own.expression + at(k)] = *from++;
    const double error = std::abs(rows.residual_px[i]) / sigma;
    const double robust = error > huber_sigmas ? huber_sigmas / error : 1.0;
    const double weight = picture.doubt * share * robust / (sigma * sigma);
    normal.a.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
    normal.b -= row * (weight * rows.residual_px[i]);
  }
}

// Priors of identity and albedo (equation 8).
void add_person_priors(const Joint& joint, Normal& normal) {
  double doubt = 0;
  for (const Picture& picture : joint.pictures) doubt += picture.doubt / static_cast<double>(joint.pictures.size());
  for (std::size_t k = 0; k < joint.identity.size(); ++k)
    normal.hold(at(k), joint.identity[k], joint.model->identity.sigmas[k] / std::sqrt(doubt));
  for (std::size_t k = 0; k < joint.albedo.size(); ++k)
    normal.hold(at(joint.basis.identities + k), joint.albedo[k], joint.model->albedo.sigmas[k]);
}

// The turn, place and size are held near the present ones only: their start is no prior knowledge.
void add_pose_priors(const Picture& picture, const OwnColumns& own, Normal& normal) {
  for (Eigen::Index k = 0; k < 3; ++k) normal.hold(own.pose + k, 0, turn_sigma);
  normal.hold(own.pose + 3, 0, place_sigma_px);
  normal.hold(own.pose + 4, 0, place_sigma_px);
  normal.hold(own.pose + 5, 0, scale_sigma);
  normal.hold(own.pose + 6, picture.state.pose.log_focal - picture.log_focal, focal_sigma / std::sqrt(picture.doubt));
}

// And lips that do not run into each other, nor part without a reason.
void add_expression_priors(const Joint& joint, std::size_t index, const OwnColumns& own, Normal& normal) {
  const Picture& picture = joint.pictures[index];
  const std::span<const double> expression(picture.state.expression.data(), joint.basis.expressions);
  for (std::size_t k = 0; k < expression.size(); ++k)
    normal.hold(own.expression + at(k), expression[k], joint.model->expression.sigmas[k] / std::sqrt(picture.doubt));
  const bool held_open = picture.held_gap_mm > 0;
  for (const std::vector<double>& of_all : joint.gaps) {
    const std::span<const double> row(of_all.data(), expression.size());  // the model may have more than are fitted
    double gap_mm = 0;
    for (std::size_t k = 0; k < expression.size(); ++k) gap_mm += row[k] * expression[k];
    if (held_open && gap_mm >= 0) continue;
    const double sigma_mm = picture.closed ? closed_sigma_mm
                            : gap_mm < 0   ? overlap_sigma_mm
                                           : joint.options.mouth_sigma_mm;
    const double wide = gap_mm / sigma_mm;
    const double pairs =
        picture.closed || gap_mm < 0 ? 1.0 : static_cast<double>(joint.gaps.size()) * (1 + wide * wide);
    normal.hold(own.expression, row, gap_mm, picture.doubt / (sigma_mm * sigma_mm) / pairs);
  }
  if (held_open)
    normal.hold(own.expression, mean_gap_row(joint), gap_of(joint, index) - picture.held_gap_mm,
                picture.doubt / (closed_sigma_mm * closed_sigma_mm));
}

void add_light_priors(const FaceLight& now, bool mirror_held, const OwnColumns& own, Normal& normal) {
  const FaceLight usual;
  for (std::size_t c = 0; c < 3; ++c) {
    normal.hold(own.light + at(c), now.ambient[c] - usual.ambient[c], light_sigma[0]);
    normal.hold(own.light + 3 + at(c), now.parallel[c] - usual.parallel[c], light_sigma[3]);
    normal.hold(own.light + 9 + at(c), now.gain[c] - 1.0, light_sigma[9]);
    normal.hold(own.light + 12 + at(c), now.offset[c], light_sigma[12]);
  }
  normal.hold(own.light + 6, 0, light_sigma[6]);
  normal.hold(own.light + 7, 0, light_sigma[7]);
  normal.hold(own.light + 8, now.contrast - 1.0, light_sigma[8]);
  for (std::size_t k = 0; k < lobe_count; ++k)
    if (mirror_held)
      normal.hold(own.mirror + at(k), 0, held_sigma);
    else
      normal.hold(own.mirror + at(k), now.mirror[k], light_sigma[first_mirror + k]);
}

// All but light and the leading components of albedo, which are skin's tone.
void hold_shapes(const Joint& joint, Normal& normal) {
  constexpr std::size_t tones = 3;
  for (std::size_t k = 0; k < joint.shared(); ++k)
    if (k < joint.basis.identities || k >= joint.basis.identities + tones) normal.hold(at(k), 0, held_sigma);
  for (std::size_t m = 0; m < joint.pictures.size(); ++m)
    for (Eigen::Index k = OwnColumns(joint, m).pose; k < OwnColumns(joint, m).light; ++k) normal.hold(k, 0, held_sigma);
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
        const Eigen::Index column = OwnColumns(joint, m).mirror + at(k);
        if (now + found[column] > -held_sigma) continue;
        any = true;
        normal.hold(column, now, held_sigma);
      }
    if (!any) break;
    found = normal.a.selfadjointView<Eigen::Lower>().ldlt().solve(normal.b);
  }
  return found;
}

double within(double value, double limit) { return std::clamp(value, -limit, limit); }

// No number goes farther in one step than it usually is off.
void apply(const Vector& step, Joint& joint) {
  for (std::size_t k = 0; k < joint.identity.size(); ++k)
    joint.identity[k] += within(step[at(k)], joint.model->identity.sigmas[k]);
  for (std::size_t k = 0; k < joint.albedo.size(); ++k)
    joint.albedo[k] += within(step[at(joint.basis.identities + k)], joint.model->albedo.sigmas[k]);
  for (std::size_t m = 0; m < joint.pictures.size(); ++m) {
    PictureState& state = joint.pictures[m].state;
    const OwnColumns own(joint, m);
    const double place_px = 0.1 * joint.pictures[m].eyes_px;
    const double limits[FacePose::size] = {0.15, 0.15, 0.15, place_px, place_px, 0.1, 0.2};
    std::array<double, FacePose::size> turn{};
    for (std::size_t k = 0; k < turn.size(); ++k) turn[k] = within(step[own.pose + at(k)], limits[k]);
    state.pose = moved(state.pose, turn);
    for (std::size_t k = 0; k < state.expression.size(); ++k)
      state.expression[k] += within(step[own.expression + at(k)], joint.model->expression.sigmas[k]);
    std::array<double, light_parameters> light{};
    for (std::size_t k = 0; k < light.size(); ++k) light[k] = within(step[own.light + at(k)], light_sigma[k]);
    state.light = moved(state.light, light.data());
  }
}

}  // namespace

void step_joint(const std::vector<PictureLevel>& levels, const StepWeights& weights, Random& random, Joint& joint) {
  Normal normal(joint.shared() + joint.own() * joint.pictures.size());
  for (std::size_t m = 0; m < joint.pictures.size(); ++m) {
    Picture& picture = joint.pictures[m];
    if (!weights.light_only) picture.state.seen = shadow_of(joint.basis, joint.identity, picture.state);
    add_pixels(m, levels[m], weights.image, random, joint, normal);
    add_points(m, weights.points, joint, normal);
  }
  add_person_priors(joint, normal);
  for (std::size_t m = 0; m < joint.pictures.size(); ++m) {
    const Picture& picture = joint.pictures[m];
    const OwnColumns own(joint, m);
    add_pose_priors(picture, own, normal);
    add_expression_priors(joint, m, own, normal);
    add_light_priors(picture.state.light, joint.mirror_held, own, normal);
  }
  if (weights.light_only) hold_shapes(joint, normal);
  apply(solved(joint, std::move(normal)), joint);
}

}  // namespace face::model
