// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/match_motion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/eigen_vector.h"
#include "nodes/model/cylinder_grid.h"
#include "nodes/model/motion_basis.h"
#include "nodes/model/scan_maps.h"
#include "nodes/model/scan_surface.h"
#include "nodes/render/triangulate.h"

namespace face::model {
namespace {

constexpr std::size_t surface_samples = 1500, feature_samples = 500;
constexpr int steps = 12;
constexpr int fine_step = 6;  // before, colours are compared coarse: lips may be 10 mm from where they are looked for
constexpr double widest_mm = 6, narrower = 0.6, least_mm = 0.7;  // distance that counts little, from step to step
constexpr double unlike_colour = 10, unlike_curvature = 0.3;     // differences that do
constexpr double same_side = 0.5;                                // cosine of the normals of what may be one place
constexpr double onto_surface_mm = 2;
constexpr double start_mm = 1;  // how closely the first guess is the start

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void check_steps(const CylinderScan& scan, const char* name) {
  check_cylinder(scan, name);
  check(std::isfinite(scan.step_mm) && std::isfinite(scan.phi_step_rad), name, " has steps of ", scan.step_mm,
        " mm and ", scan.phi_step_rad, " rad, expected finite ones");
}

// Brows, eyes and mouth in the order of Multi-PIE; what lies between (nose) has no colours of its own.
constexpr std::size_t features = 5;
int feature_of(std::size_t landmark) {
  return landmark < 17   ? -1
         : landmark < 22 ? 0
         : landmark < 27 ? 1
         : landmark < 36 ? -1
         : landmark < 42 ? 2
         : landmark < 48 ? 3
                         : 4;
}

// Marks that are each other's mirror images: outline, brows, eyes, corners of the mouth.
constexpr std::array<std::array<std::size_t, 2>, 19> mirrored_marks = {{{0, 16},
                                                                        {1, 15},
                                                                        {2, 14},
                                                                        {3, 13},
                                                                        {4, 12},
                                                                        {5, 11},
                                                                        {6, 10},
                                                                        {7, 9},
                                                                        {17, 26},
                                                                        {18, 25},
                                                                        {19, 24},
                                                                        {20, 23},
                                                                        {21, 22},
                                                                        {36, 45},
                                                                        {37, 44},
                                                                        {38, 43},
                                                                        {39, 42},
                                                                        {31, 35},
                                                                        {48, 54}}};

double mirror_x_of(const MorphableModel& surface) {
  double sum = 0;
  for (const auto& pair : mirrored_marks)
    for (const std::size_t mark : pair)
      sum += static_cast<double>(surface.mean.points_mm[surface.landmarks68[mark]][0]);
  return sum / static_cast<double>(2 * mirrored_marks.size());
}

// A vertex that is looked at, and what the reference shows there.
struct Look {
  std::uint32_t vertex = 0;
  bool surface = false;
  int feature = -1;
  std::optional<double> curvature;
  std::array<std::array<double, ScanMaps::colours>, 2> colour{};  // coarse, fine
};

std::vector<Look> choose_looks(const MorphableModel& surface, std::size_t skin, const ScanMaps& reference,
                               double feature_reach_mm) {
  const std::vector<Vec3f>& points = surface.mean.points_mm;
  std::vector<int> feature(skin, -1);
  std::size_t in_features = 0;
  for (std::size_t v = 0; v < skin; ++v) {
    double nearest = feature_reach_mm;
    for (std::size_t mark = 0; mark < 68; ++mark) {
      if (feature_of(mark) < 0) continue;
      const double distance = (vector_of(points[surface.landmarks68[mark]]) - vector_of(points[v])).norm();
      if (distance < nearest) nearest = distance, feature[v] = feature_of(mark);
    }
    in_features += feature[v] >= 0 ? 1 : 0;
  }
  const std::size_t stride = std::max<std::size_t>(1, skin / surface_samples),
                    feature_stride = std::max<std::size_t>(1, in_features / feature_samples);
  std::vector<Look> looks;
  std::size_t nth = 0;
  for (std::size_t v = 0; v < skin; ++v) {
    Look look{static_cast<std::uint32_t>(v), v % stride == stride / 2, -1, {}, {}};
    if (feature[v] >= 0 && nth++ % feature_stride == 0) look.feature = feature[v];
    if (!look.surface && look.feature < 0) continue;
    if (const auto place = reference.find(array_of(vector_of(points[v])))) {
      look.curvature = reference.curvature(*place).value;
      for (const ScanMaps::Detail detail : {ScanMaps::coarse, ScanMaps::fine})
        for (std::size_t k = 0; k < ScanMaps::colours; ++k)
          look.colour[detail][k] = reference.colour(*place, k, detail).value;
    } else {
      look.feature = -1;
    }
    if (look.surface || look.feature >= 0) looks.push_back(look);
  }
  return looks;
}

// What a feature's colours in the reference become in the scan.
struct Tint {
  double gain = 1, offset = 0;
};

// Rows of a weighted linear system, as many as come.
class Rows {
 public:
  Rows(const MotionBasis& basis, std::size_t most)
      : basis_(basis),
        matrix_(static_cast<Eigen::Index>(most), static_cast<Eigen::Index>(basis.size())),
        right_(static_cast<Eigen::Index>(most)) {}
  void clear() { count_ = 0; }
  // weight * (motion of place i along the direction - what it is with c) should be weight * residual.
  void add(std::size_t i, const std::array<double, 3>& direction, const std::vector<double>& c, double residual,
           double weight) {
    basis_.row(i, direction, {matrix_.row(count_).data(), basis_.size()});
    right_[count_] = weight * (residual + matrix_.row(count_).dot(mapped(c)));
    matrix_.row(count_++) *= weight;
  }
  std::vector<double> solve() const {
    std::vector<double> c(basis_.size(), 0.0);
    if (count_ == 0) return c;
    Eigen::MatrixXd normal = mapped(basis_.precision()).asDiagonal();
    normal.selfadjointView<Eigen::Lower>().rankUpdate(matrix_.topRows(count_).transpose());
    Eigen::Map<Eigen::VectorXd>(c.data(), matrix_.cols()) =
        normal.selfadjointView<Eigen::Lower>().llt().solve(matrix_.topRows(count_).transpose() * right_.head(count_));
    return c;
  }

