// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_live_link_csv.h"

#include "engine/node.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.live_link_csv", &export_live_link_csv, version{1},
     doc{"Writes ARKit weights per frame as a table with the columns of Live Link Face."},
     input{"frames", "Blend-shape weights of every frame"}, input{"timeline", "When every frame is shown"},
     param("timecode_rate_hz", &ExportLiveLinkCsvOptions::timecode_rate_hz, range{1, 240}, unit{"Hz"},
           "Frames per second of the timecode"),
     output("file", "The .csv file"));
