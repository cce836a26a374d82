// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/phones.h"

namespace face::exports {

// Writes an alignment for Praat: a TextGrid with the tiers "words" and "phones".
engine::File export_text_grid(const Phones& phones);

}  // namespace face::exports
