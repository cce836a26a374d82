// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/align/find_markers.h"
using namespace engine::declare;
using namespace face::align;

NODE("align.first_layout", &first_layout, version{1},
     doc{"The marker constellation whose names all takes get: the first of those with the most markers."},
     input{"layouts", "Markers of every take"}, output("layout", "The one taken"));
