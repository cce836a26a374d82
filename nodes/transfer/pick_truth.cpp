// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/pick_truth.h"

#include "nodes/base/check.h"

namespace face::transfer {

PickTruthResult pick_truth(const engine::Seq<SurfaceMap>& truths, const engine::Seq<RigidMotion>& motions,
                           const std::string& frame) {
  check(truths.size() == motions.size(), "truths has ", truths.size(), " frames, motions ", motions.size());
  for (std::size_t t = 0; t < truths.size(); ++t)
    if (truths.id(t) == frame) return {*truths.at(t), *motions.at(t)};
  fail("frame is \"", frame, "\", which none of ", truths.size(), " has");
}

}  // namespace face::transfer
