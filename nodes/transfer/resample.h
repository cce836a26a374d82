// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/cylinder_scan.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/surface_map.h"
#include "nodes/types/weights.h"

namespace face::transfer {

// A head of the identity model, at any weights, in the topology of the speaking model: places, looked up once, serve
// for every head of the same mesh (Bargmann, Blanz and Seidel, section 6). places: V x 1, from transfer.look_up or
// transfer.scan_places. world_from_head moves the head to where the speaking model lives (scan_from_model of
// transfer.fit_identity); null = it is there. mesh: the speaking model's; shape: its neutral frame. Vertices without a
// place move from shape as those around them do. weights null: neutral. Result: V points.
MeshPoints resample(const SurfaceMap& places, const Rig& head, const Weights* weights,
                    const RigidMotion* world_from_head, const Mesh& mesh, const MeshPoints& shape);

// The speaking model's mesh in the head's colours: its vertex colours times its parts'. The mesh's own colours stay
// where the head has neither. Vertices without a place are coloured as those around them.
Mesh resample_colours(const SurfaceMap& places, const Rig& head, const Mesh& mesh);

struct ResampleScanResult {
  MeshPoints shape;  // V: the person in the speaking model's topology
  Mesh mesh;         // the same with polygons, and the scan's colours
};

// resample from a laser scan of a new person: fitted is the identity model in the scan's world (fit_identity on the
// scan); every vertex looks radius and colour up in the scan at the fitted model's height and angle, so that the scan's
// own shape is taken and the model gives the correspondence alone. Where the scan has nothing, or more than 10 mm
// before or behind it, the model's point counts, in the colour of the vertices about it. head: whose mesh the model's
// is. scan_from_model, world_from_model: motions of the two fits, the scan's and the speaking model's; null = none.
ResampleScanResult resample_scan(const SurfaceMap& places, const Rig& head, const MeshPoints& fitted,
                                 const CylinderScan& scan, const RigidMotion* scan_from_model,
                                 const RigidMotion* world_from_model, const Mesh& mesh, const MeshPoints& shape);

// Where every vertex of a scanned mesh is on the head that was scanned: truth, the point that every pixel of the scan
// shows (phantom.scan_frame), at the vertices' pixels. V x 1. mesh: of model.scan_mesh, whose uvs are places in the
// scan's picture. head: a pixel at the lips' edge that shows what is behind them (parts of mouth, gums, teeth and
// tongue) has no place; null = all have.
SurfaceMap scan_places(const SurfaceMap& truth, const Mesh& mesh, const Rig* head);

}  // namespace face::transfer
