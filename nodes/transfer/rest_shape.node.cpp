// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/rest_shape.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.rest_shape", &rest_shape, version{1},
     doc{"The neutral face of a corpus: the mean of its silent frames, or of other phones' (\"P B M\": the shut "
         "mouth)."},
     input{"shapes", "Shape vectors of all frames"}, input{"timeline", "When they are shown"},
     input{"phones", "What is said"}, input{"known", "False where a frame is lost; unconnected: none is"},
     param("label", &RestShapeOptions::label,
           "Segments that count, with spaces between; after a comma those that count where no frame shows any of the "
           "first"),
     param("margin_s", &RestShapeOptions::margin_s, range{0.0, 10.0}, unit{"s"},
           "Frames nearer to the end of a segment do not count, where others are left"),
     output("rest", "The neutral face"));
