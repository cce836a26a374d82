// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/rig.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(Rig, "rig", codec_version{1}, doc{"A head and its blend shapes, the ARKit-52 first."},
     field<&Rig::neutral>(field<&Mesh::points_mm>(), field<&Mesh::corners>(), field<&Mesh::polygon_starts>(),
                          field<&Mesh::uvs>(), field<&Mesh::corner_uvs>(), field<&Mesh::colors_srgb>(),
                          field<&Mesh::parts>(field<&Part::name>(), field<&Part::first_polygon>(),
                                              field<&Part::polygon_count>(), field<&Part::albedo_srgb>(),
                                              field<&Part::gloss>(), field<&Part::visible>())),
     field<&Rig::shapes>(field<&Shape::name>(), field<&Shape::vertices>(), field<&Shape::offsets_mm>()),
     field<&Rig::missing>(), field<&Rig::inner_lips>(field<&LipPair::upper>(), field<&LipPair::lower>()),
     field<&Rig::lower_lip>(), field<&Rig::upper_teeth>(), field<&Rig::landmarks68>(), view{"png", "render.rig_still"},
     difference{"evaluate.rig_difference"});
