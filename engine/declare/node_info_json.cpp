// SPDX-License-Identifier: Apache-2.0
#include "engine/declare/node_info_json.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace engine {
namespace {

using Json = nlohmann::ordered_json;
constexpr int format_version = 1;

constexpr std::pair<ParamKind, const char*> kind_names[] = {{ParamKind::boolean, "boolean"},
                                                            {ParamKind::integer, "integer"},
                                                            {ParamKind::real, "real"},
                                                            {ParamKind::string, "string"},
                                                            {ParamKind::choice, "choice"}};

const char* kind_name(ParamKind kind) {
  for (const auto& [value, name] : kind_names)
    if (value == kind) return name;
  return "";
}

ParamKind kind_of(const std::string& wanted) {
  for (const auto& [value, name] : kind_names)
    if (wanted == name) return value;
  throw std::runtime_error("unknown kind of parameter '" + wanted + "'");
}

ParamValue value_of(const Json& json, ParamKind kind, bool list) {
  switch (kind) {
    case ParamKind::boolean:
      if (list) return json.get<std::vector<bool>>();
      return json.get<bool>();
    case ParamKind::integer:
      if (list) return json.get<std::vector<std::int64_t>>();
      return json.get<std::int64_t>();
    case ParamKind::real:
      if (list) return json.get<std::vector<double>>();
      return json.get<double>();
    default:
      if (list) return json.get<std::vector<std::string>>();
      return json.get<std::string>();
  }
}

Json to_json(const NodeInfo& node) {
  Json json = {{"name", node.name}, {"version", node.version}, {"doc", node.doc}};
  if (node.cheap) json["cheap"] = true;
  if (node.prior) json["prior"] = true;
  if (node.memory_bytes != 0) json["memory_bytes"] = node.memory_bytes;
  if (node.threads != 1) json["threads"] = node.threads;
  json["inputs"] = Json::array();
  for (const InputInfo& input : node.inputs) {
    Json port = {{"name", input.name}, {"doc", input.doc}, {"type", input.type}, {"depth", input.depth}};
    if (input.optional) port["optional"] = true;
    if (input.window) port["window"] = {input.before, input.after};
    json["inputs"].push_back(port);
  }
  json["params"] = Json::array();
  for (const ParamInfo& param : node.params) {
    Json item = {{"name", param.name}, {"doc", param.doc}, {"kind", kind_name(param.kind)}};
    if (param.list) item["list"] = true;
    if (param.kind == ParamKind::integer || param.kind == ParamKind::real) {
      item["unit"] = param.unit;
      item["range"] = {param.low, param.high};
    }
    if (param.kind == ParamKind::choice) item["choices"] = param.choices;
    if (!param.inert.empty()) item["inert"] = param.inert;
    std::visit([&](const auto& value) { item["default"] = value; }, param.initial);
    json["params"].push_back(item);
  }
  json["outputs"] = Json::array();
  for (const OutputInfo& output : node.outputs)
    json["outputs"].push_back(
        {{"name", output.name}, {"doc", output.doc}, {"type", output.type}, {"depth", output.depth}});
  return json;
}

NodeInfo node_of(const Json& json) {
  NodeInfo node;
  node.name = json.at("name");
  node.version = json.at("version");
  node.doc = json.at("doc");
  node.cheap = json.value("cheap", false);
  node.prior = json.value("prior", false);
  node.memory_bytes = json.value("memory_bytes", std::int64_t{0});
  node.threads = json.value("threads", 1);
  for (const Json& port : json.at("inputs")) {
    InputInfo input;
    input.name = port.at("name");
    input.doc = port.at("doc");
    input.type = port.at("type");
    input.depth = port.at("depth");
    input.optional = port.value("optional", false);
    if (port.contains("window")) {
      input.window = true;
      input.before = port["window"].at(0);
      input.after = port["window"].at(1);
    }
    node.inputs.push_back(std::move(input));
  }
  for (const Json& item : json.at("params")) {
    ParamInfo param;
    param.name = item.at("name");
    param.doc = item.at("doc");
    param.kind = kind_of(item.at("kind"));
    param.list = item.value("list", false);
    param.unit = item.value("unit", std::string());
    if (item.contains("range")) {
      param.low = item["range"].at(0);
      param.high = item["range"].at(1);
    }
    if (item.contains("choices")) param.choices = item["choices"].get<std::vector<std::string>>();
    param.inert = item.value("inert", std::string());
    param.initial = value_of(item.at("default"), param.kind, param.list);
    node.params.push_back(std::move(param));
  }
  for (const Json& item : json.at("outputs"))
    node.outputs.push_back({item.at("name"), item.at("doc"), item.at("type"), item.at("depth")});
  return node;
}

}  // namespace

std::string write_node_list(const NodeList& list) {
  Json json = {{"facegraph_nodes", format_version}, {"nodes", Json::array()}, {"types", Json::array()}};
  for (const NodeInfo& node : list.nodes) json["nodes"].push_back(to_json(node));
  for (const TypeSummary& type : list.types)
    json["types"].push_back({{"name", type.name},
                             {"codec_version", type.codec_version},
                             {"doc", type.doc},
                             {"layout", type.layout},
                             {"views", type.views},
                             {"difference", type.difference}});
  return json.dump(1) + "\n";
}

NodeList read_node_list(std::string_view text) {
  try {
    const Json json = Json::parse(text);
    if (json.at("facegraph_nodes") != format_version)
      throw std::runtime_error("it is of format " + json.at("facegraph_nodes").dump() + ", expected " +
                               std::to_string(format_version));
    NodeList list;
    for (const Json& node : json.at("nodes")) list.nodes.push_back(node_of(node));
    for (const Json& type : json.at("types"))
      list.types.push_back({type.at("name"), type.at("codec_version"), type.at("doc"), type.at("layout"),
                            type.at("views").get<std::vector<std::pair<std::string, std::string>>>(),
                            type.value("difference", std::string())});
    return list;
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(std::string("it is no node list: ") + error.what());
  }
}

}  // namespace engine
