// SPDX-License-Identifier: Apache-2.0
// Which lip a vertex belongs to. On a closed mouth the lips touch, so that places alone do not tell; ways along the
// skin do.
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/types/mesh.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/rig.h"

namespace face::transfer {

// The opening between the lips of a scanned mesh: its vertices along the edges. Empty where the mesh has none.
struct MouthOpening {
  std::vector<std::uint32_t> upper, lower;  // ascending
  std::uint32_t right_corner = 0;           // the face's own right: least x
  std::uint32_t left_corner = 0;

  bool found() const { return !upper.empty() && !lower.empty(); }
};

// Of the holes in the mesh (pieces of its border that the surface lies around, seen from the front) the widest in x is
// the mouth, if it is at least least_width_mm wide and no farther from the middle than a quarter of the mesh's width.
// The upper lip's vertices are those along its edge from corner to corner above the opening, the lower lip's those
// below; a vertex in which lips touch is both's.
MouthOpening find_mouth_opening(const Mesh& mesh, double least_width_mm = 15);

enum class LipSide : std::int8_t { lower = -1, none = 0, upper = 1 };

// The side of every vertex: of the two sets of seeds the one that is nearer along the mesh by more than margin_mm (so
// that cheeks beside the corners have none), none where it is farther than reach_mm. points_mm: where the vertices are,
// for lengths. polygons: which ones count; empty = all.
std::vector<LipSide> sides_of(const Mesh& mesh, const std::vector<Vec3f>& points_mm,
                              const std::vector<std::uint32_t>& upper, const std::vector<std::uint32_t>& lower,
                              float reach_mm, float margin_mm, const std::vector<std::uint8_t>& polygons = {});

// 1 for every polygon of the skin: the parts that hold the 68 landmarks, "head", "neck" and "ears"; all where there are
// no landmarks or parts.
std::vector<std::uint8_t> skin_polygons(const Mesh& mesh, const std::vector<std::uint32_t>& landmarks68);

// sides_of a head: from its inner lip pairs and the inner lip landmarks, along its skin, by more than 5 mm.
std::vector<LipSide> head_sides(const Mesh& mesh, const std::vector<LipPair>& inner_lips,
                                const std::vector<std::uint32_t>& landmarks68, float reach_mm);

}  // namespace face::transfer
