// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/continue_background.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::texture;

NODE("texture.continue_background", &continue_background, version{1},
     doc{"Reflects what is beside a face's contour to its inside: what a moving jaw may reveal."},
     input{"picture", "The picture"}, input{"mask", "Where the face is, as texture.face_mask makes it"},
     input{"fit", "The fit"},
     param("stripe_mm", &ContinueBackgroundOptions::stripe_mm, range{0, 100}, unit{"mm"},
           "Width of the reflected stripe, on the face"),
     param("margin_mm", &ContinueBackgroundOptions::margin_mm, range{0, 50}, unit{"mm"},
           "By which the mask is widened first"),
     output("background", "The picture with the stripe inside the contour replaced"));
