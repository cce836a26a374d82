// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/from_rig.h"

#include <Eigen/Dense>
#include <algorithm>
#include <string_view>

#include "nodes/base/check.h"
#include "nodes/base/random.h"
#include "nodes/model/skin_modes.h"

namespace face::model {
namespace {

// Shapes of a speaking or showing face come in pairs that mostly move together.
std::string pair_name(std::string_view name) {
  for (const std::string_view side : {"Left", "Right", "_L", "_R"})
    if (name.ends_with(side) && name != "jawLeft" && name != "jawRight" && name != "mouthLeft" && name != "mouthRight")
      return std::string(name.substr(0, name.size() - side.size()));
  return std::string(name);
}

bool moves_eyeballs(std::string_view name) { return name.starts_with("eyeLook") || name.starts_with("Pupil"); }
bool is_mouth(std::string_view name) { return name.starts_with("mouth") || name.starts_with("jaw"); }
bool shows_tongue(std::string_view name) { return name.starts_with("tongue"); }

// Weights of random faces: the jaw mostly, one to three other movements of the mouth, now and then brows, lids and
// cheeks. N x S.
Eigen::MatrixXd draw_faces(const std::vector<Shape>& shapes, const FromRigOptions& options) {
  std::vector<std::vector<Eigen::Index>> mouth, rest;
  std::vector<std::string> names;
  std::vector<std::vector<Eigen::Index>> groups;
  Eigen::Index jaw_open = -1, mouth_close = -1;
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    const std::string& name = shapes[s].name;
    if (shapes[s].vertices.empty() || moves_eyeballs(name) || shows_tongue(name)) continue;
    if (name == "jawOpen" || name == "mouthClose") {
      (name == "jawOpen" ? jaw_open : mouth_close) = static_cast<Eigen::Index>(s);
      continue;
    }
    const std::string key = pair_name(name);
    const auto found = std::find(names.begin(), names.end(), key);
    if (found == names.end()) {
      names.push_back(key);
      groups.push_back({static_cast<Eigen::Index>(s)});
    } else {
      groups[static_cast<std::size_t>(found - names.begin())].push_back(static_cast<Eigen::Index>(s));
    }
  }
  for (std::size_t g = 0; g < groups.size(); ++g) (is_mouth(names[g]) ? mouth : rest).push_back(groups[g]);
  Random random(static_cast<std::uint64_t>(options.seed));
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(options.samples, static_cast<Eigen::Index>(shapes.size()));
  const auto pick = [&](const std::vector<std::vector<Eigen::Index>>& from, Eigen::Index n) {
    if (from.empty()) return;
    const auto& group = from[static_cast<std::size_t>(random.uniform() * static_cast<double>(from.size()))];
    const double weight = random.uniform(0.2, 0.9);
    for (const Eigen::Index s : group) weights(n, s) = weight * random.uniform(0.85, 1.0);
  };
  for (Eigen::Index n = 0; n < options.samples; ++n) {
    const double open = random.uniform() < 0.7 ? random.uniform(0.0, 0.7) : 0.0;
    if (jaw_open >= 0) weights(n, jaw_open) = open;
    if (mouth_close >= 0 && random.uniform() < 0.25) weights(n, mouth_close) = open;
    const int count = 1 + static_cast<int>(random.uniform() * 3);
    for (int i = 0; i < count; ++i) pick(mouth, n);
    if (random.uniform() < 0.3) pick(rest, n);
  }
  return weights;
}

// Shapes as rows over the skin. S x 3V.
Eigen::MatrixXf shape_rows(const std::vector<Shape>& shapes, const std::vector<bool>& skin) {
  Eigen::MatrixXf rows =
      Eigen::MatrixXf::Zero(static_cast<Eigen::Index>(shapes.size()), static_cast<Eigen::Index>(3 * skin.size()));
  for (std::size_t s = 0; s < shapes.size(); ++s)
    for (std::size_t i = 0; i < shapes[s].vertices.size(); ++i) {
      const std::size_t vertex = shapes[s].vertices[i];
      if (skin[vertex])
        for (std::size_t k = 0; k < 3; ++k)
          rows(static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(3 * vertex + k)) = shapes[s].offsets_mm[i][k];
    }
  return rows;
}

LinearSpace expression_space(const Rig& rig, const FromRigOptions& options) {
  LinearSpace space;
  if (rig.shapes.empty()) return space;
  const Eigen::MatrixXd weights = draw_faces(rig.shapes, options);
  const Eigen::MatrixXf rows = shape_rows(rig.shapes, skin_vertices(rig.neutral));
  const Eigen::MatrixXd gram = (rows * rows.transpose()).cast<double>();
  // Faces X = W B (B the shapes): eigenvectors q of X X^T give components X^T q = B^T (W^T q), so a component is a mix
  // of the rig's shapes and carries eyes and teeth with it.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(weights * gram * weights.transpose());
  const Eigen::Index count = std::min<Eigen::Index>(options.expressions, weights.rows());
  const double scale = 1.0 / std::sqrt(static_cast<double>(weights.rows()));
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index column = weights.rows() - 1 - k;
    if (eigen.eigenvalues()[column] <= 1e-9 * eigen.eigenvalues()[weights.rows() - 1]) break;
    Eigen::VectorXd mix = weights.transpose() * eigen.eigenvectors().col(column) * scale;
    Eigen::Index largest = 0;
    mix.cwiseAbs().maxCoeff(&largest);
    if (mix[largest] < 0) mix = -mix;  // an eigenvector's sign is arbitrary
    std::vector<Vec3f> mode(rig.neutral.points_mm.size(), Vec3f{0, 0, 0});
    for (std::size_t s = 0; s < rig.shapes.size(); ++s)
      for (std::size_t i = 0; i < rig.shapes[s].vertices.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
          mode[rig.shapes[s].vertices[i]][axis] +=
              static_cast<float>(mix[static_cast<Eigen::Index>(s)]) * rig.shapes[s].offsets_mm[i][axis];
    space.names.push_back("expression_" + std::to_string(k));
    space.sigmas.push_back(1);
    space.modes.insert(space.modes.end(), mode.begin(), mode.end());
  }
  return space;
}

}  // namespace

