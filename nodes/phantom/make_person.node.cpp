// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/make_person.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.make_person", &make_person, version{1},
     doc{"A person after a rig: random identity modes, a smooth warp that no linear model contains, a skin, moles, "
         "markers and lipstick; with the truth beside it."},
     input{"rig", "Head with its shapes; skin, dots and markers need its 68 landmarks"},
     input{"modes", "Identity modes of this rig, at one standard deviation"},
     input{"id", "The person's id (seq.ids), where one node makes many: every id is another person"},
     param("seed", &MakePersonOptions::seed, range{0, 1000000}, unit{"1"}, "Another seed is another person"),
     param("spread", &MakePersonOptions::spread, range{0, 3}, unit{"1"},
           "Standard deviation of the modes' coefficients; 0 = the rig's own identity"),
     param("warp_mm", &MakePersonOptions::warp_mm, range{0, 6}, unit{"mm"},
           "Root mean square of the warp over the skin of the face; 0 = off"),
     param("skin", &MakePersonOptions::skin, "Skin tone, lips, cheeks, hair and eyes of this person"),
     param("lightest", &MakePersonOptions::lightest, range{0.0, 1.0}, unit{"1"},
           "Of skin tones from 0, the darkest, to 1; 0.3 makes persons of dark skin"),
     param("beard", &MakePersonOptions::beard, range{0, 1}, unit{"1"}, "Chance of a beard shadow"),
     param("moles", &MakePersonOptions::moles, "Moles and freckles, as dots"),
     param("painted", &MakePersonOptions::painted, "A painted look: few tones, light and strokes painted on"),
     param("lipstick", &MakePersonOptions::lipstick, "Lips evenly coloured up to a clear outer edge"),
     param("markers", &MakePersonOptions::markers,
           {{"none", Markers::none}, {"white", Markers::white}, {"black", Markers::black}},
           "Markers on the skin, as dots"),
     param("marker_radius_mm", &MakePersonOptions::marker_radius_mm, range{0.2, 6}, unit{"mm"}, "Of every marker"),
     output("person", &MakePersonResult::person, "The rig with this person's neutral, shapes and colours"),
     output("coefficients", &MakePersonResult::coefficients, "1 x K, in standard deviations of the modes"),
     output("warp_mm", &MakePersonResult::warp_mm, "V x 3: what the warp moved every vertex by; empty where it is off"),
     output("dots", &MakePersonResult::dots, "Moles and freckles, then markers"),
     output("markers", &MakePersonResult::markers, "The markers alone, by name"));
