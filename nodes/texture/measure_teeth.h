// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/albedo_map.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/image.h"
#include "nodes/types/matrix.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/rig.h"

namespace face::texture {

// How much brighter a picture's teeth are than they are drawn into it, each channel's sRGB value: 1 x 3; ones where the
// picture shows none. Teeth are drawn a little brighter than the skin about the mouth, but skins differ more than teeth
// do: a dark face's are drawn far too dark, and how white somebody's teeth are nothing else tells. What is seen in and
// about the drawn opening and is pale and bright beside the skin is teeth; the brightest of it is compared with the
// brightest that is drawn, since a fit is never exact and teeth are dark where they stand back.
Matrix measure_teeth(const MorphableModel& model, const Rig& person, const AlbedoMap& albedo, const FaceFit& fit,
                     const Image& picture);

// What draw_face takes; null gives ones.
Vec3f gain_of(const Matrix* teeth);

}  // namespace face::texture
