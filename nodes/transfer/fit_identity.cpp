// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/fit_identity.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/align/orient.h"
#include "nodes/base/check.h"
#include "nodes/base/eigen_vector.h"
#include "nodes/base/scan_points.h"
#include "nodes/model/name_landmark.h"
#include "nodes/render/triangulate.h"
#include "nodes/transfer/cylinder_lookup.h"
#include "nodes/transfer/lip_sides.h"

namespace face::transfer {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

struct Mark {
  std::uint32_t vertex;
  Vector3d place;
};

// Where marks are on the scan's surface. A mark between the lips, where nothing is measured, takes the nearest measured
// pixel's radius within 6 pixels.
std::vector<Mark> marks_of(const MorphableModel& model, const CylinderScan& scan, const Landmarks* marks) {
  std::vector<Mark> out;
  if (!marks) return out;
  for (const Landmark& mark : marks->points) {
    if (!mark.valid) continue;
    const model::NamedVertex named = model::name_landmark(model, mark.name);
    if (named.contour) continue;
    const auto [h, phi] = place_at(scan, mark.x_px, mark.y_px);
    double best = 37, radius = 0;
    const int cx = static_cast<int>(std::lround(mark.x_px)), cy = static_cast<int>(std::lround(mark.y_px));
    for (int y = std::max(cy - 6, 0); y <= std::min(cy + 6, scan.picture.height - 1); ++y)
      for (int x = std::max(cx - 6, 0); x <= std::min(cx + 6, scan.picture.width - 1); ++x) {
        const double distance = (x - cx) * (x - cx) + (y - cy) * (y - cy);
        const auto r = static_cast<double>(scan.radius_mm[static_cast<std::size_t>(y * scan.picture.width + x)]);
        if (r > 0 && distance < best) best = distance, radius = r;
      }
    if (radius > 0)
      out.push_back(
          {named.vertex, vector_of(cylinder_point(scan.axis, {.h_mm = h, .phi_rad = phi, .radius_mm = radius}))});
  }
  return out;
}

// The farthest place from the axis in front (within 60 degrees).
bool nose_of(const CylinderScan& scan, Vector3d& nose) {
  double best = 0;
  for (int y = 0; y < scan.picture.height; ++y)
    for (int x = 0; x < scan.picture.width; ++x) {
      const auto [h, phi] = place_at(scan, x, y);
      const auto r = static_cast<double>(scan.radius_mm[static_cast<std::size_t>(y * scan.picture.width + x)]);
      if (std::fabs(phi) > 1.05 || !(r > best)) continue;
      best = r;
      nose = vector_of(cylinder_point(scan.axis, {.h_mm = h, .phi_rad = phi, .radius_mm = r}));
    }
  return best > 0;
}

class Fit {
 public:
  Fit(const MorphableModel& model, const CylinderScan& scan, std::vector<Mark> marks)
      : model_(model), scan_(scan), marks_(std::move(marks)) {
    const std::vector<std::uint8_t> skin = skin_polygons(model.mean, model.landmarks68);
    const render::Triangulation all = render::triangulate(model.mean, false);
    std::vector<std::uint8_t> used(model.mean.points_mm.size(), 0);
    for (std::size_t t = 0; t < all.triangles.size(); ++t) {
      if (!skin[all.polygons[t]]) continue;
      triangles_.push_back(all.triangles[t]);
      for (const std::uint32_t v : all.triangles[t]) used[v] = 1;
    }
    for (std::uint32_t v = 0; v < used.size(); ++v)
      if (used[v]) skin_.push_back(v);
    coefficients_ = VectorXd::Zero(static_cast<Eigen::Index>(model.identity.size()));
  }

  Matrix3d turn = Matrix3d::Identity();
  Vector3d shift = Vector3d::Zero();

  const VectorXd& coefficients() const { return coefficients_; }
  double rms_mm() const { return rms_mm_; }
  double used() const { return used_; }

  // The model without its motion.
  std::vector<Vec3f> shape() const {
    std::vector<Vec3f> points = model_.mean.points_mm;
    for (std::size_t k = 0; k < model_.identity.size(); ++k) {
      const auto c = static_cast<float>(coefficients_[static_cast<Eigen::Index>(k)]);
      if (c == 0) continue;
      const Vec3f* mode = model_.identity.modes.data() + k * points.size();
      for (std::size_t v = 0; v < points.size(); ++v)
        for (std::size_t a = 0; a < 3; ++a) points[v][a] += c * mode[v][a];
    }
    return points;
  }

