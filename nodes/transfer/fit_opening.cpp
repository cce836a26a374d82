// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/fit_opening.h"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "nodes/base/luma.h"
#include "nodes/base/srgb.h"
#include "nodes/transfer/share_slopes.h"

namespace face::transfer {
namespace {

// Costs in squared grey levels: of a vertex that leaves the line of its neighbours by a pixel, along the hole's edge
// and elsewhere, or them by a pixel; of the rim, a pixel off; of light that changes by a factor of e from one place of
// its grid to the next, and as a whole; of an eye a pixel off, and one that is stretched by 2 %.
constexpr double bend_along = 200, bend = 20, stretch = 0.05, rim = 3, uneven_light = 20000, any_light = 20,
                 eye_place = 3, eye_form = 400;
constexpr double form_scale = 50;  // pixels: half an eye
// In turn: differences so large count half (Cauchy), and bends count so many times what they do in the end.
struct Stage {
  double wild_levels, stiff;
};
constexpr std::array<Stage, 3> stages = {{{40, 16}, {20, 4}, {10, 1}}};
constexpr double longest_step_px = 2, largest_step_light = 0.3;
constexpr int iterations = 25, tries = 5;
constexpr double enough = 1e-3;  // of the cost, in one step

using Term = std::pair<int, double>;

// How a pixel's skin changes to the right and downwards, by the pixels beside it that see skin.
Place skin_slope(const OpeningView::Pixel& here, const OpeningView::Pixel& left, const OpeningView::Pixel& right,
                 const OpeningView::Pixel& above, const OpeningView::Pixel& below) {
  const auto slope = [&](const OpeningView::Pixel& before, const OpeningView::Pixel& after) {
    const bool has_before = before.vertex_count > 0, has_after = after.vertex_count > 0;
    if (has_before && has_after) return 0.5 * (after.skin - before.skin);
    return has_after ? after.skin - here.skin : has_before ? here.skin - before.skin : 0.0;
  };
  return {slope(left, right), slope(above, below)};
}

// Sums of squares of linear residuals.
class Normal {
 public:
  explicit Normal(int unknowns) : side(Eigen::VectorXd::Zero(unknowns)) {}
  void add(std::span<const Term> row, double residual, double weight) {
    for (const auto& [a, of_a] : row) {
      side[a] += weight * of_a * residual;
      for (const auto& [b, of_b] : row) matrix.emplace_back(a, b, weight * of_a * of_b);
    }
  }
  std::vector<Eigen::Triplet<double>> matrix;
  Eigen::VectorXd side;
};

class Fit {
 public:
  Fit(const OpeningScene& scene, const Image& frame, const OpeningPose& held, const Stage& stage)
      : scene_(scene),
        sheet_(scene.sheet()),
        frame_(frame),
        held_(held),
        wild_(stage.wild_levels),
        stiff_(stage.stiff),
        first_light_(2 * static_cast<int>(sheet_.places.size())),
        first_eye_(first_light_ + scene.light_columns() * scene.light_rows()),
        unknowns_(first_eye_ + 6) {}

  double cost(const OpeningPose& pose, const OpeningView& view) const {
    double sum = 0;
    each_difference(view, [&](int, int, const OpeningView::Pixel&, double difference) {
      sum += wild_ * wild_ * std::log1p(std::pow(difference / wild_, 2));
    });
    each_held(pose,
              [&](std::span<const Term>, double residual, double weight) { sum += weight * residual * residual; });
    return sum;
  }

