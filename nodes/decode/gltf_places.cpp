// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/gltf_places.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>

#include "nodes/base/check.h"
#include "nodes/decode/gltf_accessor.h"

namespace face::decode {
namespace {

constexpr GltfMatrix unchanged = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

GltfMatrix product(const GltfMatrix& a, const GltfMatrix& b) {
  GltfMatrix out{};
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t k = 0; k < 4; ++k) out[c * 4 + r] += a[k * 4 + r] * b[c * 4 + k];
  return out;
}

GltfMatrix matrix_of(const tinygltf::Node& node) {
  GltfMatrix m = unchanged;
  if (node.matrix.size() == 16) {
    std::copy(node.matrix.begin(), node.matrix.end(), m.begin());
    return m;
  }
  if (node.rotation.size() == 4) {
    const double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
    m = {1 - 2 * (y * y + z * z),
         2 * (x * y + z * w),
         2 * (x * z - y * w),
         0,
         2 * (x * y - z * w),
         1 - 2 * (x * x + z * z),
         2 * (y * z + x * w),
         0,
         2 * (x * z + y * w),
         2 * (y * z - x * w),
         1 - 2 * (x * x + y * y),
         0,
         0,
         0,
         0,
         1};
  }
  if (node.scale.size() == 3)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t r = 0; r < 3; ++r) m[c * 4 + r] *= node.scale[c];
  if (node.translation.size() == 3)
    for (std::size_t r = 0; r < 3; ++r) m[12 + r] = node.translation[r];
  return m;
}

void place(const tinygltf::Model& model, const std::string& title, int index, const GltfMatrix& parent, int depth,
           std::vector<GltfMatrix>& places, std::vector<char>& placed) {
  check(index >= 0 && static_cast<std::size_t>(index) < model.nodes.size(), title, ": refers to node ", index, " of ",
        model.nodes.size());
  check(!placed[static_cast<std::size_t>(index)], title, ": node ", index,
        " has two parents, or is its own ancestor, expected a tree of nodes");
  check(depth < 256, title, ": nodes lie ", depth, " below one another, expected fewer than 256");
  placed[static_cast<std::size_t>(index)] = 1;
  const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(index)];
  const GltfMatrix own = product(parent, matrix_of(node));
  places[static_cast<std::size_t>(index)] = own;
  for (const int child : node.children) place(model, title, child, own, depth + 1, places, placed);
}

}  // namespace

Vec3f apply(const GltfMatrix& m, const float* p, double w) {
  Vec3f out;
  for (std::size_t r = 0; r < 3; ++r)
    out[r] = static_cast<float>(m[r] * static_cast<double>(p[0]) + m[4 + r] * static_cast<double>(p[1]) +
                                m[8 + r] * static_cast<double>(p[2]) + m[12 + r] * w);
  return out;
}

bool mirrors(const GltfMatrix& m) {
  return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) +
             m[8] * (m[1] * m[6] - m[2] * m[5]) <
         0;
}

std::vector<GltfMatrix> gltf_places(const tinygltf::Model& model, const std::string& title) {
  std::vector<GltfMatrix> places(model.nodes.size(), unchanged);
  std::vector<char> has_parent(model.nodes.size(), 0), placed(model.nodes.size(), 0);
  for (const tinygltf::Node& node : model.nodes)
    for (const int child : node.children)
      if (child >= 0 && static_cast<std::size_t>(child) < has_parent.size())
        has_parent[static_cast<std::size_t>(child)] = 1;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!has_parent[i]) place(model, title, static_cast<int>(i), unchanged, 0, places, placed);
  // Nodes of a ring have no first one.
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!placed[i]) place(model, title, static_cast<int>(i), unchanged, 0, places, placed);
  return places;
}

std::vector<GltfMatrix> skin_places(const tinygltf::Model& model, int skin, const tinygltf::Primitive& primitive,
                                    const std::vector<GltfMatrix>& places, std::size_t count,
                                    const std::string& title) {
  std::vector<GltfMatrix> out(count, unchanged);
  check(static_cast<std::size_t>(skin) < model.skins.size(), title, ": refers to skin ", skin, " of ",
        model.skins.size());
  const tinygltf::Skin& bones = model.skins[static_cast<std::size_t>(skin)];
  std::vector<GltfMatrix> joints;
  std::vector<float> inverse;
  if (bones.inverseBindMatrices >= 0) inverse = read_floats(model, bones.inverseBindMatrices, 16, title);
  for (std::size_t j = 0; j < bones.joints.size(); ++j) {
    const int node = bones.joints[j];
    check(node >= 0 && static_cast<std::size_t>(node) < places.size(), title, ": refers to node ", node, " of ",
          places.size());
    GltfMatrix bind = unchanged;
    if (16 * j + 16 <= inverse.size())
      std::copy_n(inverse.begin() + static_cast<std::ptrdiff_t>(16 * j), 16, bind.begin());
    joints.push_back(product(places[static_cast<std::size_t>(node)], bind));
  }
  std::vector<double> sums(count, 0.0);
  for (const char* set : {"0", "1", "2", "3"}) {
    const auto joint = primitive.attributes.find(std::string("JOINTS_") + set),
               weight = primitive.attributes.find(std::string("WEIGHTS_") + set);
    if (joint == primitive.attributes.end() || weight == primitive.attributes.end()) break;
    const std::vector<float> numbers = read_floats(model, joint->second, 4, title),
                             weights = read_floats(model, weight->second, 4, title);
    check(numbers.size() == 4 * count && weights.size() == 4 * count, title, ": has ", numbers.size() / 4,
          " joints and ", weights.size() / 4, " weights, its mesh has ", count, " vertices");
    for (std::size_t i = 0; i < 4 * count; ++i) {
      const auto w = static_cast<double>(weights[i]);
      if (!(w > 0)) continue;
      const auto j = static_cast<std::size_t>(numbers[i]);
      check(j < joints.size(), title, ": vertex ", i / 4, " hangs on joint ", j, " of ", joints.size());
      if (sums[i / 4] == 0) out[i / 4] = {};
      sums[i / 4] += w;
      for (std::size_t k = 0; k < 16; ++k) out[i / 4][k] += w * joints[j][k];
    }
  }
  for (std::size_t v = 0; v < count; ++v)
    if (sums[v] > 0)
      for (double& x : out[v]) x /= sums[v];
  return out;
}

}  // namespace face::decode
