// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/skin_basis.h"

#include <Eigen/Dense>
#include <algorithm>

#include "nodes/model/check_model.h"
#include "nodes/model/skin_modes.h"
#include "nodes/render/triangulate.h"

namespace face::model {
namespace {

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Shares of the height from chin to nose bridge.
constexpr float above_bridge = 0.42f, below_chin = 0.03f, behind_ears = 0.0f;

std::vector<bool> compared_vertices(const MorphableModel& model) {
  std::vector<bool> result = skin_vertices(model.mean);
  if (model.landmarks68.size() != 68) return result;
  const auto mark = [&](std::size_t i) { return model.mean.points_mm[model.landmarks68[i]]; };
  const float height = mark(27)[1] - mark(8)[1];
  const float top = mark(27)[1] + above_bridge * height, bottom = mark(8)[1] - below_chin * height;
  const float back = std::min(mark(0)[2], mark(16)[2]) - behind_ears * height;
  const float right = mark(0)[0] - 2, left = mark(16)[0] + 2;
  for (std::size_t v = 0; v < result.size(); ++v) {
    const Vec3f& p = model.mean.points_mm[v];
    result[v] = result[v] && p[1] < top && p[1] > bottom && p[2] > back && p[0] > right && p[0] < left;
  }
  return result;
}

void add(const std::vector<float>& modes, std::size_t columns, std::size_t first,
         const std::vector<double>& coefficients, std::vector<Vec3f>& values) {
  const auto used = static_cast<Eigen::Index>(coefficients.size());
  if (used == 0 || values.empty()) return;
  const Eigen::VectorXf c = Eigen::Map<const Eigen::VectorXd>(coefficients.data(), used).cast<float>();
  const auto rows = static_cast<Eigen::Index>(3 * values.size());
  Eigen::Map<Eigen::VectorXf>(values.data()->data(), rows).noalias() +=
      Eigen::Map<const Rows>(modes.data(), rows, static_cast<Eigen::Index>(columns))
          .middleCols(static_cast<Eigen::Index>(first), used) *
      c;
}

}  // namespace

SkinBasis make_skin_basis(const MorphableModel& model, std::size_t identities, std::size_t expressions,
                          std::size_t albedos) {
  check_model(model);
  SkinBasis basis;
  basis.identities = std::min(identities, model.identity.size());
  basis.expressions = std::min(expressions, model.expression.size());
  basis.albedos = std::min(albedos, model.albedo.size());
  const std::vector<bool> compared = compared_vertices(model);
  std::vector<std::uint32_t> local(compared.size(), 0);
  for (std::uint32_t v = 0; v < compared.size(); ++v)
    if (compared[v]) {
      local[v] = static_cast<std::uint32_t>(basis.vertices.size());
      basis.vertices.push_back(v);
      basis.mean_mm.push_back(model.mean.points_mm[v]);
      basis.mean_albedo.push_back(model.mean_albedo[v]);
    }
  for (const render::Triangle& t : render::triangulate(model.mean).triangles)
    if (compared[t[0]] && compared[t[1]] && compared[t[2]])
      basis.triangles.push_back({local[t[0]], local[t[1]], local[t[2]]});
  const std::size_t shapes = basis.shapes(), all = compared.size();
  basis.shape_modes.resize(basis.vertices.size() * 3 * shapes);
  basis.albedo_modes.resize(basis.vertices.size() * 3 * basis.albedos);
  const auto lay_out = [&](const LinearSpace& space, std::size_t count, std::size_t first, std::size_t columns,
                           std::vector<float>& modes) {
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t i = 0; i < basis.vertices.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
          modes[(3 * i + axis) * columns + first + k] = space.modes[k * all + basis.vertices[i]][axis];
  };
  lay_out(model.identity, basis.identities, 0, shapes, basis.shape_modes);
  lay_out(model.expression, basis.expressions, basis.identities, shapes, basis.shape_modes);
  lay_out(model.albedo, basis.albedos, 0, basis.albedos, basis.albedo_modes);
  return basis;
}

std::vector<Vec3f> posed_skin(const SkinBasis& basis, const std::vector<double>& identity,
                              const std::vector<double>& expression) {
  std::vector<Vec3f> points = basis.mean_mm;
  add(basis.shape_modes, basis.shapes(), 0, identity, points);
  add(basis.shape_modes, basis.shapes(), basis.identities, expression, points);
  return points;
}

std::vector<Vec3f> skin_albedo(const SkinBasis& basis, const std::vector<double>& albedo) {
  std::vector<Vec3f> result = basis.mean_albedo;
  add(basis.albedo_modes, basis.albedos, 0, albedo, result);
  return result;
}

}  // namespace face::model
