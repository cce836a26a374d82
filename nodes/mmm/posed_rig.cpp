// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/posed_rig.h"

#include "nodes/base/check.h"

namespace face::mmm {

Rig posed_rig(const Rig& rig, const MeshPoints& points) {
  check(points.points_mm.size() == rig.neutral.points_mm.size(), "there are ", points.points_mm.size(),
        " points, the rig has ", rig.neutral.points_mm.size(), " vertices");
  Rig posed = rig;
  posed.neutral.points_mm = points.points_mm;
  for (Shape& shape : posed.shapes) shape = {shape.name, {}, {}};
  return posed;
}

}  // namespace face::mmm
