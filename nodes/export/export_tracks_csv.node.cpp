// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_tracks_csv.h"

#include "engine/node.h"
#include "nodes/types/landmarks.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.tracks_csv", &export_tracks_csv, version{1},
     doc{"Writes tracked points as a table: frame,point,x_px,y_px,valid."}, input{"tracks", "Points of every frame"},
     output("file", "The .csv file"));