  std::vector<Vec3f> placed() const {
    std::vector<Vec3f> points = shape();
    for (Vec3f& p : points) {
      const Vector3d q = turn * vector_of(p) + shift;
      for (std::size_t a = 0; a < 3; ++a) p[a] = static_cast<float>(q[static_cast<Eigen::Index>(a)]);
    }
    return points;
  }

  // One Gauss-Newton step of the motion and the first `components` coefficients. mark_weight: of a mark, as a share of
  // all vertices.
  void step(Eigen::Index components, double scale_mm, double mark_weight, double stiffness_mm2) {
    const std::vector<Vec3f> points = placed();
    const std::vector<Vec3f> normals = render::vertex_normals(points, triangles_);
    const Eigen::Index unknowns = 6 + components;
    MatrixXd a = MatrixXd::Zero(unknowns, unknowns);
    VectorXd b = VectorXd::Zero(unknowns), row(unknowns);
    Vector3d middle = Vector3d::Zero();
    for (const std::uint32_t v : skin_) middle += vector_of(points[v]);
    middle /= static_cast<double>(skin_.size());
    const auto add = [&](std::uint32_t v, const Vector3d& n, double residual, double weight) {
      const Vector3d arm = vector_of(points[v]) - middle, in_model = turn.transpose() * n;
      row.head<3>() = arm.cross(n);
      row.segment<3>(3) = n;
      for (Eigen::Index k = 0; k < components; ++k)
        row[6 + k] = in_model.dot(vector_of(model_.identity.modes[static_cast<std::size_t>(k) * points.size() + v]));
      a.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
      b -= weight * residual * row;
    };
    double facing = 0, met = 0, squares = 0, weights = 0;
    for (const std::uint32_t v : skin_) {
      const CylinderPlace place = cylinder_place(scan_.axis, points[v]);
      const Vec3f foot = cylinder_point(scan_.axis, {.h_mm = place.h_mm, .phi_rad = place.phi_rad, .radius_mm = 0});
      const Vector3d outwards = (vector_of(points[v]) - vector_of(foot)).normalized();
      if (!(vector_of(normals[v]).dot(outwards) > 0.3)) continue;
      const auto surface = surface_at(scan_, place.h_mm, place.phi_rad);
      if (!surface) continue;
      ++facing;
      const Vector3d n = vector_of(surface->normal);
      if (!(vector_of(normals[v]).dot(n) > 0.5)) continue;
      const double residual = n.dot(vector_of(points[v]) - vector_of(surface->point_mm));
      const double ratio = residual / scale_mm, weight = 1 / ((1 + ratio * ratio) * (1 + ratio * ratio));
      met += weight >= 0.5 ? 1 : 0;
      squares += weight * residual * residual;
      weights += weight;
      add(v, n, residual, weight);
    }
    rms_mm_ = weights > 0 ? std::sqrt(squares / weights) : 0;
    used_ = facing > 0 ? met / facing : 0;
    surfaces_ = met / static_cast<double>(skin_.size());
    const double all = std::max(weights, 1.0);
    for (const Mark& mark : marks_)
      for (int axis = 0; axis < 3; ++axis)
        add(mark.vertex, Vector3d::Unit(axis), (vector_of(points[mark.vertex]) - mark.place)[axis], mark_weight * all);
    for (Eigen::Index k = 0; k < components; ++k) {
      a(6 + k, 6 + k) += stiffness_mm2 * all;
      b[6 + k] -= stiffness_mm2 * all * coefficients_[k];
    }
    for (Eigen::Index k = 0; k < 6; ++k) a(k, k) += 1e-9 * all;
    const VectorXd x = a.selfadjointView<Eigen::Lower>().ldlt().solve(b);
    if (!x.allFinite()) return;
    const Vector3d omega = x.head<3>();
    const double angle = std::min(omega.norm(), 0.5);
    const Matrix3d by =
        angle > 0 ? Eigen::AngleAxisd(angle, omega.normalized()).toRotationMatrix() : Matrix3d::Identity();
    turn = by * turn;
    shift = by * (shift - middle) + middle + x.segment<3>(3);
    coefficients_.head(components) += x.tail(components);
  }

