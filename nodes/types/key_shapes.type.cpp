// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/key_shapes.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(KeyShapes, "key_shapes", codec_version{1}, doc{"The typical shapes of a performance."},
     field<&KeyShapes::shapes>(
         field<&KeyShape::frame>(), field<&KeyShape::size>(),
         field<&KeyShape::landmarks>(field<&Landmarks::points>(field<&Landmark::name>(), field<&Landmark::x_px>(),
                                                               field<&Landmark::y_px>(), field<&Landmark::valid>()))));
