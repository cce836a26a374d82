// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/base/srgb.h"
#include "nodes/types/mesh.h"

namespace tinygltf {
class Model;
class Value;
}  // namespace tinygltf

namespace face::decode {

// The file's vertices as they are, before those that texture seams doubled are merged.
struct GltfMeshes {
  std::vector<Vec3f> points;
  std::vector<Vec2f> uvs;
  std::vector<Vec3f> colors;
  std::vector<Vec3f> pictured;  // the texture's colour there; a primitive may colour vertices of another's list
  bool any_uvs = false, any_colors = false, any_pictured = false;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Part> parts;
  std::vector<std::string> shape_names;           // in order of appearance
  std::vector<std::vector<Vec3f>> shape_offsets;  // of each: one per vertex
  const tinygltf::Value* notes = nullptr;         // extras.facegraph
};

// All meshes of the default scene, in its frame. Refuses what refers to nothing, naming it; title: how the file is
// called in what is said.
GltfMeshes collect_meshes(const tinygltf::Model& model, const std::string& title);

// glTF's colours are linear.
inline float srgb(double linear) { return static_cast<float>(srgb_of(std::clamp(linear, 0.0, 1.0))); }

}  // namespace face::decode
