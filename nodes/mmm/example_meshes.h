// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "engine/port.h"
#include "nodes/types/mesh.h"
#include "nodes/types/rig.h"

namespace face::mmm {

struct ExampleMeshesOptions {
  // 16 expressions, of which a frontal video tells one from the other (the paper uses 15 to 20 examples). Without
  // mouthClose nothing shuts lips over a jaw that hangs.
  std::vector<std::string> shapes = {"jawOpen",          "mouthClose",        "jawLeft",          "jawRight",
                                     "mouthFunnel",      "mouthPucker",       "mouthSmileLeft",   "mouthSmileRight",
                                     "mouthFrownLeft",   "mouthFrownRight",   "mouthStretchLeft", "mouthStretchRight",
                                     "mouthUpperUpLeft", "mouthUpperUpRight", "mouthRollLower",   "mouthRollUpper"};
};

// Example poses for MeshIK from a rig: one mesh per named shape at weight 1, in the order of the names, and the rig at
// rest as their reference. Ids are the names. An ARKit shape that the rig lacks, or that moves nothing, is left out.
// Throws where the rig has no shape of another name, and where nothing is left.
Mesh example_meshes(const Rig& rig, engine::SeqWriter<Mesh>& examples, const ExampleMeshesOptions& options = {});

}  // namespace face::mmm
