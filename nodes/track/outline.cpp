// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/outline.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/track/face_colours.h"

namespace face::track {
namespace {

using Vector2 = Eigen::Vector2d;

constexpr int inside_px = 4, outside_px = 6;  // of a profile
constexpr int samples = inside_px + 1 + outside_px;
constexpr double seam_px = 3;  // how far across it the seam between the lips is looked for

// The points of the outline with the directions out of the mouth and along its edge.
struct Edge {
  std::vector<Vector2> place, normal, along;
};

Edge edge_of(const Landmarks& points, const std::vector<std::size_t>& outline) {
  Edge edge;
  Vector2 centre = Vector2::Zero();
  for (const std::size_t i : outline) {
    edge.place.emplace_back(points.points[i].x_px, points.points[i].y_px);
    centre += edge.place.back() / static_cast<double>(outline.size());
  }
  const std::size_t count = outline.size(), half = count / 2;
  for (std::size_t i = 0; i < count; ++i) {
    Vector2 along = edge.place[(i + 1) % count] - edge.place[(i + count - 1) % count];
    if (i % half == 0) along = edge.place[half] - edge.place[0];
    along /= std::max(along.norm(), 1e-9);
    Vector2 normal(along.y(), -along.x());
    if (i % half == 0)
      normal = i == 0 ? Vector2(-along) : along;  // out of the corner
    else if (normal.dot(edge.place[i] - centre) < 0)
      normal = -normal;
    if (i % half == 0) along = {-normal.y(), normal.x()};
    edge.normal.push_back(normal);
    edge.along.push_back(along);
  }
  return edge;
}

Box box_of(const std::vector<Vector2>& places) {
  Box box;
  for (const Vector2& p : places) box.include(p.x(), p.y());
  return box;
}

double lipness_at(const FaceColours& colours, const Matrix& look, const Vector2& p) {
  const std::array<double, 3> colour = colours.at(p.x(), p.y());
  const double lipness =
      look.at(0, 0) * colour[0] + look.at(0, 1) * colour[1] + look.at(0, 2) * colour[2] + look.at(0, 3);
  constexpr double least = -0.4, most = 1.4;  // redder than lips is no less a lip
  return std::clamp(lipness, least, most);
}

// Lipness along a normal, at offsets -inside_px - reach to outside_px + reach in half pixels.
std::vector<double> lip_profile(const FaceColours& colours, const Matrix& look, const Vector2& place,
                                const Vector2& normal, const Vector2& along, int reach) {
  std::vector<double> out;
  for (int k = -2 * (inside_px + reach); k <= 2 * (outside_px + reach); ++k) {
    double sum = 0;
    for (const double t : {-1.0, 0.0, 1.0}) sum += lipness_at(colours, look, place + 0.5 * k * normal + t * along);
    out.push_back(sum / 3);
  }
  return out;
}

// The darkest value across the seam between the lips, along the mouth's width.
std::vector<double> seam_profile(const FaceColours& colours, const Vector2& place, const Vector2& normal,
                                 const Vector2& along, int reach) {
  std::vector<double> out;
  for (int k = -2 * (inside_px + reach); k <= 2 * (outside_px + reach); ++k) {
    double darkest = 1;
    for (double t = -seam_px; t <= seam_px; t += 0.5) {
      const Vector2 p = place + 0.5 * k * normal + t * along;
      darkest = std::min(darkest, colours.luma_at(p.x(), p.y()));
    }
    out.push_back(darkest);
  }
  return out;
}

// Where across the seam it is darkest: the centre of what is darker than the lighter half, px along `along`.
double seam_offset_px(const FaceColours& colours, const Vector2& place, const Vector2& normal, const Vector2& along) {
  double weight = 0, sum = 0, lightest = 0;
  std::vector<std::pair<double, double>> values;
  for (double t = -seam_px; t <= seam_px; t += 0.5) {
    double value = 0;
    for (const double k : {-2.0, -1.0, 0.0}) {
      const Vector2 p = place + k * normal + t * along;
      value += colours.luma_at(p.x(), p.y()) / 3;
    }
    values.emplace_back(t, value);
    lightest = std::max(lightest, value);
  }
  for (const auto& [t, value] : values) {
    const double dark = std::pow(lightest - value, 3);
    weight += dark;
    sum += dark * t;
  }
  return weight > 0 ? sum / weight : 0;
}

// The lipness across the edge of a lip, as it is usual where points are placed on the edge. Where one was placed beside
// it, so that what is there hardly changes, this is sought instead.
std::vector<double> or_usual(std::vector<double> profile) {
  constexpr std::array<double, samples> usual = {1.10, 1.05, 1.00, 0.87, 0.62, 0.33, 0.12, 0.00, -0.07, -0.10, -0.12};
  constexpr double told = 0.12, untold = 0.06;  // variances of a profile; those of marked lips are 0.12 to 0.3
  double mean = 0, square = 0;
  for (const double value : profile) mean += value / samples, square += value * value / samples;
  const double share = std::clamp((told - (square - mean * mean)) / (told - untold), 0.0, 1.0);
  for (std::size_t s = 0; s < profile.size(); ++s) profile[s] += share * (usual[s] - profile[s]);
  return profile;
}

struct Fit {
  double shift_px = 0;
  double error = 0;  // 0 = equal, 1 = as far from it as an even profile
};

// How unlike a profile is: for lips the RMS difference over the wanted one's deviation; for seams, which are darker
// when the mouth is open, the root of the part that no offset and no gain that does not fade them explains: what is
// hardly dark is skin in a shade.
double unlikeness(const std::vector<double>& wanted, const double* seen, bool any_gain) {
  double weights = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (int s = 0; s < samples; ++s) {
    const double weight = std::exp(-0.5 * std::pow((s - inside_px - 0.5) / 3.0, 2));
    const double x = wanted[static_cast<std::size_t>(s)], y = seen[2 * s];
    weights += weight, a += weight * x, b += weight * y;
    aa += weight * x * x, bb += weight * y * y, ab += weight * x * y;
  }
  a /= weights, b /= weights;
  aa = aa / weights - a * a;
  bb = bb / weights - b * b;
  ab = ab / weights - a * b;
  if (aa < 1e-9) return 1;
  if (!any_gain) return std::sqrt(std::max(0.0, (aa + bb - 2 * ab + (a - b) * (a - b)) / aa));
  if (bb < 1e-9 || ab <= 0) return 1;
  constexpr double least_gain = 0.7;
  const double gain = std::max(least_gain, ab / aa);
  return std::sqrt(std::clamp((bb - 2 * gain * ab + gain * gain * aa) / std::max(bb, gain * gain * aa), 0.0, 1.0));
}

// How likely a shift is. Chosen on the marks of tests/data/grid_marks; the errors there change by less than a tenth
// when any of these does by half.
struct Belief {
  double unlike;      // deviation of a profile's unlikeness where it is right
  double follow_px;   // of the shift from where the point was followed to
  double stray_px;    // of the place from where it lies at rest; 0 = anywhere
  double least_like;  // deviation of the unlikeness that a sighting survives
  double error_px;    // deviation of a sighting along the normal
};
constexpr Belief on_lip{0.5, 4, 0, 0.6, 0.7}, on_corner{0.3, 5, 10, 0.5, 1};
constexpr double seam_error_px = 0.8;  // deviation of a corner's sighting across the seam

// The shift of `seen` (half pixels, wider by reach) that is most like `wanted` (pixels) and most likely. rest_px: the
// shift to the place at rest.
Fit fit_profile(const std::vector<double>& wanted, const std::vector<double>& seen, int reach, bool any_gain,
                const Belief& belief, double rest_px) {
  std::vector<double> errors, costs;
  for (int k = 0; k <= 4 * reach; ++k) {
    const double shift = 0.5 * k - reach;
    errors.push_back(unlikeness(wanted, &seen[static_cast<std::size_t>(k)], any_gain));
    costs.push_back(std::pow(errors.back() / belief.unlike, 2) + std::pow(shift / belief.follow_px, 2));
    if (belief.stray_px > 0) costs.back() += std::pow((shift - rest_px) / belief.stray_px, 2);
  }
  const auto best = static_cast<int>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  const auto at = static_cast<std::size_t>(best);
  Fit fit{0.5 * best - reach, errors[at]};
  if (best > 0 && best < 4 * reach) {
    const double a = costs[at - 1], b = costs[at], c = costs[at + 1];
    if (a + c - 2 * b > 1e-12) fit.shift_px += 0.25 * (a - c) / (a + c - 2 * b);
  }
  return fit;
}

}  // namespace

Matrix learn_outline(const Image& image, const Landmarks& points, const std::vector<std::size_t>& outline) {
  Matrix look{outline.size() + 1, samples, std::vector<double>((outline.size() + 1) * samples, 0.0)};
  const Edge edge = edge_of(points, outline);
  const FaceColours colours(image, box_of(edge.place), outside_px + seam_px + 2);
  const auto colour_at = [&](const Vector2& p) { return Eigen::Vector3d(colours.at(p.x(), p.y()).data()); };
  const std::size_t count = outline.size(), half = count / 2;
  // Colours just inside and outside, half way between the points too.
  std::vector<Eigen::Vector3d> lip, skin;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = (i + 1) % count;
    for (const double t : {0.0, 0.5}) {
      if (t == 0 && i % half == 0) continue;
      const Vector2 p = (1 - t) * edge.place[i] + t * edge.place[j];
      const Vector2 n = t == 0 ? edge.normal[i] : Vector2((edge.normal[i] + edge.normal[j]).normalized());
      for (const double k : {1.0, 2.0, 3.0}) lip.push_back(colour_at(p - k * n));
      for (const double k : {2.0, 3.5, 5.0}) skin.push_back(colour_at(p + k * n));
    }
  }
  const auto mean_of = [](const std::vector<Eigen::Vector3d>& list) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& c : list) sum += c;
    return Eigen::Vector3d(sum / static_cast<double>(list.size()));
  };
  const Eigen::Vector3d lip_mean = mean_of(lip), skin_mean = mean_of(skin);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Identity() * 1e-4;  // a colour that never changes decides nothing
  for (const auto& c : lip)
    scatter += (c - lip_mean) * (c - lip_mean).transpose() / static_cast<double>(2 * lip.size());
  for (const auto& c : skin)
    scatter += (c - skin_mean) * (c - skin_mean).transpose() / static_cast<double>(2 * skin.size());
  Eigen::Vector3d axis = scatter.ldlt().solve(lip_mean - skin_mean);
  const double gap = axis.dot(lip_mean - skin_mean);
  if (gap > 1e-9) axis /= gap;
  for (Eigen::Index k = 0; k < 3; ++k) look.at(0, static_cast<std::size_t>(k)) = axis(k);
  look.at(0, 3) = -axis.dot(skin_mean);

  std::vector<std::vector<double>> profiles;
  for (std::size_t i = 0; i < count; ++i)
    profiles.push_back(i % half == 0 ? seam_profile(colours, edge.place[i], edge.normal[i], edge.along[i], 0)
                                     : lip_profile(colours, look, edge.place[i], edge.normal[i], edge.along[i], 0));
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t s = 0; s < samples; ++s) {
      double value = profiles[i][2 * s];
      if (i % half != 0) {  // less of the first picture's noise: the neighbours on the same lip help
        double weight = 2;
        value *= 2;
        for (const std::size_t j : {i - 1, (i + 1) % count})
          if (j % half != 0) value += profiles[j][2 * s], ++weight;
        value /= weight;
      }
      look.at(i + 1, s) = value;
    }
  for (std::size_t i = 0; i < count; ++i) {
    if (i % half == 0) continue;
    std::vector<double> profile;
    for (std::size_t s = 0; s < samples; ++s) profile.push_back(look.at(i + 1, s));
    profile = or_usual(std::move(profile));
    for (std::size_t s = 0; s < samples; ++s) look.at(i + 1, s) = profile[s];
  }
  for (const std::size_t i : {std::size_t{0}, half})
    look.at(0, i == 0 ? 4 : 5) = seam_offset_px(colours, edge.place[i], edge.normal[i], edge.along[i]);
  return look;
}

