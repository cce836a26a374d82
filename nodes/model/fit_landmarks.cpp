// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/fit_landmarks.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "nodes/base/check.h"
#include "nodes/model/landmark_basis.h"
#include "nodes/model/pose_model.h"

namespace face::model {
namespace {

constexpr std::size_t least_points = 6;   // below, not even the pose is determined well
constexpr double huber = 2.5;             // sigmas from which an error counts linearly only
constexpr double outside_share = 0.25;    // of the points, up to which some may lie outside the picture
constexpr double overlap_sigma_mm = 0.3;  // of lips that run into each other
constexpr double closed_sigma_mm = 0.1;   // of a mouth that is held closed
constexpr double start_yaws_deg[] = {0, -35, 35};

using Vector = Eigen::VectorXd;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct State {
  FacePose pose;
  std::vector<double> coefficients;
  double cost = 1e300;  // of the data and the prior, squared sigmas
};

struct Problem {
  LandmarkBasis basis;
  std::vector<double> sigmas;             // of the coefficients
  std::vector<std::vector<double>> gaps;  // mm per lip pair and coefficient of expression
  double log_focal = 7;
  const FitLandmarksOptions* options = nullptr;
  bool closed = false;
  bool coefficients_free = false;
};

// Cost at a state; with the normal equations of a step where they are asked for.
double evaluate(const Problem& problem, const State& state, Eigen::MatrixXd* a, Vector* b) {
  const LandmarkBasis& basis = problem.basis;
  const std::vector<Vec3f> points = posed(basis, state.coefficients);
  const LandmarkRows rows = landmark_rows(basis, points, state.pose);
  const double sigma = problem.options->point_sigma * eye_distance_px(basis, points, state.pose);
  const auto columns = static_cast<Eigen::Index>(rows.columns);
  if (a != nullptr) {
    a->setZero(columns, columns);
    b->setZero(columns);
  }
  double cost = 0;
  RowMatrix weighted(static_cast<Eigen::Index>(rows.residual_px.size()), columns);
  Vector residual(weighted.rows());
  for (std::size_t i = 0; i < basis.points.size(); ++i) {
    const double error = std::hypot(rows.residual_px[2 * i], rows.residual_px[2 * i + 1]) / sigma;
    const double weight = error > huber ? huber / error : 1.0;
    cost += error > huber ? huber * (2 * error - huber) : error * error;
    const double root = std::sqrt(weight) / sigma;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto row = static_cast<Eigen::Index>(2 * i + axis);
      residual[row] = rows.residual_px[2 * i + axis] * root;
      if (a != nullptr)
        weighted.row(row) = Eigen::Map<const Eigen::RowVectorXd>(rows.jacobian.data() + row * columns, columns) * root;
    }
  }
  if (a != nullptr) {
    a->noalias() = weighted.transpose() * weighted;
    b->noalias() = -weighted.transpose() * residual;
  }
  const auto add_prior = [&](Eigen::Index column, double value, double prior_sigma) {
    cost += value * value / (prior_sigma * prior_sigma);
    if (a == nullptr) return;
    (*a)(column, column) += 1 / (prior_sigma * prior_sigma);
    (*b)[column] -= value / (prior_sigma * prior_sigma);
  };
  add_prior(6, state.pose.log_focal - problem.log_focal, problem.options->focal_sigma);
  if (!problem.coefficients_free) {
    if (a != nullptr)
      for (Eigen::Index k = FacePose::size; k < columns; ++k) {
        a->row(k).setZero();
        a->col(k).setZero();
        (*a)(k, k) = 1;
        (*b)[k] = 0;
      }
    return cost;
  }
  for (std::size_t k = 0; k < basis.coefficients(); ++k)
    add_prior(static_cast<Eigen::Index>(FacePose::size + k), state.coefficients[k], problem.sigmas[k]);
  const auto first = static_cast<Eigen::Index>(FacePose::size + basis.identities);
  for (const std::vector<double>& row : problem.gaps) {
    double gap = 0;
    for (std::size_t k = 0; k < basis.expressions; ++k) gap += row[k] * state.coefficients[basis.identities + k];
    if (!problem.closed && gap >= 0) continue;
    const double gap_sigma = problem.closed ? closed_sigma_mm : overlap_sigma_mm;
    cost += gap * gap / (gap_sigma * gap_sigma);
    if (a == nullptr) continue;
    const Eigen::Map<const Vector> g(row.data(), static_cast<Eigen::Index>(basis.expressions));
    a->block(first, first, g.size(), g.size()) += g * g.transpose() / (gap_sigma * gap_sigma);
    b->segment(first, g.size()) -= g * gap / (gap_sigma * gap_sigma);
  }
  return cost;
}

void assign(Problem& problem, State& state) {
  assign_contours(posed(problem.basis, state.coefficients), state.pose, problem.basis);
}

void minimise(Problem& problem, State& state, std::int64_t iterations) {
  double damping = 1e-3;
  Eigen::MatrixXd a;
  Vector b;
  for (std::int64_t i = 0; i < iterations; ++i) {
    assign(problem, state);
    state.cost = evaluate(problem, state, &a, &b);
    bool stepped = false;
    for (int attempt = 0; attempt < 6 && !stepped; ++attempt) {
      Eigen::MatrixXd damped = a;
      damped.diagonal() *= 1 + damping;
      const Vector step = damped.ldlt().solve(b);
      State next = state;
      std::array<double, FacePose::size> turn{};
      for (std::size_t k = 0; k < FacePose::size; ++k) turn[k] = step[static_cast<Eigen::Index>(k)];
      for (std::size_t k = 0; k < 3; ++k) turn[k] = std::clamp(turn[k], -0.5, 0.5);
      next.pose = moved(state.pose, turn);
      for (std::size_t k = 0; k < state.coefficients.size(); ++k)
        next.coefficients[k] += step[static_cast<Eigen::Index>(FacePose::size + k)];
      next.cost = evaluate(problem, next, nullptr, nullptr);
      if (next.cost <= state.cost) {
        stepped = true;
        const bool done = state.cost - next.cost < 1e-4 * (1 + state.cost) && i > 3;
        state = std::move(next);
        damping = std::max(damping * 0.2, 1e-7);
        if (done) return;
      } else {
        damping *= 8;
      }
    }
    if (!stepped) return;
  }
}

// The pose of the mean face seen from one direction whose points have the place and spread of the given ones.
State start(const Problem& problem, const Vec3f& centre, const Image& picture, double yaw_deg) {
  State state;
  state.coefficients.assign(problem.basis.coefficients(), 0.0);
  FacePose& pose = state.pose;
  const double yaw = yaw_deg * std::numbers::pi / 180.0;
  pose.rotation = {std::cos(yaw), 0, std::sin(yaw), 0, 1, 0, -std::sin(yaw), 0, std::cos(yaw)};
  for (std::size_t k = 0; k < 3; ++k) pose.centre_mm[k] = centre[k];
  pose.middle_x_px = pose.u_px = 0.5 * (picture.width - 1);
  pose.middle_y_px = pose.v_px = 0.5 * (picture.height - 1);
  pose.log_focal = problem.log_focal;
  pose.log_scale = 0;
  double n = 0, x = 0, y = 0, mx = 0, my = 0, spread = 0, model_spread = 0;
  for (int pass = 0; pass < 2; ++pass)
    for (const LandmarkBasis::Point& point : problem.basis.points) {
      if (point.contour) continue;
      const PoseView seen = view(pose, problem.basis.mean_mm[point.vertex]);
      if (pass == 0) {
        ++n;
        x += point.x_px;
        y += point.y_px;
        mx += seen.x_px;
        my += seen.y_px;
      } else {
        spread += std::pow(point.x_px - x / n, 2) + std::pow(point.y_px - y / n, 2);
        model_spread += std::pow(seen.x_px - mx / n, 2) + std::pow(seen.y_px - my / n, 2);
      }
    }
  const double scale = std::sqrt(spread / model_spread);
  pose.log_scale = std::log(scale);
  const double ox = (mx / n - pose.middle_x_px) * scale, oy = (my / n - pose.middle_y_px) * scale;
  pose.u_px = x / n - ox;
  pose.v_px = y / n - oy;
  return state;
}

std::string list_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// Judges the fit and fills in its figures.
void report(const Problem& problem, const State& state, FaceFit& fit) {
  const std::vector<Vec3f> points = posed(problem.basis, state.coefficients);
  const LandmarkRows rows = landmark_rows(problem.basis, points, state.pose);
  const double eyes = eye_distance_px(problem.basis, points, state.pose);
  double sum = 0, squares = 0;
  std::vector<std::string> odd;
  const double odd_px = std::max(3 * problem.options->max_nme, 8 * problem.options->point_sigma) * eyes;
  for (std::size_t i = 0; i < problem.basis.points.size(); ++i) {
    const double error = std::hypot(rows.residual_px[2 * i], rows.residual_px[2 * i + 1]);
    sum += error;
    squares += error * error;
    if (error > odd_px) odd.push_back(problem.basis.points[i].name);
  }
  const double count = static_cast<double>(problem.basis.points.size());
  fit.landmark_rms_px = std::sqrt(squares / count);
  fit.landmark_nme = sum / count / eyes;
  std::ostringstream text;
  text.precision(3);
  double largest = 0;
  for (std::size_t k = 0; k < problem.sigmas.size(); ++k)
    largest = std::max(largest, std::abs(state.coefficients[k]) / problem.sigmas[k]);
  if (turn_deg(state.pose) > problem.options->max_turn_deg)
    text << "the head is turned by " << turn_deg(state.pose) << " degrees, more than " << problem.options->max_turn_deg
         << ": use a picture in which both eyes are seen";
  else if (!odd.empty())
    text << "the points contradict each other; check these: " << list_of(odd);
  else if (fit.landmark_nme > problem.options->max_nme)
    text << "the points lie " << 100 * fit.landmark_nme << " % of the eye distance off on average, expected at most "
         << 100 * problem.options->max_nme << " %: check their names and places";
  fit.problem = text.str();
  fit.converged = fit.problem.empty() && std::isfinite(state.cost);
}

}  // namespace

