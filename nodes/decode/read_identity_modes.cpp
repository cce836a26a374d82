// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_identity_modes.h"

#include <cmath>
#include <string>
#include <string_view>

#include "nodes/base/check.h"
#include "nodes/decode/ict_rig.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/obj.h"

namespace face::decode {
namespace {

constexpr float kUnmoved_mm = 1e-4f;

std::string_view leaf_of(std::string_view name) { return name.substr(name.find_last_of('/') + 1); }

Shape to_shape(std::string_view name, const Obj& mode, const Obj& neutral, float scale) {
  Shape shape;
  shape.name = std::string(name);
  for (std::size_t v = 0; v < neutral.points.size(); ++v) {
    Vec3f offset;
    for (std::size_t k = 0; k < 3; ++k) offset[k] = (mode.points[v][k] - neutral.points[v][k]) * scale;
    if (std::hypot(offset[0], offset[1], offset[2]) < kUnmoved_mm) continue;
    shape.vertices.push_back(static_cast<std::uint32_t>(v));
    shape.offsets_mm.push_back(offset);
  }
  return shape;
}

}  // namespace

ShapeSet read_identity_modes(const engine::File& folder, const ReadIdentityModesOptions& options) {
  check(folder.is_folder(), title_of(folder), ": is a file, expected an ICT-FaceKit folder");
  const engine::File::Entry& entry = obj_rig_neutral(folder);
  const Obj neutral = read_obj(read_bytes_at(entry.path, entry.name), entry.name);
  const float scale = mm_per_unit(options.unit, neutral.points);
  const std::string_view in = std::string_view(entry.name).substr(0, entry.name.size() - leaf_of(entry.name).size());
  ShapeSet modes;
  for (const engine::File::Entry& file : folder.entries()) {  // sorted by name
    const std::string_view leaf = leaf_of(file.name);
    if (!leaf.starts_with("identity") || !leaf.ends_with(".obj") || file.name.size() != in.size() + leaf.size() ||
        !file.name.starts_with(in))
      continue;
    const Obj mode = read_obj(read_bytes_at(file.path, file.name), file.name);
    check(mode.points.size() == neutral.points.size(), file.name, ": has ", mode.points.size(),
          " vertices, the neutral mesh ", entry.name, " has ", neutral.points.size());
    modes.shapes.push_back(to_shape(leaf.substr(0, leaf.size() - 4), mode, neutral, scale));
  }
  check(!modes.shapes.empty(), title_of(folder), ": holds no identityNNN.obj beside ", entry.name);
  return modes;
}

}  // namespace face::decode
