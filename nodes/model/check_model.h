// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/morphable_model.h"

namespace face::model {

// Throws where a model's mesh, spaces, albedo, landmarks and lips do not fit each other: what reads a model after it
// needs no further look.
void check_model(const MorphableModel& model);

}  // namespace face::model
