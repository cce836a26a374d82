// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/stack_motion.h"

namespace face::phantom {

Matrix stack_motion(const engine::Seq<RigidMotion>& motion) {
  Matrix stacked;
  stacked.rows = motion.size();
  stacked.columns = 12;
  stacked.values.reserve(12 * motion.size());
  for (const RigidMotion& moment : motion) {
    stacked.values.insert(stacked.values.end(), moment.rotation.begin(), moment.rotation.end());
    stacked.values.insert(stacked.values.end(), moment.translation_mm.begin(), moment.translation_mm.end());
  }
  return stacked;
}

}  // namespace face::phantom
