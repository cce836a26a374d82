// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/settle.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>

#include "nodes/base/check.h"
#include "nodes/track/solid_head.h"

namespace face::track {
namespace {

using Place = std::complex<double>;

struct Layout {
  std::vector<Place> places;
  Place turn = 1;  // rotation and scale since the start
};

Layout layout_on(const SolidHead& head, const Landmarks& start, const std::vector<double>& depths_px) {
  Layout out;
  for (std::size_t i = 0; i < start.points.size(); ++i)
    out.places.push_back(head.seen({start.points[i].x_px, start.points[i].y_px}, depths_px[i]));
  out.turn = Place(head.turn[0] + head.turn[4], head.turn[3] - head.turn[1]) / 2.0;
  return out;
}

// The similarity that carries the start points to where the seen ones are (least squares; Umeyama, PAMI 1991, in two
// dimensions as complex numbers), applied to all. A translation where fewer than two are seen. Where two rigid points
// are seen or carried, these alone decide.
Layout carry_layout(const Landmarks& start, std::vector<Sighting> sightings, const Bonds& bonds) {
  const std::vector<std::size_t>& rigid = bonds.rigid;
  const std::vector<double>& depths_px = bonds.depths_px;
  if (bonds.head) return layout_on(*bonds.head, start, depths_px);
  const auto is_seen = [&](std::size_t i) { return sightings[i].xx + sightings[i].yy > 0; };
  constexpr double trust_in_carried = 0.25;
  std::vector<double> trust(sightings.size(), 1);
  for (const std::size_t i : rigid) {
    if (bonds.carried.empty() || is_seen(i)) continue;
    sightings[i] = bonds.carried[i];
    trust[i] = trust_in_carried;
  }
  const bool by_rigid = std::count_if(rigid.begin(), rigid.end(), is_seen) >= 2;
  Place start_mean = 0, seen_mean = 0, product = 0;
  double count = 0, square = 0;
  const auto at = [&](std::size_t i) { return Place(start.points[i].x_px, start.points[i].y_px); };
  const auto seen = [&](std::size_t i) {
    return is_seen(i) && (!by_rigid || std::find(rigid.begin(), rigid.end(), i) != rigid.end());
  };
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (!seen(i)) continue;
    start_mean += at(i);
    seen_mean += Place(sightings[i].x_px, sightings[i].y_px);
    ++count;
  }
  if (count > 0) start_mean /= count, seen_mean /= count;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (!seen(i)) continue;
    product += std::conj(at(i) - start_mean) * (Place(sightings[i].x_px, sightings[i].y_px) - seen_mean);
    square += std::norm(at(i) - start_mean);
  }
  Layout out;
  if (count > 1 && square > 0) out.turn = product / square;
  if (by_rigid && !depths_px.empty() && std::abs(out.turn) > 0) {
    std::vector<SolidPoint> points;
    for (const std::size_t i : rigid)
      if (is_seen(i)) points.push_back({at(i), Place(sightings[i].x_px, sightings[i].y_px), depths_px[i], trust[i]});
    return layout_on(find_solid_head(points, out.turn), start, depths_px);
  }
  for (std::size_t i = 0; i < sightings.size(); ++i) out.places.push_back(seen_mean + out.turn * (at(i) - start_mean));
  return out;
}

double start_distance(const Landmarks& start, std::size_t i, std::size_t j) {
  return std::hypot(start.points[i].x_px - start.points[j].x_px, start.points[i].y_px - start.points[j].y_px);
}

double median_spacing(const Landmarks& start) {
  std::vector<double> nearest;
  for (std::size_t i = 0; i < start.points.size(); ++i) {
    double best = 1e9;
    for (std::size_t j = 0; j < start.points.size(); ++j)
      if (i != j) best = std::min(best, start_distance(start, i, j));
    nearest.push_back(best);
  }
  std::sort(nearest.begin(), nearest.end());
  return std::max(nearest[nearest.size() / 2], 1.0);
}

}  // namespace

std::vector<Sighting> settle(const Landmarks& start, const std::vector<Sighting>& sightings, const Bonds& bonds) {
  check(sightings.size() == start.points.size(), "sightings has ", sightings.size(), " points, start has ",
        start.points.size());
  const std::size_t count = sightings.size();
  if (count == 0) return {};
  const Layout layout = carry_layout(start, sightings, bonds);
  const double spacing = median_spacing(start);

  // Unknowns: offsets from the layout, x then y of each point; then the size of each mode.
  const auto size = static_cast<Eigen::Index>(2 * count), modes = static_cast<Eigen::Index>(bonds.modes.size());
  Eigen::MatrixXd shapes(size, modes);
  for (Eigen::Index k = 0; k < modes; ++k) {
    const auto& mode = bonds.modes[static_cast<std::size_t>(k)];
    check(mode.size() == 2 * count, "mode ", k, " has ", mode.size(), " entries, expected ", 2 * count);
    for (std::size_t i = 0; i < count; ++i) {
      const Place move = layout.turn * Place(mode[2 * i], mode[2 * i + 1]);
      shapes(static_cast<Eigen::Index>(2 * i), k) = move.real();
      shapes(static_cast<Eigen::Index>(2 * i + 1), k) = move.imag();
    }
  }
  // Springs on what the modes do not explain. A point with neither sighting nor neighbour stays with the layout.
  Eigen::MatrixXd springs = Eigen::MatrixXd::Identity(size, size) * 1e-9;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      const double d = start_distance(start, i, j) / spacing;
      const double spring = std::max(bonds.stiffness, 1e-6) * std::exp(-0.5 * d * d);
      for (Eigen::Index k = 0; k < 2; ++k) {
        const Eigen::Index p = static_cast<Eigen::Index>(2 * i) + k, q = static_cast<Eigen::Index>(2 * j) + k;
        springs(p, p) += spring;
        springs(q, q) += spring;
        springs(p, q) -= spring;
        springs(q, p) -= spring;
      }
    }
  for (Eigen::Index p = 0; p < size && modes > 0; ++p)
    if (shapes.row(p - p % 2).squaredNorm() + shapes.row(p - p % 2 + 1).squaredNorm() > 0)
      springs(p, p) += 1 / (bonds.slack_px * bonds.slack_px);

  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(size + modes, size + modes);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(size + modes);
  a.topLeftCorner(size, size) = springs;
  a.topRightCorner(size, modes) = -springs * shapes;
  a.bottomLeftCorner(modes, size) = a.topRightCorner(size, modes).transpose();
  a.bottomRightCorner(modes, modes) = shapes.transpose() * springs * shapes + Eigen::MatrixXd::Identity(modes, modes);
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<Eigen::Index>(2 * i), y = x + 1;
    const Sighting& s = sightings[i];
    const double ox = s.x_px - layout.places[i].real(), oy = s.y_px - layout.places[i].imag();
    a(x, x) += s.xx;
    a(x, y) += s.xy;
    a(y, x) += s.xy;
    a(y, y) += s.yy;
    b(x) += s.xx * ox + s.xy * oy;
    b(y) += s.xy * ox + s.yy * oy;
  }
  const Eigen::VectorXd offset = a.ldlt().solve(b);
  std::vector<Sighting> out = sightings;
  for (std::size_t i = 0; i < count; ++i) {
    out[i].x_px = layout.places[i].real() + offset(static_cast<Eigen::Index>(2 * i));
    out[i].y_px = layout.places[i].imag() + offset(static_cast<Eigen::Index>(2 * i + 1));
  }
  return out;
}

}  // namespace face::track
