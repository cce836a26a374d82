// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/landmark_basis.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "nodes/model/check_model.h"
#include "nodes/model/name_landmark.h"
#include "nodes/model/skin_modes.h"
#include "nodes/render/triangulate.h"

namespace face::model {
namespace {

constexpr float outline_reach_mm = 32;      // from the points 0 to 16 of the mean: where an outline may come to lie
constexpr float feature_reach_mm = 17;      // from eyes, nose and mouth: where it may not
constexpr double orthogonal_cosine = 0.25;  // of normal and line of sight
constexpr double usual_eye_distance_mm = 90;

double squared(const Vec3f& a, const Vec3f& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += (static_cast<double>(a[k]) - b[k]) * (static_cast<double>(a[k]) - b[k]);
  return sum;
}

std::vector<bool> outline_vertices(const MorphableModel& model) {
  const std::vector<bool> skin = skin_vertices(model.mean);
  std::vector<bool> result(skin.size(), false);
  if (model.landmarks68.size() != 68) return skin;
  const auto near = [&](const Vec3f& p, std::size_t first, std::size_t last, float reach) {
    for (std::size_t i = first; i <= last; ++i)
      if (squared(p, model.mean.points_mm[model.landmarks68[i]]) < static_cast<double>(reach) * reach) return true;
    return false;
  };
  for (std::size_t v = 0; v < skin.size(); ++v) {
    const Vec3f& p = model.mean.points_mm[v];
    result[v] = skin[v] && near(p, 0, 16, outline_reach_mm) && !near(p, 17, 67, feature_reach_mm);
  }
  return result;
}

}  // namespace

LandmarkBasis make_landmark_basis(const MorphableModel& model, const Landmarks& landmarks, std::size_t identities,
                                  std::size_t expressions) {
  check_model(model);
  LandmarkBasis basis;
  basis.identities = std::min(identities, model.identity.size());
  basis.expressions = std::min(expressions, model.expression.size());
  constexpr std::uint32_t unused = 0xffffffff;
  std::vector<std::uint32_t> local(model.mean.points_mm.size(), unused);
  const auto use = [&](std::uint32_t vertex) {
    if (local[vertex] == unused) {
      local[vertex] = static_cast<std::uint32_t>(basis.vertices.size());
      basis.vertices.push_back(vertex);
    }
    return local[vertex];
  };
  bool any_contour = false;
  for (const Landmark& landmark : landmarks.points) {
    if (!landmark.valid) continue;
    const NamedVertex named = name_landmark(model, landmark.name);
    any_contour = any_contour || named.contour;
    basis.points.push_back(
        {landmark.name, landmark.x_px, landmark.y_px, named.contour, named.contour ? 0 : use(named.vertex)});
  }
  if (model.landmarks68.size() == 68) {
    basis.eye_r = use(model.landmarks68[36]);
    basis.eye_l = use(model.landmarks68[45]);
    basis.has_eyes = true;
  }
  if (any_contour) {
    const std::vector<bool> outline = outline_vertices(model);
    for (const render::Triangle& t : render::triangulate(model.mean).triangles)
      if (outline[t[0]] || outline[t[1]] || outline[t[2]]) basis.triangles.push_back({use(t[0]), use(t[1]), use(t[2])});
    for (std::size_t v = 0; v < outline.size(); ++v)
      if (outline[v] && local[v] != unused) basis.candidates.push_back(local[v]);
  }
  const std::size_t columns = basis.coefficients(), vertices = model.mean.points_mm.size();
  basis.modes.resize(basis.vertices.size() * 3 * columns);
  for (std::size_t i = 0; i < basis.vertices.size(); ++i) {
    const std::uint32_t v = basis.vertices[i];
    basis.mean_mm.push_back(model.mean.points_mm[v]);
    for (std::size_t k = 0; k < columns; ++k) {
      const Vec3f& offset = k < basis.identities ? model.identity.modes[k * vertices + v]
                                                 : model.expression.modes[(k - basis.identities) * vertices + v];
      for (std::size_t axis = 0; axis < 3; ++axis) basis.modes[(3 * i + axis) * columns + k] = offset[axis];
    }
  }
  return basis;
}

std::vector<Vec3f> posed(const LandmarkBasis& basis, const std::vector<double>& coefficients) {
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto rows = static_cast<Eigen::Index>(3 * basis.vertices.size());
  const auto columns = static_cast<Eigen::Index>(basis.coefficients());
  std::vector<Vec3f> points = basis.mean_mm;
  if (columns == 0 || rows == 0) return points;
  const Eigen::VectorXf c =
      Eigen::Map<const Eigen::VectorXd>(coefficients.data(), static_cast<Eigen::Index>(coefficients.size()))
          .head(columns)
          .cast<float>();
  Eigen::Map<Eigen::VectorXf>(points.data()->data(), rows) +=
      Eigen::Map<const Rows>(basis.modes.data(), rows, columns) * c;
  return points;
}

void assign_contours(const std::vector<Vec3f>& posed_mm, const FacePose& pose, LandmarkBasis& basis) {
  if (basis.candidates.empty()) return;
  const std::vector<Vec3f> normals = render::vertex_normals(posed_mm, basis.triangles);
  const Camera camera = camera_of(pose);
  struct Seen {
    double x_px, y_px;
    std::uint32_t vertex;
  };
  std::vector<Seen> rim;
  for (const std::uint32_t v : basis.candidates) {
    double dot = 0, length = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double ray = static_cast<double>(posed_mm[v][k]) - camera.position_mm[k];
      dot += ray * normals[v][k];
      length += ray * ray;
    }
    if (std::abs(dot) > orthogonal_cosine * std::sqrt(length)) continue;
    const PoseView seen = view(pose, posed_mm[v]);
    rim.push_back({seen.x_px, seen.y_px, v});
  }
  for (LandmarkBasis::Point& point : basis.points) {
    if (!point.contour) continue;
    double nearest = 1e30;
    for (const Seen& seen : rim) {
      const double d =
          (seen.x_px - point.x_px) * (seen.x_px - point.x_px) + (seen.y_px - point.y_px) * (seen.y_px - point.y_px);
      if (d < nearest) {
        nearest = d;
        point.vertex = seen.vertex;
      }
    }
  }
}

