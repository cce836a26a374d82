// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/closest_combination.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "nodes/base/check.h"
#include "nodes/model/cylinder_grid.h"
#include "nodes/model/region_pca.h"
#include "nodes/model/scan_surface.h"

namespace face::model {
namespace {

constexpr std::size_t looked_up = 5000;         // vertices, at most
constexpr double coarse_px = 5, fine_px = 1.2;  // of the blur
constexpr std::size_t tried_modes = 6;
constexpr double tried_sigmas = 1.5;
constexpr double prior_weight = 0.002;  // of the squared coefficients to the mean of e / (1 + e)

// Blurred, with what is not measured left out.
CylinderScan blurred(const CylinderScan& scan, double sigma_px) {
  CylinderScan out = scan;
  cv::Mat radius(scan.picture.height, scan.picture.width, CV_32F, out.radius_mm.data());
  cv::Mat share(radius.size(), CV_32F);
  for (int i = 0; i < radius.rows * radius.cols; ++i) share.ptr<float>()[i] = radius.ptr<float>()[i] > 0 ? 1.0f : 0.0f;
  const cv::Mat measured = share.clone();
  cv::GaussianBlur(radius, radius, {0, 0}, sigma_px);
  cv::GaussianBlur(share, share, {0, 0}, sigma_px);
  for (int i = 0; i < radius.rows * radius.cols; ++i)
    out.radius_mm[static_cast<std::size_t>(i)] =
        measured.ptr<float>()[i] > 0 ? out.radius_mm[static_cast<std::size_t>(i)] / share.ptr<float>()[i] : 0.0f;
  cv::Mat picture(scan.picture.height, scan.picture.width, CV_8UC3, out.picture.pixels.data());
  cv::GaussianBlur(picture, picture, {0, 0}, sigma_px);
  return out;
}

class Search {
 public:
  Search(const MorphableModel& surface, const ShapeModel* space, std::size_t skin,
         const ClosestCombinationOptions& options)
      : options_(options) {
    count_ = space == nullptr ? 0 : std::min(space->size(), static_cast<std::size_t>(options.components));
    const std::size_t stride = std::max<std::size_t>(1, (skin + looked_up - 1) / looked_up);
    for (std::size_t v = 0; v < skin; v += stride) vertices_.push_back(v);
    const auto rows = static_cast<Eigen::Index>(3 * vertices_.size());
    mean_.resize(rows);
    modes_.resize(rows, static_cast<Eigen::Index>(count_));
    for (std::size_t i = 0; i < vertices_.size(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto row = static_cast<Eigen::Index>(3 * i + axis);
        const std::size_t place = 3 * vertices_[i] + axis;
        mean_[row] =
            space == nullptr ? static_cast<double>(surface.mean.points_mm[vertices_[i]][axis]) : space->mean_mm[place];
        for (std::size_t k = 0; k < count_; ++k)
          modes_(row, static_cast<Eigen::Index>(k)) =
              space->sigmas_mm[k] * space->modes[k * 3 * space->vertices + place];
      }
    for (const std::size_t v : vertices_)
      for (std::size_t c = 0; c < 3; ++c) colours_.push_back(255 * static_cast<double>(surface.mean.colors_srgb[v][c]));
  }

  std::size_t size() const { return count_; }

  // Four residuals per vertex, in units of their scales. What the scan lacks differs by 1.
  Eigen::VectorXd residuals(const CylinderScan& scan, const Eigen::VectorXd& c) const {
    const Eigen::VectorXd points = mean_ + modes_ * c;
    Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(4 * vertices_.size()));
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(3 * i), to = static_cast<Eigen::Index>(4 * i);
      const CylinderPixel pixel = cylinder_pixel(
          scan,
          {static_cast<float>(points[row]), static_cast<float>(points[row + 1]), static_cast<float>(points[row + 2])});
      const double radius = cylinder_radius(scan, pixel.x_px, pixel.y_px);
      out[to] = radius > 0 ? (pixel.radius_mm - radius) / options_.radius_scale_mm : 1;
      const std::array<double, 3> seen = cylinder_colour(scan, pixel.x_px, pixel.y_px);
      for (std::size_t k = 0; k < 3; ++k)
        out[to + 1 + static_cast<Eigen::Index>(k)] = (colours_[3 * i + k] - seen[k]) / options_.colour_scale;
    }
    // Another person's skin, another lamp: what all of a channel differs by does not count.
    for (Eigen::Index k = 1; k < 4; ++k) {
      double sum = 0;
      for (Eigen::Index i = k; i < out.size(); i += 4) sum += out[i];
      const double mean = sum / static_cast<double>(std::max<std::size_t>(vertices_.size(), 1));
      for (Eigen::Index i = k; i < out.size(); i += 4) out[i] -= mean;
    }
    return out;
  }

  double difference(const Eigen::VectorXd& r) const {
    double sum = 0;
    for (Eigen::Index i = 0; i + 3 < r.size(); i += 4) {
      const double e = r.segment<4>(i).squaredNorm();
      sum += e / (1 + e);
    }
    return sum / std::max(1.0, static_cast<double>(r.size() / 4));
  }
  double cost(const Eigen::VectorXd& r, const Eigen::VectorXd& c) const {
    return difference(r) + prior_weight * c.squaredNorm();
  }

