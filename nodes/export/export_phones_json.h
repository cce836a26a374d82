// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/phones.h"

namespace face::exports {

// Writes an alignment as JSON, one phone per line (see write_phones_json).
engine::File export_phones_json(const Phones& phones);

}  // namespace face::exports