FaceFit fit_landmarks(const MorphableModel& model, const Landmarks& landmarks, const Image& picture,
                      const FitLandmarksOptions& options) {
  check(picture.width > 0 && picture.height > 0, "the picture is empty");
  Problem problem;
  problem.options = &options;
  problem.basis = make_landmark_basis(model, landmarks, static_cast<std::size_t>(options.identities),
                                      static_cast<std::size_t>(options.expressions));
  const LandmarkBasis& basis = problem.basis;
  problem.log_focal = std::log(options.focal_share * std::max(picture.width, picture.height));
  problem.sigmas.assign(model.identity.sigmas.begin(),
                        model.identity.sigmas.begin() + static_cast<std::ptrdiff_t>(basis.identities));
  problem.sigmas.insert(problem.sigmas.end(), model.expression.sigmas.begin(),
                        model.expression.sigmas.begin() + static_cast<std::ptrdiff_t>(basis.expressions));
  problem.gaps = lip_gap_rows(model);

  FaceFit fit;
  fit.image_width_px = picture.width;
  fit.image_height_px = picture.height;
  const std::size_t fixed = static_cast<std::size_t>(
      std::count_if(basis.points.begin(), basis.points.end(), [](const auto& point) { return !point.contour; }));
  if (fixed < least_points) {
    fit.problem = message("found ", fixed, " points besides those on the outline, expected at least ", least_points,
                          ": add corners of eyes and mouth, nose tip, chin");
    return fit;
  }
  std::vector<std::string> outside;
  for (const LandmarkBasis::Point& point : basis.points)
    if (!(point.x_px > -1 && point.y_px > -1 && point.x_px < picture.width && point.y_px < picture.height))
      outside.push_back(point.name);
  if (outside.size() > outside_share * static_cast<double>(basis.points.size())) {
    fit.problem = message("the picture is ", picture.width, " x ", picture.height, " pixels, but outside of it are ",
                          list_of(outside), ": use the points of this picture, and one that shows the whole face");
    return fit;
  }
  const Vec3f centre = turning_point(model);
  State best;
  for (const double yaw_deg : start_yaws_deg) {
    State state = start(problem, centre, picture, yaw_deg);
    if (!std::isfinite(state.pose.log_scale)) {
      fit.problem = "the points all lie at one place: place them on the features they are named after";
      return fit;
    }
    minimise(problem, state, 10);
    if (state.cost < best.cost) best = std::move(state);
  }
  problem.coefficients_free = true;
  problem.closed = true;
  State closed = best;
  minimise(problem, closed, options.iterations);
  problem.closed = false;
  State open = closed;
  minimise(problem, open, options.iterations);
  best = closed.cost - open.cost < options.mouth_evidence ? closed : open;
  assign(problem, best);

  fit.camera = camera_of(best.pose);
  fit.identity.assign(best.coefficients.begin(),
                      best.coefficients.begin() + static_cast<std::ptrdiff_t>(basis.identities));
  fit.expression.assign(best.coefficients.begin() + static_cast<std::ptrdiff_t>(basis.identities),
                        best.coefficients.end());
  fit.lip_gap_mm = lip_gap_of(model, fit.expression);
  report(problem, best, fit);
  return fit;
}

}  // namespace face::model
