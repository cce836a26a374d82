// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_points.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/npy.h"

namespace face::decode {
namespace {

static_assert(std::endian::native == std::endian::little, "point caches are little endian and read as they lie");

constexpr std::size_t pc2_header_bytes = 32;

std::vector<MeshPoints> read_npy(const engine::File& file, const std::string& title) {
  const Matrix matrix = npy(file);
  check(matrix.rows > 0 && matrix.columns > 0 && matrix.columns % 3 == 0, title, ": found ", matrix.rows, " rows of ",
        matrix.columns, " numbers, expected frames x vertices x 3");
  std::vector<MeshPoints> frames(matrix.rows);
  for (std::size_t f = 0; f < matrix.rows; ++f)
    for (std::size_t v = 0; v < matrix.columns; v += 3)
      frames[f].points_mm.push_back({static_cast<float>(matrix.at(f, v)), static_cast<float>(matrix.at(f, v + 1)),
                                     static_cast<float>(matrix.at(f, v + 2))});
  return frames;
}

std::vector<MeshPoints> read_pc2(const std::string& bytes, const std::string& title) {
  check(bytes.size() >= pc2_header_bytes && std::memcmp(bytes.data(), "POINTCACHE2\0", 12) == 0, title,
        ": does not begin with POINTCACHE2, expected a point cache (.pc2)");
  std::int32_t version = 0, vertices = 0, count = 0;
  std::memcpy(&version, &bytes[12], 4);
  std::memcpy(&vertices, &bytes[16], 4);
  std::memcpy(&count, &bytes[28], 4);
  check(version == 1, title, ": found version ", version, ", expected 1");
  check(vertices > 0 && count > 0, title, ": found ", count, " frames of ", vertices, " vertices, expected some");
  const auto v = static_cast<std::size_t>(vertices), f = static_cast<std::size_t>(count);
  check(bytes.size() - pc2_header_bytes == f * v * 12, title, ": has ", bytes.size(), " bytes, expected ",
        pc2_header_bytes + f * v * 12, " for ", count, " frames of ", vertices, " vertices");
  std::vector<MeshPoints> frames(f);
  for (std::size_t i = 0; i < f; ++i) {
    frames[i].points_mm.resize(v);
    std::memcpy(frames[i].points_mm.data(), &bytes[pc2_header_bytes + i * v * 12], v * 12);
  }
  return frames;
}

}  // namespace

engine::Seq<MeshPoints> read_points(const engine::File& file, const ReadPointsOptions& options) {
  const std::string title = title_of(file), suffix = lower_suffix(file);
  check(suffix == ".npy" || suffix == ".pc2", title, ": found the suffix \"", file.suffix(),
        "\", expected .npy or .pc2; meshes of one frame each (PLY, OBJ) are read by decode.mesh");
  std::vector<MeshPoints> frames = suffix == ".npy" ? read_npy(file, title) : read_pc2(read_bytes(file), title);
  for (std::size_t f = 0; f < frames.size(); ++f)
    for (std::size_t v = 0; v < frames[f].points_mm.size(); ++v)
      for (const float x : frames[f].points_mm[v])
        check(std::isfinite(x), title, ": vertex ", v, " of frame ", f, " is not finite");
  const float scale = mm_per_unit(options.unit, frames[0].points_mm);
  for (MeshPoints& frame : frames)
    for (Vec3f& point : frame.points_mm)
      for (float& x : point) x *= scale;
  return engine::Seq<MeshPoints>(std::move(frames));
}

}  // namespace face::decode
