// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"

namespace face::decode {

// The takes of a recorded stream of scans, by name: the folders below depth/ or cloud/, see depth_take. Throws where
// there are none.
void list_takes(const engine::File& folder, engine::SeqWriter<std::string>& takes);

}  // namespace face::decode
