// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/landmarks.h"

namespace face::exports {

// Writes tracked points as a table with the columns frame,point,x_px,y_px,valid: one row per frame and point, frame =
// the element's id, positions to 1/1000 pixel, valid 1 or 0. Names that hold a comma or a quote are quoted (RFC 4180).
engine::File export_tracks_csv(const engine::Seq<Landmarks>& tracks);

}  // namespace face::exports
