// SPDX-License-Identifier: Apache-2.0
#pragma once
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

  // The picture on a primitive, shrunk to at most 512 pixels a side; null without one that can be read.
  const Image* picture_on(const tinygltf::Primitive& primitive);
  // Which of a vertex's texture coordinates place it.
  std::string coordinates_of(const tinygltf::Primitive& primitive) const;

 private:
  const tinygltf::Model& model_;
  const std::string& title_;
  std::map<int, Image> pictures_;  // by the file's number; without pixels where it cannot be read
};

// Its sRGB colour at a glTF texture coordinate (origin top left, repeated), between the pixels.
Vec3f colour_at(const Image& picture, float u, float v);

}  // namespace face::decode
