// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/cylinder_scan.h"
#include "nodes/types/flow_field.h"
#include "nodes/types/image.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/rigid_motion.h"

namespace face::model {

// What the scanner would see of a surface in a shape: radius and colour at every pixel of the reference's grid, colours
// those of the reference's picture at the places where the surface was cut from it; teeth and the inside of the mouth,
// which a surface has after model.add_teeth, in their own colours and where the shape puts them. shape: of the skin.
CylinderScan draw_cylinder(const MorphableModel& surface, const MeshPoints& shape, const CylinderScan& reference);

struct MatchCylinderOptions {
  double outlier_mm = 2;
};

struct MatchCylinderResult {
  MeshPoints shape;    // the skin's vertices in the target: the shape vector S_i of Eq. 2
  Image texture;       // RGB, V x 1: the texture vector T_i of Eq. 3
  double sampled = 0;  // share of the vertices that were found; the others are filled in
};

// The surface's vertices in a scan (Blanz, Basso, Poggio, Vetter: Reanimating Faces in Images and Video, 2003, section
// 2.3): each is looked up in drawn, the picture of start, moved by the flow from there to target, and takes the
// target's radius and colour there. Vertices that drawn hides (inner lips), whose flow leaves what is measured, or that
// move otherwise than those about them by more than outlier_mm, are filled in: their displacement from start is the
// harmonic continuation of their neighbours' over the mesh. Where the scan shows lips and not the inside of a mouth
// between the edges of the surface's mouth, these are brought together on what is seen, column by column. start: the
// combination that the flow began with. drawn: of start, by draw_cylinder.
MatchCylinderResult match_cylinder(const MorphableModel& surface, const MeshPoints& start, const CylinderScan& drawn,
                                   const CylinderScan& target, const FlowField& flow,
                                   const MatchCylinderOptions& options = {});

struct OrientShapeOptions {
  double scale_mm = 0.8;
};

struct OrientShapeResult {
  MeshPoints shape;
  RigidMotion surface_from_scan;
  double rms_mm = 0;  // of the upper face, weighted
};

// Brings a shape to rest: the rotation and translation that lay its upper face (above the tip of the nose) over the
// surface's (absolute orientation, Horn 1987), reweighted so that vertices that move (brows) count little.
OrientShapeResult orient_shape(const MeshPoints& shape, const MorphableModel& surface,
                               const OrientShapeOptions& options = {});

}  // namespace face::model
