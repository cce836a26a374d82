// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/phantom/face_places.h"
#include "nodes/types/rig.h"

namespace face::phantom {

struct PersonSkinOptions {
  std::int64_t seed = 1;
  double beard = 0.25;  // chance of a beard shadow
  double lightest = 1;  // of the tone's lightness
};

// Gives the person a skin tone with uneven places, lips, cheeks, hair, brows and eyes of its own, by multiplying the
// colours of the rig's vertices. places: of the rig (before its neutral became a person's).
void color_person(const Mesh& rig_neutral, const FacePlaces& places, const PersonSkinOptions& options, Mesh& person);

// Colours the red of the lips evenly, with a clear outer edge.
void put_lipstick(const Mesh& rig_neutral, const FacePlaces& places, std::int64_t seed, Mesh& person);

// Repaints the person as if with a brush: few tones from a warm palette, light and shade painted on, strokes, no gloss.
void paint_person(std::int64_t seed, Mesh& person);

// The tone of a person's skin, sRGB, and how light it is from 0 (darkest) to 1, or `lightest`.
struct SkinTone {
  Vector3 color_srgb;
  double lightness = 1;
};
SkinTone skin_tone(std::int64_t seed, double lightest = 1);

}  // namespace face::phantom
