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

int opacity_of(const Image& image, std::size_t pixel) {
  return image.channels == 4 ? image.pixels[4 * pixel + 3] : 255;
}

// Means of squares of pixels, in RGBA; a transparent pixel's colour does not count beside one that is seen.
Image shrunk(const Image& image) {
  const int factor = (std::max(image.width, image.height) + largest_side_px - 1) / largest_side_px;
  Image out{std::max(1, image.width / factor), std::max(1, image.height / factor), 4, {}};
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      int opacity = 0, count = 0;
      std::array<int, 3> plain{}, weighted{};
      for (int j = y * factor; j < std::min((y + 1) * factor, image.height); ++j)
        for (int i = x * factor; i < std::min((x + 1) * factor, image.width); ++i, ++count) {
          const auto pixel = static_cast<std::size_t>(j * image.width + i);
          const int here = opacity_of(image, pixel);
          opacity += here;
          for (std::size_t c = 0; c < 3; ++c) {
            const int value =
                image.pixels[pixel * static_cast<std::size_t>(image.channels) + (image.channels == 1 ? 0 : c)];
            plain[c] += value;
            weighted[c] += here * value;
          }
        }
      const auto mean = [](int sum, int of) { return static_cast<std::uint8_t>((sum + of / 2) / std::max(of, 1)); };
      for (std::size_t c = 0; c < 3; ++c)
        out.pixels.push_back(opacity > 0 ? mean(weighted[c], opacity) : mean(plain[c], count));
      out.pixels.push_back(mean(opacity, count));
    }
  return out;
}

int wrapped(int index, int size) { return (index % size + size) % size; }

// The four pixels about a place, and what each counts.
struct Neighbours {
  std::array<std::size_t, 4> pixels{};
  std::array<float, 4> weights{};
};

Neighbours neighbours_of(const Image& picture, const Vec2f& uv) {
  const float x = (uv[0] - std::floor(uv[0])) * static_cast<float>(picture.width) - 0.5f,
              y = (uv[1] - std::floor(uv[1])) * static_cast<float>(picture.height) - 0.5f;
  const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
  const float right_share = x - static_cast<float>(left), lower_share = y - static_cast<float>(top);
  Neighbours about;
  for (int k = 0; k < 4; ++k) {
    const int column = wrapped(left + k % 2, picture.width), row = wrapped(top + k / 2, picture.height);
    about.pixels[static_cast<std::size_t>(k)] = static_cast<std::size_t>(row * picture.width + column);
    about.weights[static_cast<std::size_t>(k)] =
        (k % 2 == 0 ? 1 - right_share : right_share) * (k / 2 == 0 ? 1 - lower_share : lower_share);
  }
  return about;
}

bool is_finite(const Vec2f& uv) { return std::isfinite(uv[0]) && std::isfinite(uv[1]); }

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

Vec3f colour_at(const Image& picture, const Vec2f& uv) {
  if (!is_finite(uv)) return {1, 1, 1};
  const Neighbours about = neighbours_of(picture, uv);
  Vec3f plain{}, weighted{};
  float opacity = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::uint8_t* pixel = picture.pixels.data() + 4 * about.pixels[k];
    const float here = about.weights[k] * static_cast<float>(pixel[3]) / 255;
    opacity += here;
    for (std::size_t c = 0; c < 3; ++c) {
      plain[c] += about.weights[k] / 255 * static_cast<float>(pixel[c]);
      weighted[c] += here / 255 * static_cast<float>(pixel[c]);
    }
  }
  if (opacity <= 0) return plain;
  for (float& value : weighted) value /= opacity;
  return weighted;
}

float cover_of(const Image& picture, const std::array<Vec2f, 3>& corners, float cutoff) {
  constexpr int steps = 6;  // along each side: 28 places
  float sum = 0, count = 0;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j, ++count) {
      const std::array<float, 3> shares = {static_cast<float>(i) / steps, static_cast<float>(j) / steps,
                                           static_cast<float>(steps - i - j) / steps};
      Vec2f uv{};
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < 2; ++k) uv[k] += shares[c] * corners[c][k];
      if (!is_finite(uv)) return 1;
      const Neighbours about = neighbours_of(picture, uv);
      float opacity = 0;
      for (std::size_t k = 0; k < 4; ++k)
        opacity += about.weights[k] * static_cast<float>(picture.pixels[4 * about.pixels[k] + 3]) / 255;
      sum += cutoff > 0 ? (opacity >= cutoff ? 1.0f : 0.0f) : opacity;
    }
  return sum / count;
}

}  // namespace face::decode