  Normal normal(const OpeningPose& pose, const OpeningView& view) const {
    Normal out(unknowns_);
    const std::vector<std::vector<ShareSlope>> covering = share_slopes(sheet_, pose, view);
    std::vector<Term> terms;
    each_difference(view, [&](int x, int y, const OpeningView::Pixel& pixel, double difference) {
      const auto at = [&](int px, int py) -> const OpeningView::Pixel& { return view.at(px, py); };
      const auto &left = at(x - 1, y), &right = at(x + 1, y), &above = at(x, y - 1), &below = at(x, y + 1);
      if (!left.drawn || !right.drawn || !above.drawn || !below.drawn) return;
      const double weight = 1 / (1 + std::pow(difference / wild_, 2));
      const double light = std::max(pixel.share * pixel.skin + (1 - pixel.share) * pixel.eye, 1e-4);
      const double slope = 255 * srgb_slope(light), eye_share = 1 - pixel.share;
      // The eye's own gradient, in the reference's picture.
      Place eye{};
      if (eye_share > 0.001)
        for (std::size_t k = 0; k < 2; ++k) {
          Place less = pixel.eye_place, more = pixel.eye_place;
          less[k] -= 0.5;
          more[k] += 0.5;
          eye[k] = eye_share * slope * (scene_.eye_light(more) - scene_.eye_light(less));
        }
      terms.clear();
      // Skin that moves within the pixel, and skin that comes to cover the eye.
      const Place skin = (pixel.share * slope) * skin_slope(pixel, left, right, above, below);
      for (std::size_t k = 0; k < pixel.vertex_count; ++k) {
        const auto [vertex, share] = pixel.vertices[k];
        terms.push_back({2 * static_cast<int>(vertex), -skin[0] * share});
        terms.push_back({2 * static_cast<int>(vertex) + 1, -skin[1] * share});
      }
      if (pixel.share > 0)
        for (const ShareSlope& edge : covering[view.index(x, y)]) {
          const double covered = slope * (pixel.skin - pixel.eye);
          terms.push_back({2 * static_cast<int>(edge.vertex), covered * edge.slope[0]});
          terms.push_back({2 * static_cast<int>(edge.vertex) + 1, covered * edge.slope[1]});
        }
      if (pixel.share > 0.02)
        for (const auto& [i, w] : scene_.light_at(pixel.skin_place))
          terms.push_back({first_light_ + static_cast<int>(i), slope * pixel.share * pixel.skin * w});
      if (eye_share > 0.02) {
        const std::array<double, 6> moved = {eye[0] * x / form_scale,
                                             eye[0] * y / form_scale,
                                             eye[1] * x / form_scale,
                                             eye[1] * y / form_scale,
                                             eye[0],
                                             eye[1]};
        for (std::size_t k = 0; k < 6; ++k) terms.push_back({first_eye_ + static_cast<int>(k), moved[k]});
      }
      out.add(terms, difference, weight);
    });
    each_held(pose,
              [&](std::span<const Term> row, double residual, double weight) { out.add(row, -residual, weight); });
    return out;
  }

  OpeningPose moved(OpeningPose pose, const Eigen::VectorXd& step) const {
    for (std::size_t v = 0; v < pose.vertices.size(); ++v) {
      const auto i = static_cast<Eigen::Index>(2 * v);
      const double length = std::hypot(step[i], step[i + 1]);
      const double share = length > longest_step_px ? longest_step_px / length : 1;
      pose.vertices[v][0] += share * step[i];
      pose.vertices[v][1] += share * step[i + 1];
    }
    for (std::size_t i = 0; i < pose.light.size(); ++i)
      pose.light[i] +=
          std::clamp(step[first_light_ + static_cast<Eigen::Index>(i)], -largest_step_light, largest_step_light);
    for (std::size_t k = 0; k < 6; ++k)
      pose.eye_from_frame[k] += step[first_eye_ + static_cast<Eigen::Index>(k)] / (k < 4 ? form_scale : 1);
    return pose;
  }

 private:
  template <class Take>
  void each_difference(const OpeningView& view, Take take) const {
    for (int y = std::max(view.top, 1); y < std::min(view.top + view.height, frame_.height) - 1; ++y)
      for (int x = std::max(view.left, 1); x < std::min(view.left + view.width, frame_.width) - 1; ++x) {
        if (x == view.left || y == view.top) continue;
        const OpeningView::Pixel& pixel = view.at(x, y);
        if (pixel.drawn) take(x, y, pixel, grey(x, y) - pixel.grey);
      }
  }