 private:
  static Eigen::Map<const Eigen::VectorXd> mapped(const std::vector<double>& c) {
    return {c.data(), static_cast<Eigen::Index>(c.size())};
  }
  const MotionBasis& basis_;
  Matrix matrix_;
  Eigen::VectorXd right_;
  Eigen::Index count_ = 0;
};

class Fit {
 public:
  Fit(const MorphableModel& surface, std::size_t skin, std::vector<Look> looks, const ScanMaps& target,
      const MatchMotionOptions& options)
      : options_(options),
        looks_(std::move(looks)),
        target_(target),
        basis_(places_of(surface, looks_), mirror_x_of(surface),
               {options.motion_mm, options.asymmetry, static_cast<std::size_t>(options.functions)}),
        rows_(basis_, (2 + ScanMaps::colours) * looks_.size()),
        skin_(surface.mean.points_mm.begin(), surface.mean.points_mm.begin() + static_cast<std::ptrdiff_t>(skin)),
        c_(basis_.size(), 0.0) {
    for (const render::Triangle& t : render::triangulate(surface.mean).triangles)
      if (std::max({t[0], t[1], t[2]}) < skin) triangles_.push_back(t);
  }

  void start(const MeshPoints& shape) {
    rows_.clear();
    for (std::size_t i = 0; i < looks_.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const std::uint32_t v = looks_[i].vertex;
        const Eigen::Vector3d by = vector_of(shape.points_mm[v]) - vector_of(skin_[v]);
        rows_.add(i, array_of(Eigen::Vector3d::Unit(axis)), c_, by[axis], 1 / start_mm);
      }
    c_ = rows_.solve();
  }

