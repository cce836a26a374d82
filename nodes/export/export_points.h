// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/export/length_unit.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/timeline.h"

namespace face::exports {

struct ExportPointsOptions {
  ExportUnit unit = ExportUnit::m;  // of the lengths in the file
};

// The vertices of every frame as an array of NumPy, frames x vertices x 3, float32, as VOCASET has them. Throws where a
// frame has another number of vertices than the first.
engine::File export_points_npy(const engine::Seq<MeshPoints>& points, const ExportPointsOptions& options = {});

// The same as a point cache .pc2, which Blender's Mesh Cache modifier and 3ds Max read: "POINTCACHE2", version 1,
// vertices, start 0, rate 1 (a sample per frame), frames; then floats, all little endian. The times of frames are not
// in it: the scene plays it at its own rate.
engine::File export_pc2(const engine::Seq<MeshPoints>& points, const ExportPointsOptions& options = {});

// A mesh and the vertices of every frame as USD in text (.usda), one Mesh with points.timeSamples: y up, in mm
// (metersPerUnit 0.001) to the micrometre, time codes are frames at the timeline's mean rate, texture coordinates per
// corner as primvars:st, vertex colours as displayColor in linear light, parts as GeomSubsets. Written by hand, as
// Debian packages no USD.
engine::File export_usda(const Mesh& mesh, const engine::Seq<MeshPoints>& points, const Timeline& timeline);

}  // namespace face::exports
