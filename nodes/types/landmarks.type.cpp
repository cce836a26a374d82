// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/landmarks.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(Landmarks, "landmarks", codec_version{1}, doc{"Named points in an image."},
     field<&Landmarks::points>(field<&Landmark::name>(), field<&Landmark::x_px>(), field<&Landmark::y_px>(),
                               field<&Landmark::valid>()),
     view{"png", "render.landmarks_still"}, difference{"evaluate.landmarks_difference"});
