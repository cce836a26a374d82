// SPDX-License-Identifier: Apache-2.0
// What the lips of a posed rig do, in mm: how far they are apart and how near the lower one is to the upper teeth.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "nodes/types/rig.h"
#include "nodes/types/vec.h"

namespace face {

// The lip gap of a pose: over the pairs of Rig::inner_lips, the distance from upper to lower lip along the jaw axis
// (down, -y of the head), minus the same of the neutral, whose mouth is closed. 0 = closed, negative = the lips run
// into each other.
struct LipGap {
  double mean_mm = 0;
  double min_mm = 0;
  double max_mm = 0;
};

// posed_mm: V x 3. Throws where the rig has no pairs or the counts differ.
LipGap lip_gap(const Rig& rig, const std::vector<Vec3f>& posed_mm);

// The mean over the pairs alone: the lip gap that is reported and judged.
double lip_gap_mm(const Rig& rig, const std::vector<Vec3f>& posed_mm);

// The lip gap of a linear rig is linear in its weights and 0 at the neutral: gap of pair p = sum_s rows[p][s] *
// weight_s. P x shapes, mm.
std::vector<std::vector<double>> lip_gap_rows(const Rig& rig);

// A place where the lower lip is near the upper teeth.
struct LipTeethContact {
  double distance_mm = 0;    // to the surface of the teeth; negative inside them
  std::size_t lip = 0;       // index into Rig::lower_lip
  Vec3f normal = {0, 0, 1};  // unit, from the teeth outwards: along it the distance grows
};

// Measures lower lip to upper teeth for many poses of one rig. The surface of the teeth is the rig's polygons whose
// corners are all in Rig::upper_teeth; of these, the ones about the nearest vertex are searched. The teeth stay in the
// skull: they are taken at their neutral place.
class LipTeeth {
 public:
  explicit LipTeeth(const Rig& rig);

  // False where the rig names no lower lip or no upper teeth; nothing can be measured then.
  bool usable() const { return !lip_neutral_mm_.empty() && !teeth_mm_.empty(); }
  // One contact per lower lip vertex, in its order. weights: at most as many as the rig has shapes.
  std::vector<LipTeethContact> contacts(const std::vector<float>& weights) const;
  // The one with the smallest signed distance.
  LipTeethContact nearest(const std::vector<float>& weights) const;
  // How deep the lower lip is inside the teeth, >= 0: what nearest() finds where that is negative, but much faster.
  double depth_mm(const std::vector<float>& weights) const;
  // d distance / d weight_s of a contact, mm. shapes.
  std::vector<double> row(const LipTeethContact& contact) const;

 private:
  struct Offset {
    std::uint32_t lip;
    Vec3f offset_mm;
  };
  std::vector<Vec3f> posed_lip(const std::vector<float>& weights) const;
  LipTeethContact contact_of(std::size_t lip, const Vec3f& point_mm) const;

  std::vector<Vec3f> lip_neutral_mm_;
  std::vector<std::vector<Offset>> shape_offsets_;  // per shape, of the lip's vertices it moves
  std::vector<Vec3f> teeth_mm_;
  Vec3f teeth_low_mm_ = {0, 0, 0}, teeth_high_mm_ = {0, 0, 0};  // their bounding box
  std::vector<Vec3f> teeth_normals_;
  std::vector<bool> on_border_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::vector<std::uint32_t>> vertex_triangles_;
};

}  // namespace face
