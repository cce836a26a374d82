// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/morphable_model.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(MorphableModel, "morphable_model", codec_version{1}, doc{"Linear spaces of identity, expression and albedo."},
     field<&MorphableModel::mean>(field<&Mesh::points_mm>(), field<&Mesh::corners>(), field<&Mesh::polygon_starts>(),
                                  field<&Mesh::uvs>(), field<&Mesh::corner_uvs>(), field<&Mesh::colors_srgb>(),
                                  field<&Mesh::parts>(field<&Part::name>(), field<&Part::first_polygon>(),
                                                      field<&Part::polygon_count>(), field<&Part::albedo_srgb>(),
                                                      field<&Part::gloss>(), field<&Part::visible>())),
     field<&MorphableModel::identity>(field<&LinearSpace::names>(), field<&LinearSpace::sigmas>(),
                                      field<&LinearSpace::modes>()),
     field<&MorphableModel::expression>(field<&LinearSpace::names>(), field<&LinearSpace::sigmas>(),
                                        field<&LinearSpace::modes>()),
     field<&MorphableModel::albedo>(field<&LinearSpace::names>(), field<&LinearSpace::sigmas>(),
                                    field<&LinearSpace::modes>()),
     field<&MorphableModel::mean_albedo>(), field<&MorphableModel::landmarks68>(),
     field<&MorphableModel::inner_lips>(field<&LipPair::upper>(), field<&LipPair::lower>()));
