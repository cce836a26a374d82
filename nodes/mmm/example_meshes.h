// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "engine/port.h"
#include "nodes/types/mesh.h"
#include "nodes/types/rig.h"

namespace face::mmm {

struct ExampleMeshesOptions {
  // 18 expressions, of which a frontal video tells one from the other (the paper uses 15 to 20 examples).
  std::vector<std::string> shapes = {
      "jawOpen",          "jawLeft",           "jawRight",          "mouthFunnel",        "mouthPucker",
      "mouthLeft",        "mouthRight",        "mouthSmileLeft",    "mouthSmileRight",    "mouthFrownLeft",
      "mouthFrownRight",  "mouthStretchLeft",  "mouthStretchRight", "mouthLowerDownLeft", "mouthLowerDownRight",
      "mouthUpperUpLeft", "mouthUpperUpRight", "mouthPressLeft"};
};

// Example poses for MeshIK from a rig: one mesh per named shape at weight 1, in the order of the names, and the rig at
// rest as their reference. Ids are the names. Throws where the rig has no shape of a name, or it moves nothing.
Mesh example_meshes(const Rig& rig, engine::SeqWriter<Mesh>& examples, const ExampleMeshesOptions& options = {});

}  // namespace face::mmm
