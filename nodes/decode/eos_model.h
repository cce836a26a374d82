// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/decode/length_unit.h"
#include "nodes/types/morphable_model.h"

namespace face::decode {

// Reads a morphable model as eos saves it (Huber et al., A Multiresolution 3D Morphable Face Model and Fitting
// Framework, VISAPP 2016; its archives hold shape, colour, and from version 2 on expression, landmarks and texture
// coordinates, little endian, matrices by columns): the Surrey Face Model and converted Basel and York models. Versions
// 1 to 4; colours are taken as sRGB of 0 to 1. landmarks68 stays empty unless the file names points "1" to "68". The
// albedo is empty where the file has no colours. expressions: a file of eos's blend shapes for a model without
// expressions of its own, or null. Every blend shape's coefficient is taken to spread by 0.5.
MorphableModel read_eos_model(const engine::File& file, const engine::File* expressions, LengthUnit unit);

}  // namespace face::decode
