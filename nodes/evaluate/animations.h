// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "engine/port.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/rig.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::evaluate {

// Throws where there are no frames or the counts differ. name, other: what messages call them.
void check_frame_counts(std::size_t count, std::size_t other_count, const char* name, const char* other);
// Throws unless the timeline has a finite time per frame, in ascending order.
void check_times(std::size_t frame_count, const Timeline& timeline, const char* name);

// The vertices of one frame. Throws where a weight is no number: a metric of nothing would be a lie.
std::vector<Vec3f> posed(const Rig& rig, const Weights& weights, const char* name, const std::string& frame);
void check_points(const MeshPoints& points, std::size_t vertex_count, const char* name, const std::string& frame);

// Walks two animations of one rig frame by frame: visit(frame, points, truth), V x 3 each.
using VisitPair =
    std::function<void(std::size_t frame, const std::vector<Vec3f>& points, const std::vector<Vec3f>& truth)>;
void for_each_pose(const Rig& rig, const engine::Seq<Weights>& weights, const engine::Seq<Weights>& truth,
                   const VisitPair& visit);

double squared_distance(const Vec3f& a, const Vec3f& b);

}  // namespace face::evaluate
