// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/mmm.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(Mmm, "mmm", codec_version{1}, doc{"A multidimensional morphable model of a mouth: pictures and their flows."},
     field<&Mmm::prototypes>(field<&MmmPrototype::frame>(),
                             field<&MmmPrototype::image>(field<&Image::width>(), field<&Image::height>(),
                                                         field<&Image::channels>(), field<&Image::pixels>()),
                             field<&MmmPrototype::flow_64th_px>()),
     field<&Mmm::reference>());
