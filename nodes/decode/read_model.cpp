// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_model.h"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/decode/eos_model.h"
#include "nodes/decode/flame_model.h"
#include "nodes/decode/gltf_rig.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/json_file.h"

namespace face::decode {
namespace {

constexpr std::size_t landmark_count = 68;

bool is_person(const std::string& name) {
  const std::string text = lower(name);
  for (const std::string_view start : {"shape", "identity", "id_", "beta"})
    if (text.starts_with(start)) return true;
  return text.size() > 2 && text.starts_with("id") && text[2] >= '0' && text[2] <= '9';
}

MorphableModel of_rig(Rig rig) {
  MorphableModel model;
  const std::size_t vertices = rig.neutral.points_mm.size();
  for (const Shape& shape : rig.shapes) {
    if (shape.vertices.empty()) continue;
    LinearSpace& space = is_person(shape.name) ? model.identity : model.expression;
    const std::size_t first = space.modes.size();
    space.names.push_back(shape.name);
    space.sigmas.push_back(1);
    space.modes.resize(first + vertices, Vec3f{0, 0, 0});
    for (std::size_t i = 0; i < shape.vertices.size(); ++i)
      space.modes[first + shape.vertices[i]] = shape.offsets_mm[i];
  }
  model.mean = std::move(rig.neutral);
  model.landmarks68 = std::move(rig.landmarks68);
  model.inner_lips = std::move(rig.inner_lips);
  return model;
}

std::vector<std::uint32_t> read_vertices(const engine::File& file, std::size_t vertices) {
  const std::string title = title_of(file);
  const nlohmann::ordered_json json = read_json(file);
  if (!json.is_array() || json.size() != landmark_count)
    fail(title, ": found ", json.is_array() ? message("a list of ", json.size()) : describe_json(json),
         ", expected a list of 68 vertices (Multi-PIE's points in their order)");
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const long vertex = json_index(json[i], title, "/" + std::to_string(i));
    check(static_cast<std::size_t>(vertex) < vertices, title, " at /", i, ": found vertex ", vertex,
          ", but the model has ", vertices);
    result.push_back(static_cast<std::uint32_t>(vertex));
  }
  return result;
}

}  // namespace

MorphableModel read_model(const engine::File& file, const engine::File* expressions, const engine::File* landmarks,
                          const ReadModelOptions& options) {
  const std::string suffix = file.is_folder() ? "" : lower_suffix(file);
  check(expressions == nullptr || suffix == ".bin", title_of(file),
        ": has expressions of its own, blend shapes beside it are for a .bin");
  MorphableModel model;
  if (suffix == ".bin")
    model = read_eos_model(file, expressions, options.unit);
  else if (suffix == ".npz")
    model = read_flame_model(file, static_cast<std::size_t>(options.identities), options.unit);
  else if (suffix == ".glb" || suffix == ".gltf" || suffix == ".vrm")
    model = of_rig(read_gltf_rig(file, {}, options.unit));
  else if (suffix == ".pkl")
    fail(title_of(file),
         ": a pickle can hold any program and is not opened; save v_template, f, shapedirs, weights and "
         "J_regressor with numpy.savez instead");
  else
    fail(title_of(file), ": found a ", file.is_folder() ? "folder" : "file \"" + suffix + "\"",
         ", expected a morphable model: .bin of eos, .npz or .glb (an ICT-FaceKit folder: model.from_rig)");
  if (landmarks != nullptr) model.landmarks68 = read_vertices(*landmarks, model.mean.points_mm.size());
  return model;
}

}  // namespace face::decode
