// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/find_markers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "nodes/align/measure_dot.h"
#include "nodes/base/check.h"
#include "nodes/base/scan_points.h"

namespace face::align {
namespace {

using Place = std::complex<double>;

// A disc is 3.9 times as long as wide at 75 degrees, and less once the lens has blurred it; teeth between lips are 6
// times and more.
constexpr double longest_dot = 4;
// More are noise or pores, and to link them would take hours: the time grows with the fourth power.
constexpr std::size_t most_dots = 250;

}  // namespace

Landmarks find_markers(const engine::Seq<DepthScan>& scans, const FindMarkersOptions& options) {
  Landmarks found;
  if (scans.empty()) return found;
  const auto scan = scans.at(0);
  check_scan(*scan, "the take's first scan");
  const Image& picture = scan->picture;
  const int width = picture.width, height = picture.height;
  const auto channels = static_cast<std::size_t>(picture.channels);
  const double sign = options.tone == MarkerTone::white ? 1 : -1;
  Image green{width, height, 1, {}};
  for (std::size_t i = channels > 1 ? 1 : 0; i < picture.pixels.size(); i += channels)
    green.pixels.push_back(picture.pixels[i]);
  const auto grey = [&](int x, int y) { return sign * green.pixels[static_cast<std::size_t>(y * width + x)]; };
  const double radius = options.radius_px;
  const int reach = static_cast<int>(std::ceil(2 * radius)) + 1;
  std::vector<std::pair<int, int>> disc;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x)
      if (std::hypot(x, y) <= 0.7 * radius) disc.push_back({x, y});
  std::array<std::pair<int, int>, 16> ring;
  for (std::size_t k = 0; k < 16; ++k) {
    const double angle = 6.283185307179586 * static_cast<double>(k) / 16;
    ring[k] = {static_cast<int>(std::lround(1.75 * radius * std::cos(angle))),
               static_cast<int>(std::lround(1.75 * radius * std::sin(angle)))};
  }
  // Strength: mean of the disc less the ring, where no part of the ring is as bright as half way up.
  std::vector<float> strength(static_cast<std::size_t>(width * height), 0);
  for (int y = reach; y < height - reach; ++y)
    for (int x = reach; x < width - reach; ++x) {
      double inside = 0, around = 0, worst = -1e9;
      for (const auto& [dx, dy] : disc) inside += grey(x + dx, y + dy);
      inside /= static_cast<double>(disc.size());
      for (const auto& [dx, dy] : ring) {
        const double g = grey(x + dx, y + dy);
        around += g / 16;
        worst = std::max(worst, g);
      }
      const double contrast = inside - around;
      if (contrast < options.least_contrast || inside - worst < 0.5 * contrast) continue;
      // On the skin: depth about it, and no edge of the scan.
      bool measured = true;
      for (std::size_t k = 0; k < 16; k += 4)
        measured =
            measured && scan->depth_mm[static_cast<std::size_t>((y + ring[k].second) * width + x + ring[k].first)] > 0;
      if (measured) strength[static_cast<std::size_t>(y * width + x)] = static_cast<float>(contrast);
    }
  const int apart = static_cast<int>(std::ceil(1.5 * radius));
  for (int y = reach; y < height - reach; ++y)
    for (int x = reach; x < width - reach; ++x) {
      const float own = strength[static_cast<std::size_t>(y * width + x)];
      if (own <= 0) continue;
      bool best = true;
      for (int dy = -apart; dy <= apart && best; ++dy)
        for (int dx = -apart; dx <= apart && best; ++dx) {
          const int nx = x + dx, ny = y + dy;
          if (nx < 0 || ny < 0 || nx >= width || ny >= height || (dx == 0 && dy == 0)) continue;
          const float other = strength[static_cast<std::size_t>(ny * width + nx)];
          // Of equals the first in order.
          best = other < own || (other == own && (dy > 0 || (dy == 0 && dx > 0)));
        }
      if (!best) continue;
      const Dot dot = measure_dot(green, x, y, radius);
      if (dot.length_px > longest_dot * dot.width_px || std::hypot(dot.x_px - x, dot.y_px - y) > radius) continue;
      found.points.push_back({"m" + std::to_string(found.points.size()), dot.x_px, dot.y_px, true});
    }
  check(found.points.size() <= most_dots, "the take's first scan shows ", found.points.size(),
        " dots, expected at most ", most_dots, ": is radius_px ", radius,
        " px the radius of the painted ones, and least_contrast ", options.least_contrast, " more than noise?");
  return found;
}

