// SPDX-License-Identifier: Apache-2.0
#include "engine/describe/view.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace engine {
namespace {

// Calls a node of one input with its default parameters.
class ViewCall final : public Call {
 public:
  ViewCall(const NodeDeclaration& node, const Value& value) : node_(node), value_(value) {}
  std::shared_ptr<const void> value(std::size_t input) override { return input == 0 ? value_.data() : nullptr; }
  std::shared_ptr<const SequenceAccess> sequence(std::size_t) override { return nullptr; }
  WindowValues window(std::size_t) override { return {}; }
  std::vector<std::shared_ptr<const void>> prior() override { return {}; }
  const ParamValue& param(std::size_t index) override { return node_.info.params[index].initial; }
  void result(std::size_t output, std::shared_ptr<const void> value) override {
    if (output == 0) file = std::static_pointer_cast<const File>(value);
  }
  void push(std::size_t, std::string, std::shared_ptr<const void>) override {}
  Progress& progress() override { return progress_; }

  std::shared_ptr<const File> file;

 private:
  const NodeDeclaration& node_;
  const Value& value_;
  Progress progress_;
};

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
    ViewCall call(node, value);
    node.run(call);
    if (!call.file) throw std::logic_error("view " + view.node + " of type " + type.name + " gives no file");
    return content_of(*call.file);
  }
  throw std::invalid_argument("a value of type " + type.name + " cannot be written as '" + suffix + "'; it can be as " +
                              known);
}

}  // namespace engine
