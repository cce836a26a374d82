// SPDX-License-Identifier: Apache-2.0
// Descriptions of the toy plugin's nodes, made by hand, and a catalogue that holds them and the engine's own nodes:
// what a graph is read against where no plugin is loaded.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "engine/declare/node_info.h"
#include "engine/graph/graph.h"

namespace test {

inline engine::InputInfo toy_input(std::string name, std::string type, int depth = 0, bool optional = false) {
  engine::InputInfo input;
  input.name = std::move(name);
  input.type = std::move(type);
  input.depth = depth;
  input.optional = optional;
  return input;
}

inline engine::OutputInfo toy_output(std::string name, std::string type, int depth = 0) {
  engine::OutputInfo output;
  output.name = std::move(name);
  output.type = std::move(type);
  output.depth = depth;
  return output;
}

inline engine::ParamInfo toy_param(std::string name, engine::ParamKind kind, engine::ParamValue initial, double low = 0,
                                   double high = 0) {
  engine::ParamInfo param;
  param.name = std::move(name);
  param.kind = kind;
  param.initial = std::move(initial);
  param.low = low;
  param.high = high;
  if (kind == engine::ParamKind::integer || kind == engine::ParamKind::real) param.unit = "1";
  return param;
}

inline engine::NodeInfo toy_node(std::string name, std::vector<engine::InputInfo> inputs,
                                 std::vector<engine::ParamInfo> params, std::vector<engine::OutputInfo> outputs) {
  engine::NodeInfo info;
  info.name = std::move(name);
  info.inputs = std::move(inputs);
  info.params = std::move(params);
  info.outputs = std::move(outputs);
  return info;
}

class ToyCatalogue {
 public:
  ToyCatalogue() {
    using engine::ParamKind;
    nodes_ = engine::structural_nodes();
    nodes_.push_back(toy_node("toy.read_text", {toy_input("file", "file")}, {}, {toy_output("text", "text")}));
    nodes_.push_back(toy_node("toy.add", {toy_input("a", "number"), toy_input("b", "number", 0, true)},
                              {toy_param("amount", ParamKind::real, 0.0, -1000, 1000)}, {toy_output("sum", "number")}));
    nodes_.push_back(toy_node("toy.concat", {toy_input("texts", "text", 1)},
                              {toy_param("separator", ParamKind::string, std::string(" "))},
                              {toy_output("text", "text")}));
    nodes_.push_back(toy_node("toy.repeat", {toy_input("text", "text")},
                              {toy_param("times", ParamKind::integer, std::int64_t{2}, 1, 1000)},
                              {toy_output("texts", "text", 1)}));
    engine::InputInfo values = toy_input("values", "number");
    values.window = true;
    values.before = values.after = 2;
    nodes_.push_back(toy_node("toy.window_mean", {values}, {}, {toy_output("mean", "number")}));
    nodes_.push_back(toy_node("toy.length", {toy_input("text", "text")}, {}, {toy_output("length", "number")}));
    nodes_.push_back(toy_node("toy.running_sum", {toy_input("value", "number")}, {}, {toy_output("total", "number")}));
    nodes_.back().prior = true;
    engine::ParamInfo mode = toy_param("mode", ParamKind::choice, std::string("upper"));
    mode.choices = {"upper", "lower", "title"};
    nodes_.push_back(toy_node("toy.upper", {toy_input("text", "text")}, {mode}, {toy_output("changed", "text")}));
    nodes_.push_back(toy_node("toy.write_text", {toy_input("text", "text")}, {}, {toy_output("file", "file")}));
  }

  void add(engine::NodeInfo info) { nodes_.push_back(std::move(info)); }

  // Valid as long as the catalogue.
  engine::GraphContext context() const {
    engine::GraphContext context;
    context.find_node = [this](std::string_view name) -> const engine::NodeInfo* {
      for (const engine::NodeInfo& info : nodes_)
        if (info.name == name) return &info;
      return nullptr;
    };
    context.node_names = [this] {
      std::vector<std::string> names;
      for (const engine::NodeInfo& info : nodes_) names.push_back(info.name);
      return names;
    };
    context.absent_plugin = [](std::string_view name) -> std::string {
      return name.starts_with("gone.") ? "its plugin gone.so was built for another engine" : "";
    };
    return context;
  }

 private:
  std::vector<engine::NodeInfo> nodes_;
};

}  // namespace test
