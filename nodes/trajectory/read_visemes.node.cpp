// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/read_visemes.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::trajectory;
NODE("trajectory.read_visemes", &read_visemes, version{1},
     doc{"Reads the table that says what the face does for every phone: target weights, coarticulation widths, "
         "contacts."},
     input{"file", "JSON viseme table over ARKit names, such as graphs/speech/visemes.json"},
     output("visemes", "One viseme per phone, and closure and release of the stops"));
