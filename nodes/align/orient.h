// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/port.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/rigid_motion.h"

namespace face::align {

struct AbsoluteOrientation {
  RigidMotion to_from;  // to = rotation * from + translation
  double rms_mm = 0;
  bool solved = false;  // false for fewer than three points, or points on a line
};

// The rotation and translation that bring matched points together with least weighted squared error (Horn, Closed-Form
// Solution of Absolute Orientation Using Unit Quaternions, JOSA A 1987; solved by the singular value decomposition of
// Arun, Huang and Blostein, PAMI 1987, with the reflection ruled out). from_mm, to_mm, weights: N.
AbsoluteOrientation absolute_orientation(const std::vector<std::array<double, 3>>& from_mm,
                                         const std::vector<std::array<double, 3>>& to_mm,
                                         const std::vector<double>& weights);

struct OrientOptions {
  std::vector<std::string> rigid;  // names; empty = the upper part of the constellation
  double upper_share = 0.6;
  double scale_mm = 0.3;
};

struct OrientResult {
  DepthScan aligned;  // the scan, its camera moved so that its world is the reference's head
  RigidMotion reference_from_scan;
  double rms_mm = 0;      // of the markers used, weighted
  std::int64_t used = 0;  // markers that count at least half
  bool solved = false;
};

// Takes the head's motion out of a scan: markers that the jaw does not move are brought onto those of the reference in
// 3D. A marker that was lost, has no depth, was mistaken, or moves with a brow counts little or nothing (Geman and
// McClure's weights of scale scale_mm, or a little more than the least median where that is larger, reweighted to
// convergence from a least-median start over triples), so one bad marker moves nothing.
// Depth at a marker is that of a plane fitted to the 9 x 9 pixels about it. Unsolvable (fewer than three markers):
// solved is false, the scan stays where it is, and a warning says so. Markers of the jaw are left out by `rigid`, a
// list of names, or by keeping the highest upper_share of the reference's.
OrientResult orient(const DepthScan& scan, const Landmarks& markers, const DepthScan& reference,
                    const Landmarks& reference_markers, const OrientOptions& options, engine::Progress& progress);

}  // namespace face::align
