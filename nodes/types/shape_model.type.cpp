// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/shape_model.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(ShapeModel, "shape_model", codec_version{1}, doc{"A linear space of shapes, from principal component analysis."},
     field<&ShapeModel::vertices>(), field<&ShapeModel::mean_mm>(), field<&ShapeModel::sigmas_mm>(),
     field<&ShapeModel::modes>(), field<&ShapeModel::projections>());
