// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/matrix.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(Matrix, "matrix", codec_version{1}, doc{"A matrix of numbers."}, field<&Matrix::rows>(), field<&Matrix::columns>(),
     field<&Matrix::values>(), view{"npy", "export.npy"}, difference{"evaluate.matrix_difference"});
