// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/image.h"

namespace face::mmm {

struct RebuildPcaOptions {
  std::int64_t components = 92;  // as many as the parameters of a model of 46 prototypes
};

// Pictures as the mean and the leading principal components of examples have them, without any warp: for comparison
// with a morphable model of as many parameters. examples, pictures: of one size; components beyond those that the
// examples span are left out.
void rebuild_pca(const engine::Seq<Image>& examples, const engine::Seq<Image>& pictures,
                 engine::SeqWriter<Image>& rebuilt, const RebuildPcaOptions& options = {});

}  // namespace face::mmm
