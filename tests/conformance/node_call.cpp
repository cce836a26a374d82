// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/node_call.h"

#include <fstream>
#include <iterator>

#include "engine/port.h"
#include "tests/support/toy_run.h"

namespace conformance {
namespace {

class Elements final : public engine::SequenceAccess {
 public:
  explicit Elements(const std::vector<AnyValue>& values) : values_(values) {}
  std::size_t size() const override { return values_.size(); }
  std::string id(std::size_t index) const override { return std::to_string(index); }
  std::shared_ptr<const void> load(std::size_t index) const override { return values_.at(index); }
  std::shared_ptr<const engine::SequenceAccess> inner(std::size_t) const override {
    throw std::logic_error("samples of nested sequences are not made");
  }

 private:
  const std::vector<AnyValue>& values_;
};

class MemoryCall final : public engine::Call, public engine::Progress {
 public:
  MemoryCall(const engine::NodeDeclaration& node, const PortValues& inputs, const Params& params,
             std::vector<AnyValue> prior)
      : node_(node), inputs_(inputs), params_(params), prior_(std::move(prior)) {
    values.resize(node.info.outputs.size());
    ids.resize(values.size());
  }
  AnyValue value(std::size_t input) override {
    const PortValue& given = inputs_[input];
    if (given.absent) return nullptr;
    return prior_.empty() && node_.info.prior && given.before ? given.before : given.value;
  }
  std::shared_ptr<const engine::SequenceAccess> sequence(std::size_t input) override {
    return inputs_[input].absent ? nullptr : std::make_shared<Elements>(inputs_[input].elements);
  }
  WindowValues window(std::size_t input) override {
    const engine::InputInfo& port = node_.info.inputs[input];
    std::vector<AnyValue> elements = inputs_[input].elements;
    const std::size_t last = elements.empty() ? 0 : elements.size() - 1;
    std::size_t centre = port.before == 0 ? 0 : port.after == 0 ? last : elements.size() / 2;
    if (node_.info.prior && prior_.empty() && centre > 0) {  // about the preceding element
      elements.pop_back();
      --centre;
    }
    return {elements, centre};
  }
  std::vector<AnyValue> prior() override { return prior_; }
  const engine::ParamValue& param(std::size_t index) override { return params_[index]; }
  void result(std::size_t output, AnyValue value) override { values[output] = {std::move(value)}; }
  void push(std::size_t output, std::string id, AnyValue value) override {
    ids[output] += id + "/";
    values[output].push_back(std::move(value));
  }
  engine::Progress& progress() override { return *this; }
  std::string scratch_folder() override { return scratch_.path().string(); }

  std::vector<std::vector<AnyValue>> values;
  std::vector<std::string> ids;

 private:
  const engine::NodeDeclaration& node_;
  const PortValues& inputs_;
  const Params& params_;
  const std::vector<AnyValue> prior_;
  test::TemporaryFolder scratch_;
};

std::string content_of(const engine::File& file) {
  if (file.in_memory()) return file.bytes();
  if (file.is_folder()) {
    std::string all;
    for (const auto& entry : file.entries()) all += entry.name + "\n" + content_of(engine::File::at(entry.path));
    return all;
  }
  std::ifstream in(file.path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

engine::Digest digest_of_value(const engine::TypeInfo& type, const AnyValue& value) {
  if (!value) return {};
  if (type.name == "file") {
    const auto& file = *static_cast<const engine::File*>(value.get());
    return engine::digest_of(file.suffix() + "\n" + content_of(file));
  }
  engine::Bytes bytes;
  engine::ByteWriter writer(bytes);
  type.encode(value.get(), writer);
  return engine::digest_of(bytes);
}

Params defaults_of(const engine::NodeInfo& info) {
  Params params;
  for (const engine::ParamInfo& param : info.params) params.push_back(param.initial);
  return params;
}

Outcome call_node(const engine::NodeDeclaration& node, const PortValues& inputs, const Params& params) {
  Outcome outcome;
  std::vector<AnyValue> prior;
  try {
    for (int element = 0; element < (node.info.prior ? 2 : 1); ++element) {
      MemoryCall call(node, inputs, params, prior);
      node.run(call);
      prior.clear();
      for (std::size_t o = 0; o < call.values.size(); ++o) {
        outcome.outputs.push_back(engine::digest_of(call.ids[o]));
        for (const AnyValue& value : call.values[o])
          outcome.outputs.push_back(digest_of_value(*node.output_types[o], value));
        prior.push_back(call.values[o].empty() ? nullptr : call.values[o][0]);
      }
      // A file in the scratch folder goes with the call.
      for (std::size_t o = 0; o < call.values.size(); ++o)
        if (node.output_types[o]->name == "file")
          for (AnyValue& value : call.values[o]) {
            const auto& file = *static_cast<const engine::File*>(value.get());
            value = std::make_shared<const engine::File>(engine::File::from_bytes(content_of(file), file.suffix()));
          }
      outcome.values = std::move(call.values);
    }
  } catch (const std::exception& error) {
    outcome.threw = true;
    outcome.what = error.what();
    outcome.no_exception = outcome.what.empty();
  } catch (...) {
    outcome.threw = outcome.no_exception = true;
  }
  if (outcome.threw) outcome.outputs.clear();
  return outcome;
}

}  // namespace conformance
