// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "engine/describe/describe.h"

namespace engine {
namespace {

using Json = nlohmann::ordered_json;

Json binding(const char* pattern) { return {{"type", "string"}, {"pattern", pattern}}; }

Json param_schema(const ParamInfo& param) {
  Json item;
  switch (param.kind) {
    case ParamKind::boolean:
      item = {{"type", "boolean"}};
      break;
    case ParamKind::integer:
      item = {{"type", "integer"}, {"minimum", param.low}, {"maximum", param.high}};
      break;
    case ParamKind::real:
      item = {{"type", "number"}, {"minimum", param.low}, {"maximum", param.high}};
      break;
    case ParamKind::string:
      item = {{"type", "string"}};
      break;
    case ParamKind::choice:
      item = {{"enum", param.choices}};
      break;
  }
  Json value = param.list ? Json{{"type", "array"}, {"items", item}} : item;
  Json schema = {{"description", param.doc + (param.unit.empty() || param.unit == "1" ? "" : " [" + param.unit + "]")}};
  std::visit([&](const auto& initial) { schema["default"] = initial; }, param.initial);
  schema["anyOf"] = {value, binding("^\\$\\{[A-Za-z_][A-Za-z0-9_]*\\}$")};
  return schema;
}

Json node_schema(const NodeInfo& node) {
  const Json reference = {{"type", "string"}};
  Json inputs = {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
  Json required = Json::array();
  for (const InputInfo& input : node.inputs) {
    Json port = {
        {"description", input.doc + " (" + port_type(input.type.empty() ? "any" : input.type, input.depth) + ")"}};
    port["anyOf"] = {reference, {{"type", "object"}}};
    if (input.variadic) port["anyOf"].push_back({{"type", "array"}, {"items", reference}});
    inputs["properties"][input.name] = port;
    if (!input.optional) required.push_back(input.name);
  }
  if (!required.empty()) inputs["required"] = required;
  Json params = {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
  for (const ParamInfo& param : node.params) params["properties"][param.name] = param_schema(param);
  Json schema = {{"description", node.doc},
                 {"type", "object"},
                 {"additionalProperties", false},
                 {"required", required.empty() ? Json{"node"} : Json{"node", "inputs"}},
                 {"properties",
                  {{"node", {{"const", node.name}, {"description", node.doc}}},
                   {"inputs", inputs},
                   {"params", params},
                   {"overrides",
                    {{"type", "object"},
                     {"description", "Parameters for some elements: {\"17-23,40\": {...}}"},
                     {"additionalProperties", params}}}}}};
  return schema;
}

}  // namespace

std::string graph_schema(const Plugins& plugins) {
  Json definitions = Json::object();
  Json alternatives = Json::array();
  Json names = Json::array();
  for (const std::string& name : plugins.node_names()) {
    definitions[name] = node_schema(*plugins.find(name));
    alternatives.push_back({{"if", {{"properties", {{"node", {{"const", name}}}}}, {"required", {"node"}}}},
                            {"then", {{"$ref", "#/$defs/" + name}}}});
    names.push_back(name);
  }
  definitions["node"] = {{"type", "object"},
                         {"properties",
                          {{"node", {{"enum", names}}},
                           {"graph", {{"type", "string"}, {"description", "A graph file embedded as a node"}}}}},
                         {"allOf", alternatives}};
  const Json param = {{"type", "object"},
                      {"required", {"type"}},
                      {"properties",
                       {{"type", {{"enum", {"path", "integer", "real", "string", "boolean", "choice"}}}},
                        {"default", Json::object()},
                        {"optional", {{"type", "boolean"}}},
                        {"choices", {{"type", "array"}, {"items", {{"type", "string"}}}}},
                        {"doc", {{"type", "string"}}}}}};
  const Json schema = {
      {"$schema", "https://json-schema.org/draft/2020-12/schema"},
      {"title", "Facegraph graph"},
      {"type", "object"},
      {"additionalProperties", false},
      {"properties",
       {{"facegraph", {{"const", 1}}},
        {"extends",
         {{"type", "string"}, {"description", "Another graph file, over which this one is laid as a merge patch"}}},
        {"doc", {{"type", "string"}}},
        {"params", {{"type", "object"}, {"additionalProperties", param}}},
        {"inputs", {{"type", "object"}, {"additionalProperties", {{"type", "string"}}}}},
        {"nodes", {{"type", "object"}, {"additionalProperties", {{"$ref", "#/$defs/node"}}}}},
        {"outputs", {{"type", "object"}, {"additionalProperties", {{"type", "string"}}}}},
        {"run",
         {{"type", "object"}, {"properties", {{"memory", {{"type", "string"}}}, {"timeout_s", {{"type", "number"}}}}}}},
        {"sweep",
         {{"type", "object"},
          {"description", "What `facegraph sweep` varies, and the numbers that it compares; a run does not look at it"},
          {"additionalProperties", false},
          {"properties",
           {{"vary",
             {{"type", "object"},
              {"description", "\"NODE.PARAM\", \"PARAM\" or \"NODE.node\" (the kind of node), and a list of values"},
              {"additionalProperties", {{"type", "array"}, {"minItems", 1}}}}},
            {"metric",
             {{"description", "NODE.OUTPUT, or NODE.OUTPUT/PATH into its JSON form"},
              {"anyOf",
               {{{"type", "string"}}, {{"type", "array"}, {"minItems", 1}, {"items", {{"type", "string"}}}}}}}}}}}},
        {"layout", {{"type", "object"}}},
        {"$schema", {{"type", "string"}}}}},
      {"$defs", definitions}};
  return schema.dump(1);
}

}  // namespace engine
