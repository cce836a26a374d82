// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "nodes/types/rig.h"

namespace face::decode {

// Shapes without which a rig cannot speak.
inline constexpr std::string_view needed_shapes[] = {"jawOpen",     "mouthClose",     "mouthFunnel",
                                                     "mouthPucker", "mouthRollLower", "mouthRollUpper"};

// A rig's name of a shape in ARKit's spelling: case, '_' and prefixes up to the last '.' ("head_blendShapes.") do not count,
// _L/_R/_Left/_Right at the end are Left/Right. A name that is none of ARKit's comes back with only its side spelled out.
// A side of an ARKit shape that has none (browInnerUp_L, cheekPuff_R) is that shape: its halves are added up.
std::string arkit_spelling(std::string_view name);

// Gathers shapes as a file gives them and sorts them into a rig's order: the ARKit-52, then the others as they came.
class ShapeCollector {
 public:
  // offsets_mm: one per vertex. Several of one name are added up.
  void add(std::string_view name, const std::vector<Vec3f>& offsets_mm);

  // Fills rig.shapes and rig.missing. Throws where a needed shape is absent; `title` names the file.
  void finish(const std::string& title, Rig& rig) const;

 private:
  std::vector<Shape> shapes_;
};

}  // namespace face::decode
