// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "engine/port.h"
#include "nodes/decode/rig_shapes.h"
#include "nodes/types/rig.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::exports {

// The glTF file that a rig was read from, with an animation of its morph targets in front of those it has: textures,
// materials, bones, nodes and whatever else it holds stay as they are. Buffers and pictures in files beside it (a
// folder was given) are taken in. Targets find their weights by the names under which decode.rig knows them; others
// stay 0. Animations of the same weights go. None for what is not a binary glTF file with one buffer of its own (a
// .gltf with files beside it, a folder), or has no morph targets. names: as decode.rig was given them. frames,
// timeline: as of export_gltf. Throws, naming the file, where it is damaged.
std::optional<engine::File> animate_original(const engine::File& original, const decode::ShapeNames& names,
                                             const Rig& rig, const engine::Seq<Weights>& frames,
                                             const Timeline& timeline);

}  // namespace face::exports
