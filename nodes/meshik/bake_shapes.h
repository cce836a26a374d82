// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/rig.h"
#include "nodes/types/weights.h"

namespace face::meshik {

struct BakeShapesOptions {
  double tolerance_mm = 0.05;    // as many shapes as bring the vertices' error (largest over examined frames) below it
  std::int64_t max_shapes = 64;  // but no more
  std::int64_t examined = 300;   // frames at most, evenly spread, that the shapes are found from
};

struct BakeShapesResult {
  Rig rig;  // the head with the shapes motion_0, motion_1, ... in place of its own, the largest first
  double rms_mm = 0;
  double largest_mm = 0;  // of any vertex in any frame: what the shapes do not explain
};

// An animation of vertices as blend shapes, so that everything that takes a rig and weights (pictures, glTF) takes it:
// principal components of the offsets from rest, without their mean, so that weights of 0 are the head at rest (Gram
// matrix of the examined frames; Sirovich, Turbulence and the dynamics of coherent structures, 1987). A shape's largest
// weight over the animation is 1. points: V vertices in every frame; a frame without any repeats the one before.
BakeShapesResult bake_shapes(const Rig& rig, const engine::Seq<MeshPoints>& points, engine::SeqWriter<Weights>& weights,
                             const BakeShapesOptions& options, engine::Progress& progress);

}  // namespace face::meshik
