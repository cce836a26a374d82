// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/reveal_background.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::texture;

NODE("texture.reveal_background", &reveal_background, version{1},
     doc{"What a moving face hides in a frame: copied from frames around where it is seen, else reflected."},
     input{"frame", "The video's frames", window{10, 10}}, input{"mask", "Where the face is in each", window{10, 10}},
     input{"fit", "The fit of the frame"},
     param("stripe_mm", &ContinueBackgroundOptions::stripe_mm, range{0, 100}, unit{"mm"},
           "Width of the reflected stripe, on the face"),
     param("margin_mm", &ContinueBackgroundOptions::margin_mm, range{0, 50}, unit{"mm"},
           "By which masks are widened first"),
     output("background", "The frame with what is behind the rim of the face"));
