// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/paste.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.paste", &paste, version{1},
     doc{"Puts mouths into a head that was held still, with a feathered edge; the head's eyes and brows go on moving."},
     input{"heads", "A normalised video, shown forth and back"}, input{"mouths", "A picture for every frame"},
     input{"landmarks", "Points on the first head, whose lower face the mouths are; in place of their column and row"},
     param("left_px", &PasteOptions::left_px, range{0, 16384}, unit{"px"}, "Where the mouth's first column goes",
           inert{"landmarks take its place"}),
     param("top_px", &PasteOptions::top_px, range{0, 16384}, unit{"px"}, "Where the mouth's first row goes",
           inert{"landmarks take its place"}),
     param("feather_px", &PasteOptions::feather_px, range{0.0, 1000.0}, unit{"px"}, "Width of the edge"),
     param("head_frames", &PasteOptions::head_frames, range{1, 10000}, unit{"1"}, "Heads that are shown at most",
           inert{"a short video has fewer"}),
     output("frames", "The head with every mouth"));