void add_made_skins(const Rig& rig, const FromRigOptions& options, MorphableModel& model) {
  model.mean_albedo = vertex_albedo(rig.neutral);
  const auto albedos = static_cast<std::size_t>(options.albedos);
  if (options.skins > 1 && rig.landmarks68.size() == 68) {
    SkinSpace skins = learn_skins(rig, static_cast<std::size_t>(options.skins), albedos * 2 / 3, options.seed + 10000);
    model.mean_albedo = std::move(skins.mean);
    model.albedo = std::move(skins.modes);
    const LinearSpace waves = skin_modes(rig.neutral, model.mean_albedo, {}, albedos - model.albedo.size());
    model.albedo.names.insert(model.albedo.names.end(), waves.names.begin(), waves.names.end());
    model.albedo.sigmas.insert(model.albedo.sigmas.end(), waves.sigmas.begin(), waves.sigmas.end());
    model.albedo.modes.insert(model.albedo.modes.end(), waves.modes.begin(), waves.modes.end());
  } else {
    model.albedo = skin_modes(rig.neutral, model.mean_albedo, rig.landmarks68, albedos);
  }
}

MorphableModel from_rig(const Rig& rig, const ShapeSet* identities, const FromRigOptions& options) {
  check(!rig.neutral.points_mm.empty(), "the rig has no vertices");
  check(options.samples >= 1, "samples is ", options.samples, ", expected at least 1");
  MorphableModel model;
  model.mean = rig.neutral;
  const std::size_t vertices = rig.neutral.points_mm.size();
  if (identities != nullptr)
    for (const Shape& shape : identities->shapes) {
      std::vector<Vec3f> mode(vertices, Vec3f{0, 0, 0});
      for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
        check(shape.vertices[i] < vertices, "identity mode \"", shape.name, "\" moves vertex ", shape.vertices[i],
              ", but the rig has ", vertices);
        mode[shape.vertices[i]] = shape.offsets_mm[i];
      }
      model.identity.names.push_back(shape.name);
      model.identity.sigmas.push_back(1);
      model.identity.modes.insert(model.identity.modes.end(), mode.begin(), mode.end());
    }
  model.expression = expression_space(rig, options);
  add_made_skins(rig, options, model);
  model.landmarks68 = rig.landmarks68;
  model.inner_lips = rig.inner_lips;
  return model;
}

}  // namespace face::model
