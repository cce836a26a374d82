// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/surface_dots.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(SurfaceDots, "surface_dots", codec_version{1}, doc{"Markers, moles and freckles on a mesh."},
     field<&SurfaceDots::dots>(field<&SurfaceDot::name>(), field<&SurfaceDot::vertices>(),
                               field<&SurfaceDot::weights>(), field<&SurfaceDot::radius_mm>(),
                               field<&SurfaceDot::edge_mm>(), field<&SurfaceDot::color_srgb>(),
                               field<&SurfaceDot::opacity>()));