  double surfaces() const { return surfaces_; }

 private:
  const MorphableModel& model_;
  const CylinderScan& scan_;
  std::vector<Mark> marks_;
  std::vector<render::Triangle> triangles_;
  std::vector<std::uint32_t> skin_;
  VectorXd coefficients_;
  double rms_mm_ = 0, used_ = 0, surfaces_ = 0;
};

}  // namespace

FitIdentityResult fit_identity(const MorphableModel& model, const CylinderScan& scan, const Landmarks* marks,
                               const FitIdentityOptions& options) {
  check_cylinder(scan, "scan");
  const std::size_t vertices = model.mean.points_mm.size();
  check(vertices > 0, "the model has no vertices");
  check(model.identity.modes.size() == model.identity.size() * vertices, "the model has ", model.identity.modes.size(),
        " identity offsets, expected ", model.identity.size(), " x ", vertices);
  // From the marks, and from the nose alone: marks that were mistaken must not spoil what needs none.
  std::vector<Fit> fits;
  std::vector<Mark> placed_marks = marks_of(model, scan, marks);
  std::vector<std::array<double, 3>> from, to;
  for (const Mark& mark : placed_marks) {
    const Vec3f& p = model.mean.points_mm.at(mark.vertex);
    from.push_back({static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    to.push_back({mark.place[0], mark.place[1], mark.place[2]});
  }
  const align::AbsoluteOrientation start = align::absolute_orientation(from, to, std::vector<double>(from.size(), 1.0));
  if (start.solved) {
    fits.emplace_back(model, scan, placed_marks);
    for (Eigen::Index r = 0; r < 3; ++r) {
      for (Eigen::Index c = 0; c < 3; ++c)
        fits.back().turn(r, c) = start.to_from.rotation[static_cast<std::size_t>(3 * r + c)];
      fits.back().shift[r] = start.to_from.translation_mm[static_cast<std::size_t>(r)];
    }
  }
  Vector3d nose = Vector3d::Zero();
  if (model.landmarks68.size() == 68 && nose_of(scan, nose)) {
    fits.emplace_back(model, scan, std::vector<Mark>{});
    fits.back().shift = nose - vector_of(model.mean.points_mm.at(model.landmarks68[30]));
  }
  FitIdentityResult result;
  result.coefficients = {1, model.identity.size(), std::vector<double>(model.identity.size(), 0.0)};
  result.points.points_mm = model.mean.points_mm;
  if (fits.empty()) return result;
  const auto most = std::min<Eigen::Index>(options.components, static_cast<Eigen::Index>(model.identity.size()));
  const double scale = options.scale_mm;
  const auto run = [&](Fit& fit, Eigen::Index components, double scale_mm, double mark_weight) {
    for (std::int64_t s = 0; s < options.steps; ++s)
      fit.step(std::min(components, most), scale_mm, mark_weight, options.stiffness_mm2);
  };
  for (Fit& one : fits) {
    run(one, 0, 16 * scale, 0.1);
    run(one, 4, 12 * scale, 0.02);
  }
  // The marks' fit goes first unless the other covers clearly more.
  Fit& fit = fits.size() > 1 && fits[1].surfaces() > 1.1 * fits[0].surfaces() ? fits[1] : fits[0];
  run(fit, 12, 6 * scale, 0.005);
  run(fit, most, 3 * scale, 0.002);
  run(fit, most, scale, 0.0005);
  result.solved = fit.surfaces() >= 0.1;
  result.points.points_mm = fit.placed();
  for (std::size_t k = 0; k < model.identity.size(); ++k)
    result.coefficients.values[k] = fit.coefficients()[static_cast<Eigen::Index>(k)];
  for (Eigen::Index r = 0; r < 3; ++r) {
    for (Eigen::Index c = 0; c < 3; ++c)
      result.scan_from_model.rotation[static_cast<std::size_t>(3 * r + c)] = fit.turn(r, c);
    result.scan_from_model.translation_mm[static_cast<std::size_t>(r)] = fit.shift[r];
  }
  result.rms_mm = fit.rms_mm();
  result.used = fit.used();
  return result;
}

}  // namespace face::transfer
