// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/read_opening.h"

#include "engine/node.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/table.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.read_opening", &read_opening, version{1},
     doc{"Reads from pictures how far a mouth is open, and compares it with the truth."},
     input{"known", "Pictures to learn reading from"}, input{"known_truth", "Their true points"},
     input{"images", "Pictures that are read"}, input{"truth", "True points of the same frames"},
     param("upper", &ReadOpeningOptions::upper, "The point on the edge of the upper lip"),
     param("lower", &ReadOpeningOptions::lower, "The point on the edge of the lower lip"),
     param("width_px", &ReadOpeningOptions::width_px, range{1, 1000}, unit{"px"},
           "Width of the small pictures that are read"),
     param("pictures", &ReadOpeningOptions::pictures, range{4, 10000}, unit{"1"}, "Most known pictures that count",
           inert{"a cap: it matters where more are known"}),
     param("restraint", &ReadOpeningOptions::restraint, range{1e-6, 1e12}, unit{"1"},
           "Of the regression, in grey values squared"),
     output("table", &ReadOpeningResult::table, "Correlation, amplitude and error over all frames"),
     output("frames", &ReadOpeningResult::frames, "What was read, and the truth, of each frame"));
