// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/npy.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.npy", &npy, version{1}, doc{"Reads an array of numbers as NumPy saves it."},
     input{"file", "A .npy file: float32, float64, int32, int64, uint8 or bool"},
     output("matrix", "The numbers; a list is a column, further dimensions are side by side"));
