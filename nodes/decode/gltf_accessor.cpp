// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/gltf_accessor.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "nodes/base/check.h"

namespace face::decode {
namespace {

// Rows of values in a buffer.
struct Bytes {
  const unsigned char* data = nullptr;
  std::size_t stride = 0;
};

Bytes locate(const tinygltf::Model& model, int view_index, std::size_t offset, std::size_t row_bytes, std::size_t rows,
             std::size_t own_stride, const std::string& what) {
  if (view_index < 0 || static_cast<std::size_t>(view_index) >= model.bufferViews.size())
    fail(what, ": found buffer view ", view_index, ", expected one of ", model.bufferViews.size());
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_index)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size())
    fail(what, ": found buffer ", view.buffer, ", expected one of ", model.buffers.size());
  const auto& buffer = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  const std::size_t stride = own_stride > 0 ? own_stride : row_bytes;
  const std::size_t begin = view.byteOffset + offset, end = rows == 0 ? begin : begin + (rows - 1) * stride + row_bytes;
  if (end > buffer.size() || end > view.byteOffset + view.byteLength)
    fail(what, ": reaches byte ", end, ", its buffer has ", buffer.size(), " and its view ends at ",
         view.byteOffset + view.byteLength);
  return {buffer.data() + begin, stride};
}

template <class T>
T load(const unsigned char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

double number(const unsigned char* at, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const double x = load<std::int8_t>(at);
      return normalized ? std::max(x / 127, -1.0) : x;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(at) / (normalized ? 255.0 : 1.0);
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const double x = load<std::int16_t>(at);
      return normalized ? std::max(x / 32767, -1.0) : x;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(at) / (normalized ? 65535.0 : 1.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<std::uint32_t>(at);
    default:
      return static_cast<double>(load<float>(at));
  }
}

std::size_t size_of(int type, const std::string& what) {
  const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
  check(size > 0 && size <= 4, what, ": found component type ", type, ", expected one of glTF 2.0");
  return static_cast<std::size_t>(size);
}

std::vector<double> read_numbers(const tinygltf::Model& model, int index, int components, const std::string& title) {
  const std::string what = message(title, " accessor ", index);
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size())
    fail(what, ": does not exist, the file has ", model.accessors.size());
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  const int found = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  if (found != components) fail(what, ": has ", found, " components, expected ", components);
  const std::size_t size = size_of(accessor.componentType, what), width = static_cast<std::size_t>(components);
  constexpr std::size_t limit = 1u << 28;  // a rig of 268 million vertices is a broken file
  if (accessor.count > limit) fail(what, ": has ", accessor.count, " rows, expected at most ", limit);

  std::vector<double> out(accessor.count * width, 0.0);
  if (accessor.bufferView >= 0) {
    const auto view = static_cast<std::size_t>(accessor.bufferView);
    const std::size_t stride = view < model.bufferViews.size() ? model.bufferViews[view].byteStride : 0;
    const Bytes rows =
        locate(model, accessor.bufferView, accessor.byteOffset, size * width, accessor.count, stride, what);
    for (std::size_t i = 0; i < accessor.count; ++i)
      for (std::size_t c = 0; c < width; ++c)
        out[i * width + c] =
            number(rows.data + i * rows.stride + c * size, accessor.componentType, accessor.normalized);
  }
  if (accessor.sparse.isSparse && accessor.sparse.count > 0) {
    const auto count = static_cast<std::size_t>(accessor.sparse.count);
    if (count > accessor.count) fail(what, ": sets ", count, " sparse rows of ", accessor.count);
    const std::size_t index_size = size_of(accessor.sparse.indices.componentType, what);
    const Bytes at = locate(model, accessor.sparse.indices.bufferView,
                            static_cast<std::size_t>(accessor.sparse.indices.byteOffset), index_size, count, 0, what);
    const Bytes rows =
        locate(model, accessor.sparse.values.bufferView, static_cast<std::size_t>(accessor.sparse.values.byteOffset),
               size * width, count, 0, what);
    for (std::size_t i = 0; i < count; ++i) {
      const double row = number(at.data + i * at.stride, accessor.sparse.indices.componentType, false);
      if (row >= static_cast<double>(accessor.count)) fail(what, ": sets sparse row ", row, " of ", accessor.count);
      for (std::size_t c = 0; c < width; ++c)
        out[static_cast<std::size_t>(row) * width + c] =
            number(rows.data + i * rows.stride + c * size, accessor.componentType, accessor.normalized);
    }
  }
  for (const double x : out)
    if (!std::isfinite(x)) fail(what, ": found ", x, ", expected finite numbers");
  return out;
}

}  // namespace

std::vector<float> read_floats(const tinygltf::Model& model, int accessor, int components, const std::string& title) {
  const std::vector<double> numbers = read_numbers(model, accessor, components, title);
  std::vector<float> out;
  out.reserve(numbers.size());
  for (const double x : numbers) out.push_back(static_cast<float>(x));
  return out;
}

std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor, const std::string& title) {
  const std::vector<double> numbers = read_numbers(model, accessor, 1, title);
  std::vector<std::uint32_t> out;
  out.reserve(numbers.size());
  for (const double x : numbers) {
    if (x < 0 || x != std::floor(x)) fail(title, " accessor ", accessor, ": found ", x, ", expected indices");
    out.push_back(static_cast<std::uint32_t>(x));
  }
  return out;
}

}  // namespace face::decode
