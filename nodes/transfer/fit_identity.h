// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/cylinder_scan.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/rigid_motion.h"

namespace face::transfer {

struct FitIdentityOptions {
  std::int64_t components = 100;  // at most
  double stiffness_mm2 = 5e-5;
  double scale_mm = 0.5;
  std::int64_t steps = 12;
};

struct FitIdentityResult {
  MeshPoints points;            // V: the fitted model, in the scan's world
  Matrix coefficients;          // 1 x K, in standard deviations
  RigidMotion scan_from_model;  // of the whole head
  double rms_mm = 0;            // of the surface's distance, weighted
  double used = 0;              // share of the scan-facing skin that counts at least half
  bool solved = false;
};

// Fits a model of identities to a neutral face that is given around an axis (Bargmann, Blanz and Seidel, section 6,
// after Blanz and Vetter, A Morphable Model for the Synthesis of 3D Faces, SIGGRAPH 1999): the rigid motion and linear
// coefficients with which r(h, phi) of the model is that of the scan. Every skin vertex that faces outwards is held
// against the scan at its own (h, phi); what counts is the distance to the scan's surface along its normal, so that
// slopes do not count more (Chen and Medioni, Object Modelling by Registration of Multiple Range Images, 1992). Robust
// least squares by Gauss-Newton (Geman and McClure's weights, scale falling to scale_mm), first the motion alone, then
// with more and more components; a coefficient c costs stiffness_mm2 * c^2 per vertex.
// Differs from the paper: r alone decides, g only where marks come from it, for the grey of a scanner's light is no
// albedo; and all of it is one small linear system per step in place of stochastic descent.
// marks: points of the scan's picture by the names that models know (model.fit_image), three or more not on a line.
// They give the start and then, more and more weakly, hold it. A second start lays the tips of the noses over each
// other; it is taken where there are no marks, or where it covers a tenth more of the skin. Not solved: no three marks
// and no nose, or less than a tenth of the skin finds a surface.
FitIdentityResult fit_identity(const MorphableModel& model, const CylinderScan& scan, const Landmarks* marks,
                               const FitIdentityOptions& options = {});

}  // namespace face::transfer
