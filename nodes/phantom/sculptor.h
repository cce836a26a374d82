// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>
#include <vector>

#include "nodes/phantom/attached.h"
#include "nodes/phantom/eyes.h"
#include "nodes/phantom/head_builder.h"
#include "nodes/phantom/mouth_interior.h"
#include "nodes/phantom/skin_layout.h"
#include "nodes/types/rig.h"

namespace face::phantom {

// A finished neutral head with what the sculpting of its shapes needs to know.
struct Head {
  HeadBuilder mesh;
  Skin skin;
  Eyes eyes;
  MouthInterior mouth;
  Attached lashes, brows;
  VertexRange ears, hair;  // no hair: an empty range
};

// One offset per vertex of the head, mm.
using Offsets = std::vector<Vector3>;

// Measures on the neutral head that all shapes share. Every field has one value per vertex of the skin.
struct Fields {
  std::vector<double> jaw;     // 1 where the skin rides on the jaw, 0 where it stays; smooth, and split by the lips
  std::vector<double> lower;   // 1 on the lower lip and below, 0 on the upper lip and above; about 1/2 beside the mouth
  std::vector<double> lip_mm;  // distance to the border of the lips' red, 0 on and inside it
  std::vector<double> lining;  // 1 on skin and lips, falling to 0 along the mouth's lining
  std::vector<double> across;  // 1 at the left corner of the mouth, -1 at the right one; beyond 1 on the cheeks
};
Fields measure_fields(const Head& head);

// Smooth values on the skin: those with a fixed value keep it, every other becomes the mean of its neighbours.
// fixed: one per skin vertex, NaN where free. start: as many, what the free ones begin with (0 when empty).
std::vector<double> diffuse(const Head& head, const std::vector<double>& fixed, const std::vector<double>& start,
                            int passes);

// Makes the sparse shape: brows and lashes follow their anchors, offsets too small to see are dropped.
Shape to_shape(const Head& head, std::string_view name, Offsets offsets);
// The same on the other side, and both sides made exact mirror images.
Offsets mirror_image(const Head& head, const Offsets& offsets);
void symmetrise(const Head& head, Offsets& offsets);

// Offsets of the ARKit shapes; those of one side are given for the left.
Offsets eye_shape(const Head& head, std::string_view name);
Offsets brow_shape(const Head& head, std::string_view name);
Offsets jaw_shape(const Head& head, const Fields& fields, std::string_view name);
Offsets mouth_shape(const Head& head, const Fields& fields, std::string_view name);
Offsets cheek_shape(const Head& head, const Fields& fields, std::string_view name);

}  // namespace face::phantom
