// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/flow_field.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(FlowField, "flow_field", codec_version{1},
     doc{"Displacement of every pixel from a reference picture to a target."}, field<&FlowField::width>(),
     field<&FlowField::height>(), field<&FlowField::displacement_px>(), field<&FlowField::valid>(),
     view{"png", "render.flow_still"}, difference{"evaluate.flow_difference"});
