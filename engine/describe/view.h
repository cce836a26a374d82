// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "engine/plugin/plugins.h"
#include "engine/value/value.h"

namespace engine {

// A value as the bytes of a file with this suffix (".png"): by the view that its type names, or as JSON (".json"). A
// view may give a value of another type, which is then shown by its own. A File gives its own bytes. Throws
// std::invalid_argument, naming the suffixes there are.
std::string view_value(const Value& value, const std::string& suffix, Plugins& plugins);

// What an output of a difference is called, and what it says.
struct NamedValue {
  std::string name;
  Value value;
};
// Two values of one type beside each other: the outputs of the difference that their type names, called with its default
// parameters. Empty where the type names none. Throws what the node throws.
std::vector<NamedValue> compare_values(const Value& a, const Value& b, Plugins& plugins);

}  // namespace engine
