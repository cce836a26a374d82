// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/rig.h"
#include "nodes/types/vec.h"

namespace face::render {

// The eye expects to see the teeth, and adapts; a photograph does not.
inline constexpr float eyes_gain = 1.7f, photographs_gain = 1;

// The light inside the mouth: the parts named after mouth, gums, tongue or teeth.
struct MouthLight {
  std::vector<bool> inside;      // V
  std::vector<float> exposure;   // V, share of the light in front of the face that arrives: 1 outside the mouth
  Vec3f opening_mm = {0, 0, 0};  // middle of the opening between the lips
  Vec3f bounced = {0, 0, 0};     // linear, what the walls of the mouth pass on, per light in front of the face
};

// exposure is the form factor A / (A + pi d^2) of the opening between the lips, of area A, at distance d (Siegel and
// Howell, Thermal Radiation Heat Transfer, 1981, disk seen from its axis). So teeth just behind parted lips are bright
// and the throat is dark. bounced is the light of an integrating sphere with red walls: little, warm, and what keeps a
// mouth from being black (A over the walls' area x rho / (1 - rho); 215 cm2 of walls by Collins and Dawes, The Surface
// Area of the Adult Human Mouth, 1987). Lips have depth, so A is taken as less the lower the opening is. It is the
// polygon of landmarks 60-67 or spanned by the pairs of Rig::inner_lips, less the same in the neutral, whose mouth is
// closed; with neither it counts as 35 x 20 mm in front of the part.
// gain: of that form factor.
MouthLight mouth_light(const Rig& rig, const std::vector<Vec3f>& points_mm, float gain = eyes_gain);

}  // namespace face::render