  // What is held together: take(row, residual, weight).
  template <class Take>
  void each_held(const OpeningPose& pose, Take take) const {
    const auto motion = [&](std::uint32_t v, std::size_t k) { return pose.vertices[v][k] - sheet_.places[v][k]; };
    const auto unknown = [](std::uint32_t v, std::size_t k) { return static_cast<int>(2 * v + k); };
    for (std::size_t k = 0; k < 2; ++k) {
      for (const OpeningSheet::Line& line : sheet_.lines) {
        const auto [a, b, c] = line.vertices;
        const double s = line.share;
        const std::array<Term, 3> row = {{{unknown(a, k), 1}, {unknown(b, k), -1 - s}, {unknown(c, k), s}}};
        take(row, motion(a, k) - (1 + s) * motion(b, k) + s * motion(c, k),
             stiff_ * (line.along_outline ? bend_along / ((1 + s) * (1 + s)) : bend));
      }
      for (const auto& [a, b] : sheet_.edges) {
        const std::array<Term, 2> row = {{{unknown(a, k), 1}, {unknown(b, k), -1}}};
        take(row, motion(a, k) - motion(b, k), stretch);
      }
      for (const std::uint32_t v : sheet_.rim) {
        const std::array<Term, 1> row = {{{unknown(v, k), 1}}};
        take(row, pose.vertices[v][k] - held_.vertices[v][k], rim);
      }
    }
    const int columns = scene_.light_columns(), rows = scene_.light_rows();
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) {
        const int here = y * columns + x;
        const auto light = [&](int i) { return pose.light[static_cast<std::size_t>(i)]; };
        const std::array<Term, 1> row = {{{first_light_ + here, 1}}};
        take(row, light(here), any_light);
        for (const int next : {x + 1 < columns ? here + 1 : -1, y + 1 < rows ? here + columns : -1}) {
          if (next < 0) continue;
          const std::array<Term, 2> pair = {{{first_light_ + here, 1}, {first_light_ + next, -1}}};
          take(pair, light(here) - light(next), uneven_light);
        }
      }
    for (std::size_t k = 0; k < 6; ++k) {
      const std::array<Term, 1> row = {{{first_eye_ + static_cast<int>(k), 1}}};
      take(row, (pose.eye_from_frame[k] - held_.eye_from_frame[k]) * (k < 4 ? form_scale : 1),
           k < 4 ? eye_form : eye_place);
    }
  }

  double grey(int x, int y) const {
    const std::uint8_t* p = frame_.pixels.data() +
                            static_cast<std::size_t>(y * frame_.width + x) * static_cast<std::size_t>(frame_.channels);
    return grey_value<double>(p, frame_.channels);
  }

  const OpeningScene& scene_;
  const OpeningSheet& sheet_;
  const Image& frame_;
  const OpeningPose& held_;
  double wild_, stiff_;
  int first_light_, first_eye_, unknowns_;
};

FitOpeningResult fit_once(const OpeningScene& scene, const Image& frame, const OpeningPose& start,
                          const OpeningPose& held, const Stage& stage) {
  const Fit fit(scene, frame, held, stage);
  FitOpeningResult result{start, 0};
  OpeningView view = scene.view(result.pose);
  result.cost = fit.cost(result.pose, view);
  double damping = 1e-2;
  for (int i = 0; i < iterations; ++i) {
    const Normal normal = fit.normal(result.pose, view);
    Eigen::SparseMatrix<double> matrix(normal.side.size(), normal.side.size());
    matrix.setFromTriplets(normal.matrix.begin(), normal.matrix.end());
    const Eigen::VectorXd diagonal = matrix.diagonal();
    bool better = false;
    double gained = 0;
    for (int attempt = 0; attempt < tries && !better; ++attempt) {
      Eigen::SparseMatrix<double> damped = matrix;
      for (Eigen::Index k = 0; k < diagonal.size(); ++k) damped.coeffRef(k, k) += damping * diagonal[k] + 1e-6;
      const Eigen::VectorXd step = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(damped).solve(normal.side);
      if (!step.allFinite()) {
        damping *= 8;
        continue;
      }
      const OpeningPose pose = fit.moved(result.pose, step);
      OpeningView seen = scene.view(pose);
      const double cost = fit.cost(pose, seen);
      better = cost < result.cost;
      damping = better ? std::max(0.3 * damping, 1e-4) : 8 * damping;
      if (!better) continue;
      gained = result.cost - cost;
      result = {pose, cost};
      view = std::move(seen);
    }
    if (!better || gained < enough * result.cost) break;
  }
  return result;
}

}  // namespace

FitOpeningResult fit_opening(const OpeningScene& scene, const Image& frame, const OpeningPose& start,
                             const OpeningPose& held) {
  FitOpeningResult result{start, 0};
  for (const Stage& stage : stages) result = fit_once(scene, frame, result.pose, held, stage);
  return result;
}

}  // namespace face::transfer
