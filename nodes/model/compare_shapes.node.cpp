// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/model/from_scans.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.compare_shapes", &compare_shapes, version{1},
     doc{"How much of the span of scanned expressions lies in that of scanned identities, and of identities in other "
         "identities' as a control: largest angle and share of the variance that is left over."},
     input{"surface", "The reference surface"}, input{"expressions", "Shapes of one person's expressions, at rest"},
     input{"identities", "Shapes of neutral persons in the same topology, at rest"},
     output("table", "Rows expression and control"));
