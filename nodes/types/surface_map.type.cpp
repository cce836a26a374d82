// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/surface_map.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(SurfaceMap, "surface_map", codec_version{1}, doc{"Which point of a mesh every pixel of a picture shows."},
     field<&SurfaceMap::width>(), field<&SurfaceMap::height>(), field<&SurfaceMap::triangle>(),
     field<&SurfaceMap::weights>());
