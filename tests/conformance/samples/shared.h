// SPDX-License-Identifier: Apache-2.0
// Samples that several areas use: faces' points as a tracker, a picture of 64 x 48 pixels or a person has them.
#pragma once
#include "tests/conformance/samples/area_samples.h"

namespace conformance {

// The 68 points by number ("0"), where the sample's camera sees them on the sample's head; variants see another head
// from another place.
Sample face_points(engine::Plugins&, int variant);
// The same with the names of a track: two digits ("00").
Sample two_digit_points(engine::Plugins&, int variant);
// The 18 points of a lip tracker but the jaw's; other variants have the mouth farther open and the head elsewhere.
Sample speaker_points(engine::Plugins&, int variant);
// Four of these, as key shapes; variant 3 lacks the last point.
Sample speaker_keys(engine::Plugins&, int variant);
// One channel of the sample picture.
Sample grey_picture(engine::Plugins&, int variant);
// A mask: white in a disc about the middle, larger and farther to the right in every variant.
Sample disc(engine::Plugins&, int variant);
// Of a picture: one of another size in every variant.
Sample sized_picture(engine::Plugins&, int variant);
// Weights of as many example meshes as a sequence of samples has.
Sample few_weights(engine::Plugins&, int variant);

// A mouth that opens from one variant to the next, and shuts after the fourth.
Sample opening_mouth(engine::Plugins&, int variant);
// Four frames over all that is said.
Sample spread_timeline(engine::Plugins&, int variant);

// A maker's landmarks, moved by up to so many pixels, each by another way.
Maker scattered(Maker maker, double most_px);
// A maker's landmarks, of which the variants lose 1, 2, 3, 0, 1, ... points.
Maker losing_points(Maker maker);

}  // namespace conformance
