// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/npy.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.npy", &npy, version{1}, doc{"Writes a matrix as numpy.save does."}, input{"matrix", "Numbers to write"},
     param("numbers", &NpyOptions::numbers, {{"real", NpyNumbers::real}, {"integer", NpyNumbers::integer}},
           "float64, or int64 for labels and indices"),
     param("shape", &NpyOptions::shape,
           {{"matrix", NpyShape::matrix}, {"vector", NpyShape::vector}, {"points", NpyShape::points}},
           "Rows and columns; a list; or rows of points with x, y, z each"),
     output("file", "The .npy file"));
