// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/lip_thickness.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::track;

NODE("track.lip_thickness", &lip_thickness, version{1},
     doc{"The shut mouth, with lips that are no thicker than those of open mouths."},
     input{"landmarks", "The points of every frame of a head that stands still, with where the lips part"},
     input{"rest", "The points of the shut mouth, from track.find_rest"},
     param("open_share", &LipThicknessOptions::open_share, range{0.01, 1}, unit{"1"},
           "Of a line across the mouth: one that is open by more tells how thick the lips are"),
     param("thin_share", &LipThicknessOptions::thin_share, range{0, 1}, unit{"1"},
           "Quantile of the thickness that counts"),
     param("least_share", &LipThicknessOptions::least_share, range{0.1, 1}, unit{"1"},
           "Of the thickness at rest: no lip is taken for thinner"),
     output("thickness", "The points of the shut mouth"));