EdgeSight see_outline(const Image& image, const Landmarks& expected, const Landmarks& rest,
                      const std::vector<std::size_t>& outline, const Matrix& look, double reach_px) {
  const Edge edge = edge_of(expected, outline);
  const std::size_t count = outline.size(), half = count / 2;
  const int reach = std::max(1, static_cast<int>(std::lround(reach_px)));
  const FaceColours colours(image, box_of(edge.place), outside_px + seam_px + 2 + 2 * reach);
  EdgeSight out;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2 &place = edge.place[i], &normal = edge.normal[i], &along = edge.along[i];
    std::vector<double> wanted;
    for (std::size_t s = 0; s < samples; ++s) wanted.push_back(look.at(i + 1, s));
    const Landmark& at_rest = rest.points[outline[i]];
    const double rest_px = (Vector2(at_rest.x_px, at_rest.y_px) - place).dot(normal);
    const bool corner = i % half == 0;
    const Belief& belief = corner ? on_corner : on_lip;
    const int far = corner ? 2 * reach : reach;
    const Fit fit = fit_profile(wanted,
                                corner ? seam_profile(colours, place, normal, along, far)
                                       : lip_profile(colours, look, place, normal, along, far),
                                far, corner, belief, rest_px);
    const double likeness = std::exp(-0.5 * std::pow(fit.error / belief.least_like, 2));
    const double sure = likeness / (belief.error_px * belief.error_px);
    Vector2 seen = place + fit.shift_px * normal;
    double across = 0;
    if (corner) {
      seen += (seam_offset_px(colours, seen, normal, along) - look.at(0, i == 0 ? 4 : 5)) * along;
      across = likeness / (seam_error_px * seam_error_px);
    }
    out.likeness.push_back(likeness);
    out.sightings.push_back({seen.x(), seen.y(), sure * normal.x() * normal.x() + across * along.x() * along.x(),
                             sure * normal.x() * normal.y() + across * along.x() * along.y(),
                             sure * normal.y() * normal.y() + across * along.y() * along.y()});
  }
  return out;
}

}  // namespace face::track
