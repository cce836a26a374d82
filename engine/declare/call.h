// SPDX-License-Identifier: Apache-2.0
// What a running node sees of the engine: a declaration turns a C++ function into a function of this.
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/declare/node_info.h"
#include "engine/port.h"
#include "engine/value/type_info.h"

namespace engine {

// A sequence that a task reads, one level deep; inner() opens the next level of a nested one.
class SequenceAccess {
 public:
  virtual ~SequenceAccess() = default;
  virtual std::size_t size() const = 0;
  virtual std::string id(std::size_t index) const = 0;
  virtual std::shared_ptr<const void> load(std::size_t index) const = 0;
  virtual std::shared_ptr<const SequenceAccess> inner(std::size_t index) const = 0;
};

class Call {
 public:
  virtual ~Call() = default;
  // Inputs by their index in NodeInfo::inputs. Null where an optional one is absent.
  virtual std::shared_ptr<const void> value(std::size_t input) = 0;
  virtual std::shared_ptr<const SequenceAccess> sequence(std::size_t input) = 0;
  struct WindowValues {
    std::vector<std::shared_ptr<const void>> values;
    std::size_t centre = 0;
  };
  virtual WindowValues window(std::size_t input) = 0;
  // The node's outputs at the preceding element, by output; empty at the first.
  virtual std::vector<std::shared_ptr<const void>> prior() = 0;
  virtual const ParamValue& param(std::size_t index) = 0;
  virtual void result(std::size_t output, std::shared_ptr<const void> value) = 0;
  virtual void push(std::size_t output, std::string id, std::shared_ptr<const void> value) = 0;
  virtual Progress& progress() = 0;
};

// A node with its code.
struct NodeDeclaration {
  NodeInfo info;
  std::vector<const TypeInfo*> input_types;   // as info.inputs
  std::vector<const TypeInfo*> output_types;  // as info.outputs
  std::function<void(Call&)> run;
};

}  // namespace engine
