// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_rig.h"

#include "nodes/base/check.h"
#include "nodes/decode/ict_rig.h"
#include "nodes/decode/input_file.h"

namespace face::decode {

Rig read_rig(const engine::File& file, const engine::File* names, const ReadRigOptions& options) {
  (void)names;
  if (file.is_folder()) {
    if (is_obj_rig(file)) return read_obj_rig(file, options.unit);
    fail(title_of(file), ": is not a rig: found ", file.entries().size(),
         " files, expected an ICT-FaceKit folder with generic_neutral_mesh.obj and one OBJ file per shape");
  }
  fail(title_of(file), ": is not a rig: expected an ICT-FaceKit folder or a GLB or glTF file with morph targets");
}

}  // namespace face::decode
