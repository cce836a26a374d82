// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/port.h"
#include "nodes/types/rig.h"

namespace face::decode {

// Shapes without which a rig cannot speak.
inline constexpr std::string_view needed_shapes[] = {"jawOpen",     "mouthClose",     "mouthFunnel",
                                                     "mouthPucker", "mouthRollLower", "mouthRollUpper"};

// A rig's name of a shape in ARKit's spelling: case, '_', '-' and prefixes up to a '.', ':', '|' or '/'
// ("head_blendShapes.", "Face:") do not count, _L/_R/_Left/_Right at the end (or .L, -L, as Blender has them) are
// Left/Right. Blender's copies ("jawOpen.001") are none of ARKit's. A name that is none of ARKit's comes back with only
// its side spelled out. A side of an ARKit shape that has none (browInnerUp_L, cheekPuff_R) is that shape: its halves
// are added up.
std::string arkit_spelling(std::string_view name);

// Names of a file's shapes and what ARKit calls them.
struct ShapeNames {
  std::string title;                            // of the file that says so
  std::map<std::string, std::string> to_arkit;  // by the file's name

  // The name that a rig has for a file's shape.
  std::string in_rig(std::string_view name) const;
};

// Reads {"the file's name": "ARKit's name", ...}; "" says nothing. Throws where a value is not ARKit's.
ShapeNames read_shape_names(const engine::File& file);

// Gathers shapes as a file gives them and sorts them into a rig's order: the ARKit-52, then the others as they came.
class ShapeCollector {
 public:
  ShapeCollector() = default;
  explicit ShapeCollector(ShapeNames names) : names_(std::move(names)) {}

  // offsets_mm: one per vertex. Several of one name are added up.
  void add(std::string_view name, const std::vector<Vec3f>& offsets_mm);

  // Fills rig.shapes and rig.missing. Throws where a name to be mapped was not seen; `title` names the file.
  void finish(const std::string& title, Rig& rig) const;

 private:
  ShapeNames names_;
  std::set<std::string> seen_;
  std::vector<Shape> shapes_;
};

// Throws where a rig has not the shapes that speech needs; `title` names its file.
void expect_speech(const std::string& title, const Rig& rig);

}  // namespace face::decode
