// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/trace_outline.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "nodes/base/grey_spline.h"

namespace face::transfer {
namespace {

constexpr double step_px = 0.5;  // along a normal
constexpr double pull = 0.15;    // of a pixel squared from where the curve was, against levels
constexpr double turn = 3;       // of a step squared between neighbours
constexpr double most_levels = 25, dark_levels = 5, sure_levels = 15;
constexpr double stiffness = 4;

// Corners a pixel apart.
std::vector<Place> evenly(const std::vector<Place>& curve) {
  double whole = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Place &a = curve[i], &b = curve[(i + 1) % curve.size()];
    whole += length({b[0] - a[0], b[1] - a[1]});
  }
  const auto count = std::max<std::size_t>(12, static_cast<std::size_t>(std::lround(whole)));
  std::vector<Place> out;
  double way = 0;
  for (std::size_t i = 0; i < curve.size() && out.size() < count; ++i) {
    const Place &a = curve[i], &b = curve[(i + 1) % curve.size()];
    const double part = length({b[0] - a[0], b[1] - a[1]});
    while (out.size() < count) {
      const double wanted = whole * static_cast<double>(out.size()) / static_cast<double>(count);
      if (wanted > way + part) break;
      const double t = part > 0 ? (wanted - way) / part : 0;
      out.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
    }
    way += part;
  }
  return out;
}

std::vector<Place> softened(std::vector<Place> curve, int sweeps) {
  const std::size_t count = curve.size();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const std::vector<Place> before = curve;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < 2; ++k)
        curve[i][k] = 0.5 * before[i][k] + 0.25 * (before[(i + 1) % count][k] + before[(i + count - 1) % count][k]);
  }
  return curve;
}

// The curve of few harmonics nearest to places, robustly: a place a pixel off counts half.
std::vector<Place> of_harmonics(const std::vector<Place>& places, const std::vector<double>& sure, int harmonics) {
  const auto count = static_cast<Eigen::Index>(places.size());
  const Eigen::Index size = 2 * harmonics + 1;
  Eigen::MatrixXd basis(count, size);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    basis(i, 0) = 1;
    for (Eigen::Index h = 1; h <= harmonics; ++h) {
      basis(i, 2 * h - 1) = std::cos(static_cast<double>(h) * angle);
      basis(i, 2 * h) = std::sin(static_cast<double>(h) * angle);
    }
  }
  std::vector<Place> out = places;
  std::vector<double> weights = sure;
  for (int round = 0; round < 10; ++round) {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(size, size), sides = Eigen::MatrixXd::Zero(size, 2);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto p = static_cast<std::size_t>(i);
      sums += weights[p] * basis.row(i).transpose() * basis.row(i);
      sides += weights[p] * basis.row(i).transpose() * Eigen::RowVector2d(places[p][0], places[p][1]);
    }
    for (Eigen::Index h = 1; h <= harmonics; ++h)
      for (Eigen::Index k = 2 * h - 1; k <= 2 * h; ++k)
        sums(k, k) += 6e-6 * static_cast<double>(count) * std::pow(static_cast<double>(h), 4);
    const Eigen::MatrixXd solved = sums.ldlt().solve(sides);
    const Eigen::MatrixXd curve = basis * solved;
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto p = static_cast<std::size_t>(i);
      out[p] = {curve(i, 0), curve(i, 1)};
      const double away = length({out[p][0] - places[p][0], out[p][1] - places[p][1]});
      weights[p] = sure[p] / (1 + away * away);
    }
  }
  return out;
}

// A curve's normals, of length 1.
std::vector<Place> outward_normals(const std::vector<Place>& curve) {
  const std::size_t count = curve.size();
  std::vector<Place> normals;
  for (std::size_t i = 0; i < count; ++i) {
    const Place way = curve[(i + 3) % count] - curve[(i + count - 3) % count];
    const double size = std::max(length(way), 1e-9);
    normals.push_back({way[1] / size, -way[0] / size});
  }
  if (Outline{curve}.distance(curve[0] + 0.5 * normals[0]) < 0)
    for (Place& n : normals) n = {-n[0], -n[1]};
  return normals;
}

// Of a closed curve's places the one each that gains most in all, less what turns from one to the next cost; by dynamic
// programming. A closed curve ends where it began: every first place in turn.
std::vector<std::size_t> best_closed_path(const std::vector<std::vector<double>>& gains) {
  const std::size_t count = gains.size(), places = gains.front().size();
  const auto near = [&](std::size_t j, auto take) {
    for (std::size_t k = j < 2 ? 0 : j - 2; k <= std::min(places - 1, j + 2); ++k) {
      const double apart = static_cast<double>(j) - static_cast<double>(k);
      take(k, -turn * apart * apart);
    }
  };
  double best = -1e30;
  std::vector<std::size_t> chosen(count, places / 2);
  for (std::size_t first = 0; first < places; ++first) {
    std::vector<std::vector<double>> total(count, std::vector<double>(places, -1e30));
    std::vector<std::vector<std::size_t>> from(count, std::vector<std::size_t>(places, 0));
    total[0][first] = gains[0][first];
    for (std::size_t i = 1; i < count; ++i)
      for (std::size_t j = 0; j < places; ++j)
        near(j, [&](std::size_t k, double cost) {
          if (total[i - 1][k] + gains[i][j] + cost <= total[i][j]) return;
          total[i][j] = total[i - 1][k] + gains[i][j] + cost;
          from[i][j] = k;
        });
    near(first, [&](std::size_t last, double cost) {
      if (total[count - 1][last] + cost <= best) return;
      best = total[count - 1][last] + cost;
      std::size_t j = last;
      for (std::size_t i = count; i-- > 0;) {
        chosen[i] = j;
        j = from[i][j];
      }
    });
  }
  return chosen;
}

