// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/evaluate/lip_gap.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/phones.h"
#include "nodes/types/rig.h"
#include "nodes/types/timeline.h"

namespace face::evaluate {

// lip_gap for animations that are given as vertices. closed: the vertices of the mouth that is truly closed, from which
// the gap counts: an animation whose own neutral is not quite closed cannot hide it. points, truth: as many frames, V x
// 3 each, V as the rig's; truth may be null. rig: its inner lip pairs count.
LipGapResult mesh_lip_gap(const Rig& rig, const engine::Seq<MeshPoints>& points, const engine::Seq<MeshPoints>* truth,
                          const MeshPoints& closed, const Phones& phones, const Timeline& timeline,
                          const LipGapOptions& options = {});

}  // namespace face::evaluate
