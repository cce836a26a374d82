// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"
#include "nodes/types/depth_scan.h"

namespace face::align {

// The scan with an id, such as that of the frame that choose_reference chose, from another recording of the same
// frames. Throws where no scan has the id.
DepthScan pick_scan(const engine::Seq<DepthScan>& scans, const std::string& frame);

}  // namespace face::align
