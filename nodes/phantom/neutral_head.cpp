// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/neutral_head.h"

#include "nodes/phantom/brows.h"
#include "nodes/phantom/ears.h"
#include "nodes/phantom/hair.h"
#include "nodes/phantom/lashes.h"
#include "nodes/phantom/paint.h"

namespace face::phantom {

Head neutral_head(const MakeHeadOptions& options) {
  Head head;
  head.skin = add_skin(head.mesh);
  paint_skin(head.mesh, head.skin);
  head.eyes = add_eyes(head.mesh);
  head.mouth = add_mouth_interior(head.mesh);
  head.lashes = add_lashes(head.mesh, head.skin);
  head.brows = add_brows(head.mesh, head.skin);
  head.ears.first = head.mesh.vertex_count();
  add_ears(head.mesh);
  head.ears.end = head.hair.first = head.mesh.vertex_count();
  head.mesh.symmetrise();
  if (options.with_hair) add_hair(head.mesh);  // falls to one side
  head.hair.end = head.mesh.vertex_count();
  return head;
}

}  // namespace face::phantom
