// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/pose_model.h"

#include "nodes/base/check.h"
#include "nodes/model/check_model.h"
#include "nodes/model/skin_modes.h"

namespace face::model {
namespace {

void add(const LinearSpace& space, const std::vector<float>& coefficients, const char* name,
         std::vector<Vec3f>& values) {
  check(coefficients.size() <= space.size(), "there are ", coefficients.size(), " ", name,
        " coefficients, but the model has ", space.size(), " components");
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    const float c = coefficients[k];
    if (c == 0) continue;
    const Vec3f* mode = space.modes.data() + k * values.size();
    for (std::size_t v = 0; v < values.size(); ++v)
      for (std::size_t axis = 0; axis < 3; ++axis) values[v][axis] += c * mode[v][axis];
  }
}

}  // namespace

std::vector<Vec3f> pose_model(const MorphableModel& model, const std::vector<float>& identity,
                              const std::vector<float>& expression) {
  std::vector<Vec3f> points = model.mean.points_mm;
  add(model.identity, identity, "identity", points);
  add(model.expression, expression, "expression", points);
  return points;
}

std::vector<Vec3f> albedo_of(const MorphableModel& model, const std::vector<float>& albedo) {
  std::vector<Vec3f> result = model.mean_albedo;
  add(model.albedo, albedo, "albedo", result);
  return result;
}

std::vector<std::vector<double>> lip_gap_rows(const MorphableModel& model) {
  check_model(model);
  std::vector<std::vector<double>> rows;
  const std::size_t vertices = model.mean.points_mm.size();
  for (const LipPair& pair : model.inner_lips) {
    std::vector<double>& row = rows.emplace_back(model.expression.size(), 0.0);
    for (std::size_t k = 0; k < row.size(); ++k) {
      const Vec3f* mode = model.expression.modes.data() + k * vertices;
      row[k] = static_cast<double>(mode[pair.upper][1]) - mode[pair.lower][1];
    }
  }
  return rows;
}

double lip_gap_of(const MorphableModel& model, const std::vector<float>& expression) {
  const std::vector<std::vector<double>> rows = lip_gap_rows(model);
  double gap = 0;
  for (const std::vector<double>& row : rows)
    for (std::size_t k = 0; k < expression.size() && k < row.size(); ++k) gap += row[k] * expression[k];
  return rows.empty() ? 0 : gap / static_cast<double>(rows.size());
}

Vec3f turning_point(const MorphableModel& model) {
  std::array<double, 3> sum = {0, 0, 0};
  std::size_t count = 0;
  const auto take = [&](const Vec3f& p) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += p[k];
    ++count;
  };
  if (!model.landmarks68.empty()) {
    for (const std::uint32_t v : model.landmarks68) take(model.mean.points_mm[v]);
  } else {
    const std::vector<bool> skin = skin_vertices(model.mean);
    for (std::size_t v = 0; v < skin.size(); ++v)
      if (skin[v]) take(model.mean.points_mm[v]);
  }
  const double share = count > 0 ? 1.0 / static_cast<double>(count) : 0.0;
  return {static_cast<float>(sum[0] * share), static_cast<float>(sum[1] * share), static_cast<float>(sum[2] * share)};
}

}  // namespace face::model
