// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/perform.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE(
    "phantom.perform", &perform, version{2},
    doc{"Acts out speech with known truth: weights of every frame and the head's motion, by dominance functions (Cohen "
        "and Massaro 1993) over a phone table of its own, with lips exactly shut in every P B M."},
    input{"phones", "What is said when"}, input{"timeline", "When the frames are; without it they come at rate_hz"},
    input{"rig", "The head whose lips must meet; without it mouthClose equals jawOpen in shut lips"},
    input{"take", "Its name, for blinks, glances and sway of its own; without it all takes of a seed have the same"},
    param("rate_hz", &PerformOptions::rate_hz, range{25, 120}, unit{"Hz"}, "Frames per second without a timeline"),
    param("seed", &PerformOptions::seed, range{0, 1000000}, unit{"1"}, "Another seed is another speaker"),
    param("strength", &PerformOptions::strength, range{0, 1.5}, unit{"1"}, "Of articulation; below 1 mumbles"),
    param("style", &PerformOptions::style, range{0, 2}, unit{"1"},
          "How far this speaker departs from the average one; 0 = the average"),
    param("blink", &PerformOptions::blink, range{0, 1}, unit{"1"}, "How far the lids close; 0 = no blinks"),
    param("brows", &PerformOptions::brows, range{0, 2}, unit{"1"}, "Of brow movements; 0 = none"),
    param("gaze", &PerformOptions::gaze, range{0, 2}, unit{"1"}, "Of eye movements; 0 = none"),
    param("head_motion", &PerformOptions::head_motion, range{0, 3}, unit{"1"}, "Of head movements; 0 = none"),
    param("turn_deg", &PerformOptions::turn_deg, range{0, 120}, unit{"deg"},
          "The head also turns this far to both sides, its left first; 0 = off"),
    param("turn_s", &PerformOptions::turn_s, range{0.5, 60}, unit{"s"}, "How long such a turn to both sides takes"),
    output("weights", "52 weights per frame, ARKit order"),
    output("world_from_head", "Where the head is in every frame"),
    output("timeline", &PerformResult::timeline, "Time of every frame"),
    output("closure_count", &PerformResult::closure_count, "P, B and M"),
    output("labiodental_count", &PerformResult::labiodental_count, "F and V"),
    output("labiodental_distance_mm", &PerformResult::labiodental_distance_mm,
           "Lower lip to upper teeth in F and V; negative inside them"));
