// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/add_idle.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::trajectory;
NODE("trajectory.add_idle", &add_idle, version{1},
     doc{"Adds what a face does besides speaking: blinks, small eye movements and slow brows."},
     input{"weights", "52 or more weights per frame, ARKit order"}, input{"timeline", "Time of every frame"},
     param("seed", &AddIdleOptions::seed, range{0, 1000000}, unit{"1"}, "Another seed blinks at other times"),
     param("blink_least_s", &AddIdleOptions::blink_least_s, range{0.5, 60}, unit{"s"}, "Shortest time between blinks"),
     param("blink_most_s", &AddIdleOptions::blink_most_s, range{0.5, 60}, unit{"s"}, "Longest time between blinks"),
     param("blink", &AddIdleOptions::blink, range{0, 1}, unit{"1"}, "How far the lids close; 0 = no blinks"),
     param("brow", &AddIdleOptions::brow, range{0, 1}, unit{"1"}, "Largest slow lift of the brows"),
     param("gaze", &AddIdleOptions::gaze, range{0, 1}, unit{"1"}, "Largest weight of small eye movements"),
     output("idle_weights", "The weights with blinks, eyes and brows"));
