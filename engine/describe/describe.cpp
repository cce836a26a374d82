// SPDX-License-Identifier: Apache-2.0
#include "engine/describe/describe.h"

#include <algorithm>
#include <map>

namespace engine {
namespace {

std::string shown_type(const InputInfo& input) {
  std::string text = port_type(input.type.empty() ? "any" : input.type, input.depth);
  if (input.window)
    text += " with " + std::to_string(input.before) + " before and " + std::to_string(input.after) + " after";
  if (input.optional) text += ", optional";
  if (input.variadic) text += ", one or more";
  return text;
}

std::string limits(const ParamInfo& param) {
  if (param.kind == ParamKind::integer || param.kind == ParamKind::real) {
    const auto number = [&](double value) {
      return param.kind == ParamKind::integer ? to_text(static_cast<std::int64_t>(value)) : to_text(value);
    };
    return number(param.low) + " to " + number(param.high) + (param.unit == "1" ? "" : " " + param.unit);
  }
  std::string text;
  for (const std::string& choice : param.choices) text += (text.empty() ? "" : ", ") + choice;
  return text;
}

const char* kind_word(const ParamInfo& param) {
  switch (param.kind) {
    case ParamKind::boolean:
      return param.list ? "list of true or false" : "true or false";
    case ParamKind::integer:
      return param.list ? "list of integers" : "integer";
    case ParamKind::real:
      return param.list ? "list of numbers" : "number";
    case ParamKind::string:
      return param.list ? "list of texts" : "text";
    case ParamKind::choice:
      return param.list ? "list of choices" : "choice";
  }
  return "";
}

std::string in_cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text;
}

}  // namespace

std::string port_type(const std::string& type, int depth) {
  std::string text = type;
  for (int i = 0; i < depth; ++i) text = "Seq<" + text + ">";
  return text;
}

std::string describe_node(const NodeInfo& node, const std::string& plugin) {
  std::string text = node.name + "\n  " + node.doc + "\n  ";
  text += plugin.empty() ? "of the engine" : "plugin " + plugin + ", version " + std::to_string(node.version);
  if (node.cheap) text += "; cheap: its values are not stored";
  if (node.prior) text += "; runs element after element";
  text += "\n\ninputs\n";
  for (const InputInfo& input : node.inputs)
    text += "  " + input.name + "  (" + shown_type(input) + ")\n      " + input.doc + "\n";
  if (!node.params.empty()) text += "\nparameters\n";
  for (const ParamInfo& param : node.params) {
    const std::string bounds = limits(param);
    text += "  " + param.name + " = " + to_text(param.initial) + "  (" + kind_word(param) +
            (bounds.empty() ? "" : ", " + bounds) + ")\n      " + param.doc + "\n";
  }
  text += "\noutputs\n";
  for (const OutputInfo& output : node.outputs)
    text += "  " + output.name + "  (" + port_type(output.type.empty() ? "as the input" : output.type, output.depth) +
            ")\n      " + output.doc + "\n";
  return text;
}

std::string describe_type(const TypeSummary& type, const Plugins& plugins) {
  std::string text = type.name + "\n  " + type.doc + "\n";
  for (const auto& [suffix, node] : type.views) text += "  view: ." + suffix + " by " + node + "\n";
  if (!type.difference.empty()) text += "  difference: by " + type.difference + "\n";
  std::string makers, takers;
  for (const std::string& name : plugins.node_names()) {
    const NodeInfo& node = *plugins.find(name);
    const auto has = [&](const auto& ports) {
      return std::any_of(ports.begin(), ports.end(), [&](const auto& port) { return port.type == type.name; });
    };
    if (has(node.outputs)) makers += "  " + name + "\n";
    if (has(node.inputs)) takers += "  " + name + "\n";
  }
  return text + "\nmade by\n" + makers + "\ntaken by\n" + takers;
}

std::string node_reference(const Plugins& plugins) {
  std::map<std::string, std::vector<const NodeInfo*>> areas;
  for (const std::string& name : plugins.node_names()) {
    const std::string plugin = plugins.plugin_of(name);
    areas[plugin.empty() ? "engine" : plugin].push_back(plugins.find(name));
  }
  std::string text = "# Nodes\n\nMade from the nodes' own declarations by `facegraph nodes --markdown`.\n";
  for (const auto& [area, nodes] : areas) {
    text += "\n## " + area + "\n";
    for (const NodeInfo* node : nodes) {
      text += "\n### " + node->name + "\n\n" + node->doc + "\n\n| | name | type | |\n|---|---|---|---|\n";
      for (const InputInfo& input : node->inputs)
        text += "| input | `" + input.name + "` | " + in_cell(shown_type(input)) + " | " + in_cell(input.doc) + " |\n";
      for (const ParamInfo& param : node->params) {
        const std::string bounds = limits(param);
        text += "| parameter | `" + param.name + "` = " + in_cell(to_text(param.initial)) + " | " + kind_word(param) +
                (bounds.empty() ? "" : ", " + in_cell(bounds)) + " | " + in_cell(param.doc) + " |\n";
      }
      for (const OutputInfo& output : node->outputs)
        text += "| output | `" + output.name + "` | " +
                in_cell(port_type(output.type.empty() ? "as the input" : output.type, output.depth)) + " | " +
                in_cell(output.doc) + " |\n";
    }
  }
  return text;
}

}  // namespace engine
