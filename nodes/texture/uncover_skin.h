// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <vector>

#include "nodes/types/morphable_model.h"
#include "nodes/types/rig.h"

namespace face::texture {

// What a picture shows of a face's skin, at its vertices.
struct SeenSkin {
  std::vector<Vec3f> colour;  // V, linear reflectance; 0 where nothing is known
  std::vector<float> sure;    // V, 1 where the picture shows it, 0 where it is made up
};

// The skin without what hides it, and as alike on both sides as skin is. Above the brows, at temples and ears, at the
// sides of cheeks without a beard and below the chin hair and collars may lie over it: there, what differs from the
// mean person's skin in the tone of the cheeks by more than hair_contrast (a logarithm; 0 = nothing) is not skin. Nor
// is what only one side shows and differs by much: a strand, a microphone, a deep shadow. In its place comes what the
// other side shows, or, where that is hidden too, what goes on from the skin around. Slow differences between the sides
// are the light's and go (Blanz and Vetter's model has one parallel light, rooms have more). model: with 68 landmarks,
// or nothing is hidden. person: its neutral, of the model's vertices. Returns V x 3.
std::vector<Vec3f> uncover_skin(const MorphableModel& model, const Rig& person, const SeenSkin& seen,
                                double hair_contrast);

// How much more of each channel the cheeks reflect than `own` does there: for skin that no picture shows.
std::array<double, 3> tone_of(const std::vector<Vec3f>& colours, const std::vector<Vec3f>& own,
                              const std::vector<float>& cheeks);

}  // namespace face::texture
