// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/shape_set.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(ShapeSet, "shape_set", codec_version{1}, doc{"Directions in which heads differ."},
     field<&ShapeSet::shapes>(field<&Shape::name>(), field<&Shape::vertices>(), field<&Shape::offsets_mm>()));
