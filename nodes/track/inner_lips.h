// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"

namespace face::track {

struct InnerLipsOptions {
  double unlike = 2.5;  // deviations from the colours of the lips from which on it is no lip
  // With a mouth at rest: how much the thickness of a lip varies, as a share of what is expected, and what a picture
  // says against it: of a line that is unlike the lips by one deviation more than `unlike` all along.
  double thickness_deviation = 0.2;
  double thickening = 0.7;  // the power of the mouth's narrowing that lips grow by: 1 = their area in front stays
  double evidence = 20;
};

// Where the lips part: the outer edge of a mouth says little of whether it is open. Of each of three lines across the
// mouth, from a point of the outer upper lip to the one below it (lip_2 to lip_10, lip_3 to lip_9, lip_4 to lip_8), the
// stretch that is least like the lips on either side of it in colour and brightness, which are those of the line's two
// ends (the maximum-sum interval of what exceeds `unlike`; Bentley, Programming Pearls, CACM 1984): teeth, tongue in
// the shade or the hollow of the mouth. Where there is none, the darkest place. The seam of shut lips is dark and as
// wide as the picture is blurred: compare with what is found on the shut mouth. How much is unlike goes by the contrast
// of the picture: the same mouth is as far open in a flat film as in a hard one. What is as red as
// the lips is lip, however dark or glossy (lip_redness.h). The result has the
// points of `landmarks` and after them inner_lip_1 to inner_lip_3 (upper) and inner_lip_7, _6, _5 below them; not valid
// where an outer point of their line is not. Throws where one of the six outer points is missing, or an inner one is
// there. rest: these points of the shut mouth, of a head at any scale (find_rest.h); null where nobody knows. With it
// the gap is the most likely one: the tongue, gums and teeth in the shade are no less like a lip than a lip is, but
// lips are about as thick as at rest, thicker in a mouth that is narrower (a W or a pout, whose lips would else count
// as open), each by itself (a normal distribution), and what the picture shows is weighed against that.
// A head that turns or nods shows a mouth narrower, and lips thinner or thicker, than its first frame does. depths_px
// (N x 1: how far rest's points are towards the viewer) and head (its pose since rest, as stabilise.h takes them) say
// how the mouth at rest would be seen in this frame; without either, or where the head is not seen, the distances
// between the eyes and the tip of the nose tell its scale alone.
// colours, contrast: what the picture shows (lip_colours.h).
Landmarks inner_lips(const Matrix& colours, const Matrix& contrast, const Landmarks& landmarks,
                     const Landmarks* rest = nullptr, const Matrix* depths_px = nullptr, const Matrix* head = nullptr,
                     const InnerLipsOptions& options = {});

}  // namespace face::track
