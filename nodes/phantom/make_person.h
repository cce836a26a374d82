// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "nodes/types/matrix.h"
#include "nodes/types/rig.h"
#include "nodes/types/shape_set.h"
#include "nodes/types/surface_dots.h"

namespace face::phantom {

enum class Markers { none, white, black };

struct MakePersonOptions {
  std::int64_t seed = 1;
  double spread = 1;      // standard deviations of the identity coefficients; 0 = the rig's own identity
  double warp_mm = 0;     // root mean square of the smooth warp over the face's skin; 0 = off
  bool skin = true;       // skin tone, lips, brows, cheeks of this person
  double lightest = 1;    // skin is drawn from 0, the darkest tone, to this; 0.3 makes persons of dark skin
  double beard = 0.25;    // chance of a beard shadow
  bool moles = true;      // moles and freckles (as dots)
  bool painted = false;   // a painted look: flat skin, drawn lips, brows and cheeks
  bool lipstick = false;  // the red of the lips evenly coloured up to a clear outer edge
  Markers markers = Markers::none;
  double marker_radius_mm = 1.5;
};

struct MakePersonResult {
  Rig person;           // topology, shapes and marks of the rig
  Matrix coefficients;  // 1 x K, of the modes, in standard deviations: the truth of a linear fit
  Matrix warp_mm;       // V x 3: what the warp added to each vertex of the neutral; 0 x 0 where it is off
  SurfaceDots dots;     // moles and freckles, then markers: what sensors paint
  SurfaceDots markers;  // the markers alone, by name
};

// A person after a rig: identity modes with random coefficients, a smooth warp that no linear model contains, and a
// skin. Bit for bit the same for a seed; each of the options' parts is drawn by itself, so that none changes another.
// modes: null = none. id: the person's, where one node makes many (seq.ids): every id is another person; may be null.
// Beside modes and warp, shut lids are made to meet over the eyeball (shut_lids.h), and teeth go back behind lips that
// have come too near (set_back_teeth.h).
// Skin, dots, markers and lipstick are placed by the rig's 68 landmarks and throw without them.
MakePersonResult make_person(const Rig& rig, const ShapeSet* modes, const std::string* id,
                             const MakePersonOptions& options = {});

}  // namespace face::phantom
