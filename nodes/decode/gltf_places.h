// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "nodes/types/vec.h"

namespace tinygltf {
class Model;
struct Primitive;
}  // namespace tinygltf

namespace face::decode {

// 4 x 4, column after column.
using GltfMatrix = std::array<double, 16>;

// w = 1 for points, 0 for offsets.
Vec3f apply(const GltfMatrix& m, const float* p, double w);

// Whether triangles turn round: the determinant of its upper left 3 x 3 is negative.
bool mirrors(const GltfMatrix& m);

// Where every node is in the scene: its own transform after those of all above it. Throws, with `title`, where a node
// is its own ancestor, or a child that there is not.
std::vector<GltfMatrix> gltf_places(const tinygltf::Model& model, const std::string& title);

// Where a skin puts each vertex of a primitive, in the pose in which the file's joints are (glTF 2.0, section 3.7.3.3:
// the node's own place does not count). places: of all nodes. `count` matrices, each the mean of its joints' by their
// weights; the one that changes nothing where the primitive has no joints.
std::vector<GltfMatrix> skin_places(const tinygltf::Model& model, int skin, const tinygltf::Primitive& primitive,
                                    const std::vector<GltfMatrix>& places, std::size_t count, const std::string& title);

}  // namespace face::decode