// Where between two steps the top of a parabola through a step's gain and those beside it is, from -0.5 to 0.5.
double beyond_step(const std::vector<double>& gains, std::size_t j) {
  if (j == 0 || j + 1 >= gains.size()) return 0;
  const double less = gains[j - 1], more = gains[j + 1], bend = less - 2 * gains[j] + more;
  return bend < 0 ? std::clamp(0.5 * (less - more) / bend, -0.5, 0.5) : 0;
}

// Moves a curve to the picture's edges near it.
class Outliner {
 public:
  explicit Outliner(const Image& picture) : grey_(picture) {}

  Outline about(const std::vector<Place>& border) const {
    std::vector<Place> curve = softened(evenly(border), 12);
    // Coarse: white against what is about it. Fine: every edge that is near.
    for (const auto& [most, harmonics] : {std::pair(10, 5), std::pair(6, 9), std::pair(2, 9)}) {
      const Search found = searched(curve, most, false);
      curve = of_harmonics(found.found, found.sure, harmonics);
    }
    for (int round = 0; round < 2; ++round) curve = held(searched(curve, 2, true));
    return {evenly(curve)};
  }

 private:
  // A curve, and where the picture's edges are on its normals.
  struct Search {
    std::vector<Place> curve, normals, found;
    std::vector<double> offsets, sure;
  };

  double smooth_grey(const Place& p) const {
    double sum = 0;
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) sum += (x == 0 ? 0.5 : 0.25) * (y == 0 ? 0.5 : 0.25) * grey_.at(p[0] + x, p[1] + y);
    return sum;
  }
  // Levels that it gets lighter outwards.
  double step(const Place& p, const Place& normal) const {
    return smooth_grey({p[0] + 0.5 * normal[0], p[1] + 0.5 * normal[1]}) -
           smooth_grey({p[0] - 0.5 * normal[0], p[1] - 0.5 * normal[1]});
  }

  // Places on the normals, `most` steps to either side, at the picture's edges; sure says how clear these are.
  Search searched(const std::vector<Place>& before, int most, bool fine) const {
    Search out;
    out.curve = evenly(before);
    out.normals = outward_normals(out.curve);
    const auto places = static_cast<std::size_t>(2 * most + 1);
    const auto away = [&](std::size_t j) { return step_px * (static_cast<double>(j) - most); };
    const auto on_normal = [&](std::size_t i, double offset) { return out.curve[i] + offset * out.normals[i]; };
    const auto value = [&](double levels, bool weighing) {
      if (levels < 0) return -levels;
      return fine ? std::min(levels, 8.0) : (weighing ? 0.2 : 0.5) * std::min(levels, dark_levels);
    };
    std::vector<std::vector<double>> gains(out.curve.size(), std::vector<double>(places));
    for (std::size_t i = 0; i < gains.size(); ++i)
      for (std::size_t j = 0; j < places; ++j)
        gains[i][j] =
            std::min(value(step(on_normal(i, away(j)), out.normals[i]), false), most_levels) - pull * away(j) * away(j);
    const std::vector<std::size_t> chosen = best_closed_path(gains);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      out.offsets.push_back(away(chosen[i]) + step_px * beyond_step(gains[i], chosen[i]));
      out.found.push_back(on_normal(i, out.offsets.back()));
      out.sure.push_back(std::clamp(value(step(out.found.back(), out.normals[i]), true) / sure_levels, 0.02, 1.0));
    }
    return out;
  }

  // The searched curve, where what was found counts by how sure it is and the way there changes smoothly.
  std::vector<Place> held(const Search& search) const {
    const auto count = static_cast<Eigen::Index>(search.curve.size());
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(count, count);
    Eigen::VectorXd side = Eigen::VectorXd::Zero(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto p = static_cast<std::size_t>(i);
      sums(i, i) += search.sure[p] + 0.01;
      side[i] += search.sure[p] * search.offsets[p];
      const std::array<Eigen::Index, 3> about = {(i + count - 1) % count, i, (i + 1) % count};
      constexpr std::array<double, 3> bend = {1, -2, 1};
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) sums(about[a], about[b]) += stiffness * bend[a] * bend[b];
    }
    const Eigen::VectorXd offset = sums.ldlt().solve(side);
    std::vector<Place> out;
    for (std::size_t i = 0; i < search.curve.size(); ++i) {
      const double o = offset[static_cast<Eigen::Index>(i)];
      out.push_back({search.curve[i][0] + o * search.normals[i][0], search.curve[i][1] + o * search.normals[i][1]});
    }
    return out;
  }

  GreySpline grey_;
};

}  // namespace

Outline trace_outline(const Image& picture, const std::vector<Place>& border) {
  return Outliner(picture).about(border);
}

}  // namespace face::transfer
