// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/pick_scan.h"

#include "nodes/base/check.h"

namespace face::align {

DepthScan pick_scan(const engine::Seq<DepthScan>& scans, const std::string& frame) {
  for (std::size_t t = 0; t < scans.size(); ++t)
    if (scans.id(t) == frame) return *scans.at(t);
  fail("frame is \"", frame, "\", which none of ", scans.size(), " has");
}

}  // namespace face::align