  void descend(const CylinderScan& scan, int steps, Eigen::VectorXd& c) const {
    if (count_ == 0) return;
    constexpr double nudge = 0.05;
    double damping = 1e-2;
    Eigen::VectorXd r = residuals(scan, c);
    double now = cost(r, c);
    const auto n = static_cast<Eigen::Index>(count_);
    for (int step = 0; step < steps; ++step) {
      Eigen::MatrixXd jacobian(r.size(), n);
      for (Eigen::Index k = 0; k < n; ++k) {
        Eigen::VectorXd moved = c;
        moved[k] += nudge;
        jacobian.col(k) = (residuals(scan, moved) - r) / nudge;
      }
      Eigen::VectorXd weights(r.size());
      for (Eigen::Index i = 0; i + 3 < r.size(); i += 4) {
        const double e = 1 + r.segment<4>(i).squaredNorm();
        weights.segment<4>(i).setConstant(1 / (e * e));
      }
      const double scale = 1 / static_cast<double>(r.size() / 4);
      Eigen::MatrixXd normal = scale * jacobian.transpose() * weights.asDiagonal() * jacobian;
      normal.diagonal().array() += prior_weight;
      const Eigen::VectorXd right = -scale * jacobian.transpose() * (weights.asDiagonal() * r) - prior_weight * c;
      bool better = false;
      for (int attempt = 0; attempt < 5 && !better; ++attempt) {
        Eigen::MatrixXd damped = normal;
        damped.diagonal() *= 1 + damping;
        const Eigen::VectorXd trial = c + damped.ldlt().solve(right);
        const Eigen::VectorXd trial_r = residuals(scan, trial);
        const double trial_cost = cost(trial_r, trial);
        better = trial_cost < now;
        if (better) {
          const double gain = now - trial_cost;
          c = trial;
          r = trial_r;
          now = trial_cost;
          damping *= 0.3;
          if (gain < 1e-6) return;
        } else {
          damping *= 5;
        }
      }
      if (!better) return;
    }
  }

 private:
  ClosestCombinationOptions options_;
  std::size_t count_ = 0;
  std::vector<std::size_t> vertices_;
  Eigen::VectorXd mean_;
  Eigen::MatrixXd modes_;
  std::vector<double> colours_;
};

Eigen::VectorXd find(const Search& search, const CylinderScan& scan) {
  const auto n = static_cast<Eigen::Index>(search.size());
  const CylinderScan coarse = blurred(scan, coarse_px);
  std::vector<std::pair<double, Eigen::VectorXd>> starts;
  const auto add = [&](const Eigen::VectorXd& c) {
    starts.emplace_back(search.cost(search.residuals(coarse, c), c), c);
  };
  add(Eigen::VectorXd::Zero(n));
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(n, tried_modes); ++k)
    for (const double s : {-tried_sigmas, tried_sigmas}) {
      Eigen::VectorXd c = Eigen::VectorXd::Zero(n);
      c[k] = s;
      add(c);
    }
  std::stable_sort(starts.begin(), starts.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  starts.resize(std::min<std::size_t>(2, starts.size()));
  Eigen::VectorXd best;
  double least = 1e30;
  for (auto& [cost, c] : starts) {
    search.descend(coarse, 12, c);
    const double found = search.cost(search.residuals(coarse, c), c);
    if (found < least) least = found, best = c;
  }
  search.descend(blurred(scan, fine_px), 8, best);
  return best;
}

}  // namespace

ClosestCombinationResult closest_combination(const CylinderScan& scan, const MorphableModel& surface,
                                             const ShapeModel* space, const ClosestCombinationOptions& options) {
  check_cylinder(scan, "scan");
  check(options.radius_scale_mm > 0 && options.colour_scale > 0, "scales are ", options.radius_scale_mm, " and ",
        options.colour_scale, ", expected more than 0");
  const std::size_t skin = skin_count(surface);
  check(skin > 0 && surface.mean.colors_srgb.size() == surface.mean.points_mm.size(), "surface has ", skin,
        " vertices of skin and ", surface.mean.colors_srgb.size(), " colours, expected ", surface.mean.points_mm.size(),
        " colours and some skin");
  if (space != nullptr) {
    check(space->vertices == skin, "space has ", space->vertices, " vertices, the surface's skin has ", skin);
    check(space->mean_mm.size() == 3 * skin && space->modes.size() == space->size() * 3 * skin, "space has a mean of ",
          space->mean_mm.size(), " numbers and ", space->modes.size(), " in its ", space->size(), " modes, expected ",
          3 * skin, " each");
  }
  const Search search(surface, space, skin, options);
  Eigen::VectorXd c = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(search.size()));
  if (!options.by_hand.empty()) {
    check(options.by_hand.size() <= search.size(), "by_hand has ", options.by_hand.size(),
          " coefficients, the space has ", search.size());
    for (std::size_t k = 0; k < options.by_hand.size(); ++k) c[static_cast<Eigen::Index>(k)] = options.by_hand[k];
  } else if (search.size() > 0) {
    c = find(search, scan);
  }
  ClosestCombinationResult result;
  result.difference = search.difference(search.residuals(blurred(scan, fine_px), c));
  std::vector<double> scaled;
  for (Eigen::Index k = 0; k < c.size(); ++k) {
    result.coefficients.values.push_back(static_cast<float>(c[k]));
    scaled.push_back(c[k] * space->sigmas_mm[static_cast<std::size_t>(k)]);
  }
  result.shape.points_mm.assign(surface.mean.points_mm.begin(),
                                surface.mean.points_mm.begin() + static_cast<std::ptrdiff_t>(skin));
  if (space != nullptr) {
    const std::vector<double> shape = shape_of(*space, scaled);
    for (std::size_t v = 0; v < skin; ++v)
      for (std::size_t axis = 0; axis < 3; ++axis)
        result.shape.points_mm[v][axis] = static_cast<float>(shape[3 * v + axis]);
  }
  return result;
}

}  // namespace face::model
