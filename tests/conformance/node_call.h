// SPDX-License-Identifier: Apache-2.0
// Calls a declared node on values in memory, as the engine does, and says what came of it.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "engine/base/digest.h"
#include "engine/declare/call.h"

namespace conformance {

using AnyValue = std::shared_ptr<const void>;

// What one port is given: a value; or elements, where the port takes a sequence or a window. Absent: neither.
struct PortValue {
  bool absent = false;
  AnyValue value;
  AnyValue before;                 // the value at the preceding element, where it is another
  std::vector<AnyValue> elements;  // ids 0, 1, ...
};
using PortValues = std::vector<PortValue>;
using Params = std::vector<engine::ParamValue>;

struct Outcome {
  bool threw = false;
  bool no_exception = false;  // what it threw is no std::exception, or has no text
  std::string what;
  std::vector<engine::Digest> outputs;
  std::vector<std::vector<AnyValue>> values;  // per output; of a sequence all elements
  bool operator==(const Outcome& other) const {
    return threw == other.threw && what == other.what && outputs == other.outputs;
  }
};

// Where a node reads its own result at the preceding element it is called twice: at a first element and at the next.
Outcome call_node(const engine::NodeDeclaration& node, const PortValues& inputs, const Params& params);

engine::Digest digest_of_value(const engine::TypeInfo& type, const AnyValue& value);

Params defaults_of(const engine::NodeInfo& info);

}  // namespace conformance
