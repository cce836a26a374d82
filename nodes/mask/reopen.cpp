// SPDX-License-Identifier: Apache-2.0
#include "nodes/mask/reopen.h"

#include "nodes/base/check.h"
#include "nodes/base/scan_points.h"

namespace face::mask {

DepthScan reopen(const DepthScan& scan, const Image& interior) {
  check_scan(scan, "scan");
  check(interior.pixels.size() == scan.depth_mm.size(), "interior has ", interior.pixels.size(), " pixels, the scan ",
        scan.depth_mm.size());
  DepthScan out = scan;
  for (std::size_t i = 0; i < out.depth_mm.size(); ++i)
    if (interior.pixels[i] >= 128) out.depth_mm[i] = 0;
  return out;
}

}  // namespace face::mask
