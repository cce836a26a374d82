// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/rig.h"
#include "nodes/types/weights.h"

namespace face::model {

// The scanned person as a rig: its neutral is the neutral scan, its own shapes are the scanned expressions under their
// ids (after 52 ARKit shapes that are empty and named in `missing`), teeth and inner mouth going along as in
// head_points. This is the paper's database of mouth shapes, visemes among them, as key frames want it. poses: per
// expression the weights that show it, under its id. expressions, neutral: the surface's skin, at rest.
Rig scanned_rig(const MorphableModel& surface, const engine::Seq<MeshPoints>& expressions, const MeshPoints& neutral,
                engine::SeqWriter<Weights>& poses);

}  // namespace face::model
