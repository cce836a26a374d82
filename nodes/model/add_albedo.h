// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/morphable_model.h"

namespace face::model {

struct AddAlbedoOptions {
  std::int64_t albedos = 99;  // components at most
  std::int64_t skins = 120;   // made persons' skins they come from, where the model has its 68 landmarks
  std::int64_t seed = 1;
};

// Gives a model without colours those of made skins, as model.from_rig does, so that pictures can be fitted with it; a
// model of shapes alone (the Surrey Face Model in its free edition, FLAME) has none. What the model has is kept: a mean
// albedo without components gets components only, a model with both comes back as it is.
MorphableModel add_albedo(const MorphableModel& model, const AddAlbedoOptions& options = {});

}  // namespace face::model