  void descend() {
    double unlike_mm = widest_mm;
    for (int step = 0; step < steps; ++step, unlike_mm = std::max(least_mm, narrower * unlike_mm)) {
      const std::vector<Vec3f> normals = render::vertex_normals(shape(), triangles_);
      const std::vector<std::array<double, 3>> moved = basis_.displacements(c_);
      std::vector<std::optional<ScanPlace>> seen(looks_.size());
      for (std::size_t i = 0; i < looks_.size(); ++i) {
        const std::uint32_t v = looks_[i].vertex;
        seen[i] = target_.find(array_of(vector_of(skin_[v]) + vector_of(moved[i])));
        if (seen[i] && !(vector_of(seen[i]->normal).dot(vector_of(normals[v])) > same_side)) seen[i].reset();
      }
      rows_.clear();
      for (std::size_t i = 0; i < looks_.size(); ++i)
        if (seen[i] && looks_[i].surface)
          add_surface(i, *seen[i], vector_of(skin_[looks_[i].vertex]) + vector_of(moved[i]), unlike_mm);
      add_colours(seen, step < fine_step ? ScanMaps::coarse : ScanMaps::fine);
      c_ = rows_.solve();
    }
  }

  std::vector<Vec3f> shape() const {
    std::vector<Vec3f> points = skin_;
    const std::vector<std::array<double, 3>> by = basis_.displacements(points, c_);
    for (std::size_t v = 0; v < points.size(); ++v)
      for (std::size_t k = 0; k < 3; ++k) points[v][k] += static_cast<float>(by[v][k]);
    return points;
  }
  std::vector<Vec3f> normals(const std::vector<Vec3f>& points) const {
    return render::vertex_normals(points, triangles_);
  }

 private:
  static std::vector<Vec3f> places_of(const MorphableModel& surface, const std::vector<Look>& looks) {
    std::vector<Vec3f> places;
    for (const Look& look : looks) places.push_back(surface.mean.points_mm[look.vertex]);
    return places;
  }

  // Geman and McClure's weight of a residual, as a factor of its row.
  static double likely(double residual, double unlike) { return 1 / (1 + residual * residual / (unlike * unlike)); }

  void add_surface(std::size_t i, const ScanPlace& seen, const Eigen::Vector3d& point, double unlike_mm) {
    const double distance = vector_of(seen.normal).dot(vector_of(seen.point_mm) - point);
    rows_.add(i, seen.normal, c_, distance, likely(distance, unlike_mm) / options_.surface_mm);
    if (!looks_[i].curvature) return;
    const ScanValue bend = target_.curvature(seen);
    const double differs = *looks_[i].curvature - bend.value;
    rows_.add(i, bend.gradient, c_, differs, likely(differs, unlike_curvature) / options_.curvature);
  }

  void add_colours(const std::vector<std::optional<ScanPlace>>& seen, ScanMaps::Detail detail) {
    for (std::size_t channel = 0; channel < ScanMaps::colours; ++channel) {
      std::array<Tint, features> tints;
      for (std::size_t f = 0; f < features; ++f) tints[f] = tint_of(static_cast<int>(f), channel, detail, seen);
      for (std::size_t i = 0; i < looks_.size(); ++i) {
        if (!seen[i] || looks_[i].feature < 0) continue;
        const Tint& tint = tints[static_cast<std::size_t>(looks_[i].feature)];
        const ScanValue colour = target_.colour(*seen[i], channel, detail);
        const double differs = tint.gain * looks_[i].colour[detail][channel] + tint.offset - colour.value;
        rows_.add(i, colour.gradient, c_, differs, likely(differs, unlike_colour) / options_.colour_scale);
      }
    }
  }

