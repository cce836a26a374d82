// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/flame_model.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/npy.h"
#include "nodes/decode/zip_file.h"

namespace face::decode {
namespace {

constexpr std::size_t jaw_joint = 2;   // after root and neck
constexpr double jaw_turn_rad = 0.15;  // one standard deviation of speech, about

class Arrays {
 public:
  explicit Arrays(const engine::File& file) : title_(title_of(file)), files_(read_zip(file)) {}

  bool has(const std::string& name) const { return files_.contains(name + ".npy"); }

  Matrix read(const std::string& name) const {
    const auto found = files_.find(name + ".npy");
    if (found == files_.end()) {
      std::string names;
      for (const auto& [other, bytes] : files_) names += (names.empty() ? "" : ", ") + other;
      fail(title_, ": holds no array ", name, ", expected v_template, f and shapedirs. Found ",
           names.empty() ? "nothing" : names);
    }
    const Matrix matrix = npy(engine::File::from_bytes(found->second, title_ + "/" + name + ".npy"));
    for (const double value : matrix.values)
      check(std::isfinite(value), title_, ": ", name, " holds a number that is not finite");
    return matrix;
  }

  const std::string& title() const { return title_; }

 private:
  std::string title_;
  std::map<std::string, std::string> files_;
};

void add_jaw(const Arrays& arrays, MorphableModel& model) {
  const std::vector<Vec3f>& points = model.mean.points_mm;
  const Matrix weights = arrays.read("weights"), regressor = arrays.read("J_regressor");
  check(weights.rows == points.size() && regressor.columns == points.size() && weights.columns == regressor.rows,
        arrays.title(), ": weights are ", weights.rows, " x ", weights.columns, " and J_regressor ", regressor.rows,
        " x ", regressor.columns, ", expected vertices x joints and joints x vertices, ", points.size(), " vertices");
  if (regressor.rows <= jaw_joint) return;
  double height = 0, depth = 0;  // of the joint
  for (std::size_t v = 0; v < points.size(); ++v) {
    const double share = regressor.values[jaw_joint * regressor.columns + v];
    height += share * points[v][1];
    depth += share * points[v][2];
  }
  for (std::size_t v = 0; v < points.size(); ++v) {
    const double turn = jaw_turn_rad * weights.values[v * weights.columns + jaw_joint];
    model.expression.modes.push_back(
        {0, static_cast<float>(-turn * (points[v][2] - depth)), static_cast<float>(turn * (points[v][1] - height))});
  }
  model.expression.names.emplace_back("jaw_open");
  model.expression.sigmas.push_back(1);
}

}  // namespace

MorphableModel read_flame_model(const engine::File& file, std::size_t identities, LengthUnit unit) {
  const Arrays arrays(file);
  const std::string& title = arrays.title();
  const Matrix points = arrays.read("v_template"), triangles = arrays.read("f"), modes = arrays.read("shapedirs");
  const std::size_t vertices = points.rows;
  check(vertices > 0 && points.columns == 3, title, ": v_template is ", points.rows, " x ", points.columns,
        ", expected V x 3");
  check(triangles.rows > 0 && triangles.columns == 3, title, ": f is ", triangles.rows, " x ", triangles.columns,
        ", expected F x 3");
  check(modes.rows == vertices && modes.columns % 3 == 0, title, ": shapedirs has ", modes.rows, " x ", modes.columns,
        " numbers, expected ", vertices, " x 3 x K");
  MorphableModel model;
  Mesh& mesh = model.mean;
  for (std::size_t v = 0; v < vertices; ++v)
    mesh.points_mm.push_back({static_cast<float>(points.values[3 * v]), static_cast<float>(points.values[3 * v + 1]),
                              static_cast<float>(points.values[3 * v + 2])});
  const float scale = mm_per_unit(unit, mesh.points_mm);
  for (Vec3f& point : mesh.points_mm)
    for (float& x : point) x *= scale;
  for (const double corner : triangles.values) {
    check(corner >= 0 && corner < static_cast<double>(vertices) && corner == std::floor(corner), title,
          ": a triangle of f has vertex ", corner, ", expected a whole number below ", vertices);
    mesh.corners.push_back(static_cast<std::uint32_t>(corner));
  }
  for (std::size_t i = 0; i <= mesh.corners.size(); i += 3)
    mesh.polygon_starts.push_back(static_cast<std::uint32_t>(i));
  const std::size_t count = modes.columns / 3;
  for (std::size_t k = 0; k < count; ++k) {
    const bool person = k < identities;
    LinearSpace& space = person ? model.identity : model.expression;
    space.names.push_back((person ? "shape_" : "expression_") + std::to_string(space.size()));
    space.sigmas.push_back(1);
    for (std::size_t v = 0; v < vertices; ++v) {
      Vec3f offset{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        offset[axis] = scale * static_cast<float>(modes.values[v * modes.columns + axis * count + k]);
      space.modes.push_back(offset);
    }
  }
  if (arrays.has("weights") && arrays.has("J_regressor")) add_jaw(arrays, model);
  return model;
}

}  // namespace face::decode
