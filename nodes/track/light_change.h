// SPDX-License-Identifier: Apache-2.0
// What light and camera do to the colours of a face. Internal to the area.
#pragma once
#include <array>

#include "nodes/track/solid_head.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"

namespace face::track {

// A level of the start's picture = gain * level of this one + offset, for red, green and blue.
struct LightChange {
  std::array<double, 3> gain{1, 1, 1}, offset{0, 0, 0};
  bool is_same() const { return gain == std::array{1.0, 1.0, 1.0} && offset == std::array{0.0, 0.0, 0.0}; }
};

// The colours of what moves with the skull alone between brows and nose (head_raster.h), as many channels as the image.
// Empty where the points do not say where that is.
Image learn_light(const Image& image, const Landmarks& start);

// How the light has changed: the gain and the offset of each colour that take the head's colours to those of the start,
// in the root mean square (a ratio of deviations: noise in either picture does not make the gain smaller); what is
// clipped in either, and then what is farthest off, does not count. A head that turns is lit otherwise without the
// light's having changed: a small change is none. Against the start in every frame, so that nothing drifts.
LightChange see_light_change(const Image& image, const Landmarks& start, const SolidHead& head, const Image& learnt);

// The picture in the light of the start.
Image relit(const Image& image, const LightChange& light);
// The same without a copy where the light is the same: the picture itself, else what is made in `room`.
const Image& in_start_light(const Image& picture, const LightChange& light, Image& room);

// As a value of a graph, 3 x 2: gain and offset of each colour; and back, where 0 x 0 is the same light. Throws where
// it is something else.
Matrix light_numbers(const LightChange& light);
LightChange light_of(const Matrix& numbers);

}  // namespace face::track
