// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/albedo_map.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(AlbedoMap, "albedo_map", codec_version{1}, doc{"A face's own colour over its uvs."}, field<&AlbedoMap::width>(),
     field<&AlbedoMap::height>(), field<&AlbedoMap::albedo>(), field<&AlbedoMap::weight>(),
     difference{"evaluate.albedo_difference"});
