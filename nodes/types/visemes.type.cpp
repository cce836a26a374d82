// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/visemes.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(Visemes, "visemes", codec_version{1}, doc{"What the face does for every phone."},
     field<&Visemes::visemes>(field<&Viseme::label>(), field<&Viseme::weights>(), field<&Viseme::glide_weights>(),
                              field<&Viseme::sigmas>(), field<&Viseme::glide_from>(), field<&Viseme::contact>(),
                              field<&Viseme::open_mm>()));
