// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_points.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.points", &read_points, version{1},
     doc{"Reads the vertices of an animation: an array of NumPy (frames x vertices x 3) or a point cache (.pc2)."},
     input{"file", "A .npy or .pc2 file"},
     param("unit", &ReadPointsOptions::unit,
           {{"automatic", LengthUnit::automatic}, {"mm", LengthUnit::mm}, {"cm", LengthUnit::cm}, {"m", LengthUnit::m}},
           "Unit of the lengths in the file; automatic goes by the size of the first frame"),
     output("points", "The vertices of every frame in mm"));
