// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/scale_motion.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.scale_motion", &scale_motion, version{3},
     doc{"Where a mesh's vertices have to be when points of a face in a video have moved: the motion, scaled by the "
         "boxes of eyes, mouth and face."},
     input{"rig", "The head"}, input{"reference", "The points on a frame that looks like the head at rest"},
     input{"landmarks", "The points on another frame"},
     input{"still", "Vertices that are held at rest, from meshik.still_vertices"},
     param("hold_head", &ScaleMotionOptions::hold_head, "Takes the motion of the skull out first"),
     output("targets", "x and y of the vertices, for meshik.solve"));
