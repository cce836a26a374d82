// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/gltf_looks.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "nodes/decode/frame_image.h"

namespace face::decode {
namespace {

constexpr int largest_side_px = 512;  // vertices are millimetres apart: finer detail would flicker from one to the next

template <class T>
const T* at(const std::vector<T>& list, int index) {
  return index >= 0 && static_cast<std::size_t>(index) < list.size() ? &list[static_cast<std::size_t>(index)] : nullptr;
}

const tinygltf::TextureInfo* base_colour(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const tinygltf::Material* material = at(model.materials, primitive.material);
  return material ? &material->pbrMetallicRoughness.baseColorTexture : nullptr;
}

// Which of the file's pictures a texture shows: a WebP one stands in an extension, with or without another for those
// who cannot read it. -1 without one.
int picture_of(const tinygltf::Texture& texture) {
  const auto webp = texture.extensions.find("EXT_texture_webp");
  if (webp == texture.extensions.end() || !webp->second.Has("source")) return texture.source;
  return webp->second.Get("source").GetNumberAsInt();
}

// Means of squares of pixels, in RGB.
Image shrunk(const Image& image) {
  const int factor = (std::max(image.width, image.height) + largest_side_px - 1) / largest_side_px;
  Image out{std::max(1, image.width / factor), std::max(1, image.height / factor), 3, {}};
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = 0, count = 0;
        for (int j = y * factor; j < std::min((y + 1) * factor, image.height); ++j)
          for (int i = x * factor; i < std::min((x + 1) * factor, image.width); ++i, ++count)
            sum += image.pixels[static_cast<std::size_t>((j * image.width + i) * image.channels +
                                                         (image.channels == 3 ? c : 0))];
        out.pixels.push_back(static_cast<std::uint8_t>((sum + count / 2) / std::max(count, 1)));
      }
  return out;
}

int wrapped(int index, int size) { return (index % size + size) % size; }

}  // namespace

const Image* GltfLooks::picture_on(const tinygltf::Primitive& primitive) {
  const tinygltf::TextureInfo* look = base_colour(model_, primitive);
  const tinygltf::Texture* texture = look ? at(model_.textures, look->index) : nullptr;
  const int number = texture ? picture_of(*texture) : -1;
  const tinygltf::Image* source = at(model_.images, number);
  if (!source || source->image.empty()) return nullptr;
  const auto [entry, added] = pictures_.try_emplace(number);
  if (added) {
    const std::string_view bytes(reinterpret_cast<const char*>(source->image.data()), source->image.size());
    const Image picture = read_picture_bytes(bytes, title_ + ": texture " + std::to_string(number));
    if (picture.width > 0) entry->second = shrunk(picture);
  }
  return entry->second.width > 0 ? &entry->second : nullptr;
}

std::string GltfLooks::coordinates_of(const tinygltf::Primitive& primitive) const {
  const tinygltf::TextureInfo* look = base_colour(model_, primitive);
  return "TEXCOORD_" + std::to_string(look ? look->texCoord : 0);
}

Vec3f colour_at(const Image& picture, float u, float v) {
  if (!std::isfinite(u) || !std::isfinite(v)) return {1, 1, 1};
  const float x = (u - std::floor(u)) * static_cast<float>(picture.width) - 0.5f,
              y = (v - std::floor(v)) * static_cast<float>(picture.height) - 0.5f;
  const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
  const float right_share = x - static_cast<float>(left), lower_share = y - static_cast<float>(top);
  Vec3f sum{};
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const float weight = (i == 0 ? 1 - right_share : right_share) * (j == 0 ? 1 - lower_share : lower_share);
      const int column = wrapped(left + i, picture.width), row = wrapped(top + j, picture.height);
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += weight / 255 *
                  static_cast<float>(picture.pixels[3 * static_cast<std::size_t>(row * picture.width + column) + c]);
    }
  return sum;
}

}  // namespace face::decode