  // The line through the pairs of colours, drawn towards gain 1 where the feature is of one colour.
  Tint tint_of(int feature, std::size_t channel, ScanMaps::Detail detail,
               const std::vector<std::optional<ScanPlace>>& seen) const {
    constexpr double one_colour = 2;  // variance
    constexpr double least_gain = 0.1, most_gain = 3;
    double count = 0, from = 0, to = 0, squares = 0, products = 0;
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      if (!seen[i] || looks_[i].feature != feature) continue;
      const double x = looks_[i].colour[detail][channel], y = target_.colour(*seen[i], channel, detail).value;
      ++count, from += x, to += y, squares += x * x, products += x * y;
    }
    if (count < 5) return {};
    from /= count, to /= count;
    const double gain =
        std::clamp((products / count - from * to + one_colour) / (squares / count - from * from + one_colour),
                   least_gain, most_gain);
    return {gain, to - gain * from};
  }

  MatchMotionOptions options_;
  std::vector<Look> looks_;
  const ScanMaps& target_;
  MotionBasis basis_;
  Rows rows_;
  std::vector<Vec3f> skin_;
  std::vector<render::Triangle> triangles_;
  std::vector<double> c_;
};

}  // namespace

MatchMotionResult match_motion(const MorphableModel& surface, const CylinderScan& reference, const MeshPoints* start,
                               const CylinderScan& target, const MatchMotionOptions& options) {
  check_steps(reference, "reference");
  check_steps(target, "target");
  const std::size_t skin = skin_count(surface);
  check(skin > 0, "surface has no skin");
  check(surface.landmarks68.size() == 68, "surface has ", surface.landmarks68.size(), " landmarks, expected 68");
  if (start != nullptr)
    check(start->points_mm.size() == skin, "start has ", start->points_mm.size(), " vertices, the surface's skin has ",
          skin);
  check(options.functions >= 1, "functions is ", options.functions, ", expected at least 1");
  check(options.surface_mm > 0 && options.colour_scale > 0 && options.curvature > 0,
        "surface_mm, colour_scale and curvature are ", options.surface_mm, ", ", options.colour_scale, " and ",
        options.curvature, ", expected more than 0");
  const ScanMaps seen(target, options.curvature_scale_mm);
  Fit fit(surface, skin,
          choose_looks(surface, skin, ScanMaps(reference, options.curvature_scale_mm), options.feature_reach_mm), seen,
          options);
  if (start != nullptr) fit.start(*start);
  fit.descend();

  MatchMotionResult result;
  result.shape.points_mm = fit.shape();
  result.texture = {static_cast<int>(skin), 1, 3, std::vector<std::uint8_t>(3 * skin)};
  const std::vector<Vec3f> normals = fit.normals(result.shape.points_mm);
  std::size_t on_surface = 0;
  for (std::size_t v = 0; v < skin; ++v) {
    Vec3f& point = result.shape.points_mm[v];
    if (const auto place = seen.find(array_of(vector_of(point)));
        place && vector_of(place->normal).dot(vector_of(normals[v])) > same_side) {
      const Eigen::Vector3d normal = vector_of(place->normal);
      const double away = normal.dot(vector_of(place->point_mm) - vector_of(point)) / onto_surface_mm;
      // Tapered, so that nothing tears beside what is not measured.
      const double share = std::abs(away) < 1 ? (1 - away * away) * (1 - away * away) : 0;
      for (std::size_t k = 0; k < 3; ++k)
        point[k] += static_cast<float>(share * onto_surface_mm * away * normal[static_cast<int>(k)]);
      on_surface += share > 0 ? 1 : 0;
    }
    const CylinderPixel pixel = cylinder_pixel(target, point);
    const std::array<double, 3> colour = cylinder_colour(target, pixel.x_px, pixel.y_px);
    for (std::size_t k = 0; k < 3; ++k)
      result.texture.pixels[3 * v + k] = static_cast<std::uint8_t>(std::clamp(colour[k], 0.0, 255.0) + 0.5);
  }
  result.sampled = static_cast<double>(on_surface) / static_cast<double>(skin);
  return result;
}

}  // namespace face::model