LandmarkRows landmark_rows(const LandmarkBasis& basis, const std::vector<Vec3f>& posed_mm, const FacePose& pose) {
  LandmarkRows rows;
  const std::size_t modes = basis.coefficients();
  rows.columns = FacePose::size + modes;
  rows.jacobian.assign(2 * basis.points.size() * rows.columns, 0.0);
  rows.residual_px.reserve(2 * basis.points.size());
  double* row = rows.jacobian.data();
  for (const LandmarkBasis::Point& point : basis.points) {
    const PoseView seen = view(pose, posed_mm[point.vertex]);
    rows.residual_px.push_back(seen.x_px - point.x_px);
    rows.residual_px.push_back(seen.y_px - point.y_px);
    const float* offsets = basis.modes.data() + 3 * point.vertex * modes;
    for (std::size_t axis = 0; axis < 2; ++axis, row += rows.columns) {
      std::copy(seen.by_pose[axis].begin(), seen.by_pose[axis].end(), row);
      for (std::size_t k = 0; k < modes; ++k)
        row[FacePose::size + k] = seen.by_point[axis][0] * offsets[k] + seen.by_point[axis][1] * offsets[modes + k] +
                                  seen.by_point[axis][2] * offsets[2 * modes + k];
    }
  }
  return rows;
}

double eye_distance_px(const LandmarkBasis& basis, const std::vector<Vec3f>& posed_mm, const FacePose& pose) {
  const double mm =
      basis.has_eyes ? std::sqrt(squared(posed_mm[basis.eye_r], posed_mm[basis.eye_l])) : usual_eye_distance_mm;
  return mm * std::exp(pose.log_scale);
}

}  // namespace face::model
