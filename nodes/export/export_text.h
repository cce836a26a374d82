// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"

namespace face::exports {

// Writes a text (a report) as a .txt file, UTF-8 as it is.
engine::File export_text(const std::string& text);

}  // namespace face::exports