Landmarks link_markers(const Landmarks& markers, const Landmarks& reference, const LinkMarkersOptions& options) {
  check(options.tolerance_px > 0, "tolerance_px is ", options.tolerance_px, ", expected more than 0");
  const auto place = [](const Landmark& p) { return Place(p.x_px, p.y_px); };
  std::vector<std::size_t> mine, theirs;
  for (std::size_t i = 0; i < markers.points.size(); ++i)
    if (markers.points[i].valid) mine.push_back(i);
  for (std::size_t i = 0; i < reference.points.size(); ++i)
    if (reference.points[i].valid) theirs.push_back(i);
  // Score of a similarity: how many come near a reference marker, the nearer the better.
  Place best_turn = 1, best_shift = 0;
  double best_score = -1;
  const auto try_one = [&](Place turn, Place shift) {
    double score = 0;
    for (const std::size_t i : mine) {
      const Place p = turn * place(markers.points[i]) + shift;
      double nearest = options.tolerance_px;
      for (const std::size_t j : theirs) nearest = std::min(nearest, std::abs(p - place(reference.points[j])));
      score += 1 - nearest / options.tolerance_px;
    }
    if (score > best_score) best_score = score, best_turn = turn, best_shift = shift;
  };
  // Pure shifts by one pair, then similarities by two: the pairs that the best shift suggests.
  for (const std::size_t i : mine)
    for (const std::size_t j : theirs) try_one(1, place(reference.points[j]) - place(markers.points[i]));
  const auto partners = [&](double tolerance) {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    std::vector<std::size_t> nearest_mine(reference.points.size(), markers.points.size());
    std::vector<double> distance(reference.points.size(), tolerance);
    for (const std::size_t i : mine) {
      const Place p = best_turn * place(markers.points[i]) + best_shift;
      std::size_t at = reference.points.size();
      double nearest = tolerance;
      for (const std::size_t j : theirs) {
        const double d = std::abs(p - place(reference.points[j]));
        if (d < nearest) nearest = d, at = j;
      }
      if (at < reference.points.size() && nearest < distance[at]) distance[at] = nearest, nearest_mine[at] = i;
    }
    for (const std::size_t j : theirs)
      if (nearest_mine[j] < markers.points.size()) pairs.push_back({nearest_mine[j], j});
    return pairs;
  };
  for (int round = 0; round < 4; ++round) {
    const auto pairs = partners(2 * options.tolerance_px);
    Place mean_a = 0, mean_b = 0, product = 0;
    double square = 0;
    for (const auto& [i, j] : pairs) mean_a += place(markers.points[i]), mean_b += place(reference.points[j]);
    if (pairs.size() < 2) break;
    mean_a /= static_cast<double>(pairs.size());
    mean_b /= static_cast<double>(pairs.size());
    for (const auto& [i, j] : pairs) {
      product += std::conj(place(markers.points[i]) - mean_a) * (place(reference.points[j]) - mean_b);
      square += std::norm(place(markers.points[i]) - mean_a);
    }
    if (square <= 0) break;
    best_score = -1;  // a fit to all pairs replaces the guess
    try_one(product / square, mean_b - product / square * mean_a);
  }
  Landmarks linked;
  for (const auto& [i, j] : partners(options.tolerance_px)) {
    linked.points.push_back(markers.points[i]);
    linked.points.back().name = reference.points[j].name;
  }
  return linked;
}

Landmarks first_layout(const engine::Seq<Landmarks>& layouts) {
  Landmarks best;
  for (const Landmarks& layout : layouts)
    if (layout.points.size() > best.points.size()) best = layout;
  return best;
}

}  // namespace face::align
