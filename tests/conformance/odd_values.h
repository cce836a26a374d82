// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "tests/conformance/node_call.h"

namespace conformance {

enum class Oddity { empty, one_element, not_a_number, infinite };
std::string name_of(Oddity oddity);

// The value made odd: its lists emptied, or cut to one element each, or every real number in it replaced. Null where
// that leaves the value as it is. Works on the canonical bytes along the layout that the type declares.
AnyValue odd_value(const engine::TypeInfo& type, const AnyValue& value, Oddity oddity);

}  // namespace conformance
