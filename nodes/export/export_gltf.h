// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/rig.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::exports {

struct ExportGltfOptions {
  bool morph_normals = true;  // shapes move the normals too: twice the size, right shading in viewers
};

// Writes a rig and its animation as a binary glTF 2.0 file (.glb): one mesh with a morph target per shape, in the rig's
// order (a shape that moves nothing is there too, so that indices are those of arkit.h), named in extras.targetNames,
// and one animation that sets all weights at every frame. Metres, y up. Parts that are not visible are left out.
//
// A viewer of glTF has one texture coordinate per vertex, so vertices on seams are copied behind the V of the rig; all
// parts share one set of vertices. mesh.extras.facegraph brings a rig back:
//   {"version": 1, "vertex_count": V, "copies": [vertex that each further one copies],
//    "parts": [{"name", "gloss"}], one per primitive,
//    "inner_lips": [[upper, lower]], "lower_lip": [...], "upper_teeth": [...], "landmarks68": [...], "missing": [...]}
//
// frames: one list of weights per element of the timeline, none longer than the rig's shapes; a shorter one leaves the
// rest 0. Memory: the file itself; frames are read one by one.
//
// original: the file that the rig was read from, names: what its shapes' names were mapped by; null = none. A glTF
// file comes back as it is, with textures, bones and all, and the animation (animate_original.h); options do not count
// then.
engine::File export_gltf(const Rig& rig, const engine::Seq<Weights>& frames, const Timeline& timeline,
                         const engine::File* original = nullptr, const engine::File* names = nullptr,
                         const ExportGltfOptions& options = {});

}  // namespace face::exports
