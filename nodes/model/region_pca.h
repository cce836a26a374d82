// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "engine/port.h"
#include "nodes/types/matrix.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/rig.h"
#include "nodes/types/shape_model.h"
#include "nodes/types/weights.h"

namespace face::model {

struct RegionPcaOptions {
  std::int64_t components = 50;
  double least_sigma = 1e-7;  // relative to the first: smaller ones are noise that 1 / w would blow up
};

// Principal component analysis that looks at a region and yields the whole face (Bargmann, Blanz and Seidel, Eq. 7).
// With mean-free reduced vectors x~ = D^(1/2) x (D = weights >= 0, one per vertex) and X~ = U~ W~ V~',
//   u_i = sum_j v~_ji x_j / w~_i  (modes: full faces, not orthogonal),  a_i = u~_i . x~  (coefficients),
// so that at full rank every example is mean + sum_i a_i u_i exactly; with fewer it is the linear regression of the
// face on the region. Through the m x m Gram matrix of the examples instead of the singular value decomposition: m is
// far below 3 V. The paper's mask is D of zeros and ones; any weights are taken. sigmas are w~_i / sqrt(m). shapes: m
// examples of V points. weights: V, or null (all 1: plain principal component analysis). Signs: the largest entry of
// every projection is positive.
ShapeModel region_pca(const engine::Seq<MeshPoints>& shapes, const Matrix* weights,
                      const RegionPcaOptions& options = {});

struct ProjectShapeOptions {
  bool in_sigmas = false;  // as model_rig
};

// Coefficients of a shape, K of them. The model's vertices and the shape's are the same. known: false where the frame
// is lost (align.orient did not solve it): no coefficients; null = it is not.
Weights project_shape(const ShapeModel& model, const MeshPoints& shape, const bool* known = nullptr,
                      const ProjectShapeOptions& options = {});

struct RebuildShapeOptions {
  double amplify = 1;
  bool in_sigmas = false;  // as project_shape
};

// The shape of coefficients (k <= K of them; the rest are 0), their departure from the mean times amplify (the paper
// shows modes three times enlarged).
MeshPoints rebuild_shape(const ShapeModel& model, const Weights& coefficients, const RebuildShapeOptions& options = {});

// project_shape and rebuild_shape in double: x of 3 V and coefficients of k <= K.
std::vector<double> coefficients_of(const ShapeModel& model, const std::vector<double>& shape_mm);
std::vector<double> shape_of(const ShapeModel& model, const std::vector<double>& coefficients, double amplify = 1);

struct ModelRigOptions {
  std::int64_t components = 20;
  bool in_sigmas = false;
};

// A linear space of shapes as a rig, so that it can be rendered, exported and animated as any head: its neutral is the
// mean on the polygons and colours of mesh, its shapes are the first modes ("pc_1", ...), its weights the coefficients
// (in_sigmas: in standard deviations). All ARKit shapes are missing.
Rig model_rig(const ShapeModel& model, const Mesh& mesh, const ModelRigOptions& options = {});

}  // namespace face::model
