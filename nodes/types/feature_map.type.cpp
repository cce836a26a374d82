// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/feature_map.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(FeatureMap, "feature_map", codec_version{1},
     doc{"A picture of measurements (radius, grey, ...), as dense correspondence compares them."},
     field<&FeatureMap::width>(), field<&FeatureMap::height>(), field<&FeatureMap::names>(),
     field<&FeatureMap::values>(), field<&FeatureMap::valid>());
