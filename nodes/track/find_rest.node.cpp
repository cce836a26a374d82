// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/find_rest.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::track;

NODE("track.find_rest", &find_rest, version{3}, doc{"The points of a face whose mouth is shut, found in a clip."},
     input{"landmarks", "The points of every frame of a head that stands still, from track.stabilise"},
     param("from_share", &FindRestOptions::from_share, range{0.0, 1.0}, unit{"1"},
           "Share of the frames, by the height of the lips: thinner lips are pressed together"),
     param("to_share", &FindRestOptions::to_share, range{0.0, 1.0}, unit{"1"}, "The same: thicker ones are open"),
     param("still_share", &FindRestOptions::still_share, range{0.0, 1.0}, unit{"1"},
           "Share of all frames: so many of these count, those in which the mouth moves least"),
     output("rest", "The points"));
