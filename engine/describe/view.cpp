// SPDX-License-Identifier: Apache-2.0
#include "engine/describe/view.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace engine {
namespace {

// Calls a node of single values with its default parameters; optional inputs stay unconnected.
class PlainCall final : public Call {
 public:
  PlainCall(const NodeDeclaration& node, std::vector<Value> inputs)
      : results(node.info.outputs.size()), node_(node), inputs_(std::move(inputs)) {}
  std::shared_ptr<const void> value(std::size_t input) override {
    return input < inputs_.size() ? inputs_[input].data() : nullptr;
  }
  std::shared_ptr<const SequenceAccess> sequence(std::size_t) override { return nullptr; }
  WindowValues window(std::size_t) override { return {}; }
  std::vector<std::shared_ptr<const void>> prior() override { return {}; }
  const ParamValue& param(std::size_t index) override { return node_.info.params[index].initial; }
  void result(std::size_t output, std::shared_ptr<const void> value) override {
    results[output] = Value(*node_.output_types[output], std::move(value));
  }
  void push(std::size_t, std::string, std::shared_ptr<const void>) override {}
  Progress& progress() override { return progress_; }

  std::vector<Value> results;

 private:
  const NodeDeclaration& node_;
  std::vector<Value> inputs_;
  Progress progress_;
};

// Throws where the node does not take that many single values of the type first.
void check_inputs(const NodeDeclaration& node, const std::string& type, std::size_t count, const char* purpose) {
  const std::vector<InputInfo>& inputs = node.info.inputs;
  bool fits = inputs.size() >= count;
  for (std::size_t i = 0; fits && i < inputs.size(); ++i)
    fits = i < count ? inputs[i].type == type && inputs[i].depth == 0 && !inputs[i].window : inputs[i].optional;
  if (!fits)
    throw std::logic_error(std::string(purpose) + " " + node.info.name + " of type " + type + " does not take " +
                           std::to_string(count) + " of it");
}

std::string content_of(const File& file) {
  if (file.in_memory()) return file.bytes();
  std::ifstream in(file.path(), std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + file.path());
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

}  // namespace

std::string view_value(const Value& value, const std::string& suffix, Plugins& plugins) {
  const TypeInfo& type = value.type();
  if (type.name == "file") return content_of(value.as<File>());
  if (suffix == ".json") return type.show(value.data().get()) + "\n";
  std::string known = ".json";
  for (const TypeInfo::View& view : type.views) {
    if ("." + view.suffix != suffix) {
      known += ", ." + view.suffix;
      continue;
    }
    const NodeDeclaration& node = plugins.load(view.node);
    check_inputs(node, type.name, 1, "view");
    PlainCall call(node, {value});
    node.run(call);
    if (call.results.empty() || !call.results[0] || call.results[0].type().name == type.name)
      throw std::logic_error("view " + view.node + " of type " + type.name + " gives no file");
    return view_value(call.results[0], suffix, plugins);
  }
  throw std::invalid_argument("a value of type " + type.name + " cannot be written as '" + suffix + "'; it can be as " +
                              known);
}

std::vector<NamedValue> compare_values(const Value& a, const Value& b, Plugins& plugins) {
  const TypeInfo& type = a.type();
  if (type.name != b.type().name)
    throw std::logic_error("a value of type " + type.name + " beside one of type " + b.type().name);
  if (type.difference.empty()) return {};
  const NodeDeclaration& node = plugins.load(type.difference);
  check_inputs(node, type.name, 2, "difference");
  PlainCall call(node, {a, b});
  node.run(call);
  std::vector<NamedValue> named;
  for (std::size_t o = 0; o < call.results.size(); ++o)
    if (call.results[o]) named.push_back({node.info.outputs[o].name, call.results[o]});
  return named;
}

}  // namespace engine
