// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/plugin/plugins.h"
#include "engine/value/value.h"

namespace engine {

// A value as the bytes of a file with this suffix (".png"): by the view that its type names, or as JSON (".json").
// A File gives its own bytes. Throws std::invalid_argument, naming the suffixes there are.
std::string view_value(const Value& value, const std::string& suffix, Plugins& plugins);

}  // namespace engine
