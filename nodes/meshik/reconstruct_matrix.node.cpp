// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/reconstruct_matrix.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::meshik;

NODE("meshik.reconstruct_matrix", &reconstruct_matrix, version{1},
     doc{"MeshIK on plain matrices: blends example poses into the vertices of every frame."},
     input{"reference", "Vertices at rest, V x 3"}, input{"examples", "Vertices of the examples, K x 3 V"},
     input{"faces", "Vertices of every face, F x 3 or F x 4"}, input{"weights", "T x K, or K x 1 for one frame"},
     output("vertices", "T x 3 V"));
