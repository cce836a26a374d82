// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_rig.h"

#include "nodes/decode/gltf_file.h"
#include "nodes/decode/gltf_rig.h"
#include "nodes/decode/ict_rig.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/rig_shapes.h"

namespace face::decode {

Rig read_rig(const engine::File& file, const engine::File* names, const ReadRigOptions& options) {
  const ShapeNames shape_names = names ? read_shape_names(*names) : ShapeNames();
  const bool of_objs = file.is_folder() && is_obj_rig(file);
  Rig rig = of_objs ? read_obj_rig(file, shape_names, options.unit) : read_gltf_rig(file, shape_names, options.unit);
  expect_speech(title_of(of_objs ? file : gltf_main_file(file)), rig);
  return rig;
}

}  // namespace face::decode
