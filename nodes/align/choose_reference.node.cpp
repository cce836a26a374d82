// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/choose_reference.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::align;

NODE("align.choose_reference", &choose_reference, version{2},
     doc{"The reference of a corpus of scans: a frame with a slightly open mouth, named or found."},
     input{"scans", "All scans"}, input{"markers", "Their markers"},
     input{"interiors", "What was removed of each mouth"},
     param("frame", &ChooseReferenceOptions::frame, "Id of the frame; empty = it is found"),
     param("openness", &ChooseReferenceOptions::openness, range{0.0, 1.0}, unit{"1"},
           "How far the mouth is open, as a share of the widest"),
     param("odd", &ChooseReferenceOptions::odd, range{0.0, 100.0}, unit{"1"},
           "Frames so many times as unlike the stream, above the mouth, as the median one are passed over; 0 = none"),
     output("scan", &ChooseReferenceResult::scan, "The reference scan"),
     output("markers", &ChooseReferenceResult::markers, "Its markers"),
     output("interior", &ChooseReferenceResult::interior, "What was removed of its mouth"),
     output("frame", &ChooseReferenceResult::frame, "Its id"));
