// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <map>
#include <string>

#include "nodes/types/image.h"
#include "nodes/types/vec.h"

namespace tinygltf {
class Model;
struct Primitive;
}  // namespace tinygltf

namespace face::decode {

// The pictures that lie on a glTF file's surfaces (base colour, PNG, JPEG or WebP).
class GltfLooks {
 public:
  GltfLooks(const tinygltf::Model& model, const std::string& title) : model_(model), title_(title) {}

  // The picture on a primitive, RGBA, shrunk to at most 512 pixels a side; null without one that can be read.
  const Image* picture_on(const tinygltf::Primitive& primitive);
  // Which of a vertex's texture coordinates place it.
  std::string coordinates_of(const tinygltf::Primitive& primitive) const;

 private:
  const tinygltf::Model& model_;
  const std::string& title_;
  std::map<int, Image> pictures_;  // by the file's number; without pixels where it cannot be read
};

// Its sRGB colour at a glTF texture coordinate (origin top left, repeated), between the pixels; what is transparent
// there has no say.
Vec3f colour_at(const Image& picture, const Vec2f& uv);

// How much of a triangle the picture covers, 0 to 1; cutoff: least opacity that covers, 0 = in proportion to opacity.
float cover_of(const Image& picture, const std::array<Vec2f, 3>& corners, float cutoff);

}  // namespace face::decode
