// SPDX-License-Identifier: Apache-2.0
// What holds for every installed node, so that nobody writes it per node. A failure names node, port and rule.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "engine/plugin/plugins.h"

namespace {

using engine::NodeInfo;
using engine::ParamInfo;
using engine::ParamKind;

engine::Plugins& plugins() {
  static engine::Plugins installed({FACEGRAPH_PLUGIN_DIR});
  return installed;
}

std::vector<NodeInfo> installed_nodes() {
  std::vector<NodeInfo> nodes;
  for (const std::string& name : plugins().node_names()) nodes.push_back(*plugins().find(name));
  return nodes;
}

bool is_number(const ParamInfo& param) { return param.kind == ParamKind::integer || param.kind == ParamKind::real; }

// The numbers in a parameter's default, whether it is a list or not.
std::vector<double> numbers_of(const engine::ParamValue& value) {
  std::vector<double> numbers;
  std::visit(
      [&](const auto& held) {
        using T = std::decay_t<decltype(held)>;
        if constexpr (std::is_same_v<T, std::int64_t> || std::is_same_v<T, double>)
          numbers.push_back(static_cast<double>(held));
        else if constexpr (std::is_same_v<T, std::vector<std::int64_t>> || std::is_same_v<T, std::vector<double>>)
          for (const auto element : held) numbers.push_back(static_cast<double>(element));
      },
      value);
  return numbers;
}

std::vector<std::string> texts_of(const engine::ParamValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return {*text};
  if (const auto* list = std::get_if<std::vector<std::string>>(&value)) return *list;
  return {};
}

// Which unit a name promises by its end: radius_px -> px. Empty where none.
std::string unit_of_name(const std::string& name) {
  static const std::map<std::string, std::string> units = {
      {"px", "px"}, {"mm", "mm"},       {"cm", "cm"},     {"m", "m"},      {"s", "s"},   {"ms", "ms"},
      {"hz", "Hz"}, {"khz", "kHz"},     {"deg", "deg"},   {"rad", "rad"},  {"db", "dB"}, {"mb", "MB"},
      {"kb", "kB"}, {"bytes", "bytes"}, {"percent", "%"}, {"seconds", "s"}};
  const std::size_t per = name.find("_per_");
  if (per != std::string::npos) {
    const std::size_t before = name.rfind('_', per - 1);
    const std::string above =
        before == std::string::npos ? name.substr(0, per) : name.substr(before + 1, per - before - 1);
    return above + "/" + name.substr(per + 5);
  }
  const auto found = units.find(name.substr(name.rfind('_') + 1));
  return found == units.end() ? std::string() : found->second;
}

TEST(EveryNode, IsListedWithoutAProblem) {
  for (const engine::Problem& problem : plugins().problems()) ADD_FAILURE() << problem.line();
  EXPECT_FALSE(plugins().plugin_names().empty()) << "no plugin in " << FACEGRAPH_PLUGIN_DIR;
}

TEST(EveryNode, SaysWhatItDoesAndWhatItsPortsAndParametersAre) {
  for (const NodeInfo& node : installed_nodes()) {
    EXPECT_FALSE(node.doc.empty()) << node.name << ": no doc";
    for (const auto& input : node.inputs)
      EXPECT_FALSE(input.doc.empty()) << node.name << ": input " << input.name << " has no doc";
    for (const auto& param : node.params)
      EXPECT_FALSE(param.doc.empty()) << node.name << ": parameter " << param.name << " has no doc";
    for (const auto& output : node.outputs)
      EXPECT_FALSE(output.doc.empty()) << node.name << ": output " << output.name << " has no doc";
    EXPECT_FALSE(node.outputs.empty()) << node.name << ": no output";
  }
}

TEST(EveryNode, IsNamedByItsPluginAndAVerbOrNoun) {
  const std::regex rule("[a-z][a-z0-9]*\\.[a-z][a-z0-9]*(_[a-z0-9]+)*");
  for (const NodeInfo& node : installed_nodes()) {
    const std::string plugin = plugins().plugin_of(node.name);
    if (plugin.empty()) continue;  // the engine's own
    EXPECT_TRUE(std::regex_match(node.name, rule)) << node.name << ": no area.verb_noun or area.noun";
    EXPECT_TRUE(node.name.starts_with(plugin + ".")) << node.name << ": is in plugin " << plugin;
    EXPECT_GE(node.version, 1) << node.name << ": version";
  }
}

TEST(EveryNode, NamesItsPortsInSnakeCaseAndOnce) {
  const std::regex rule("[a-z][a-z0-9]*(_[a-z0-9]+)*");
  for (const NodeInfo& node : installed_nodes()) {
    std::map<std::string, int> inputs, outputs;
    for (const auto& input : node.inputs) ++inputs[input.name];
    for (const auto& param : node.params) ++inputs[param.name];
    for (const auto& output : node.outputs) ++outputs[output.name];
    for (const auto* names : {&inputs, &outputs})
      for (const auto& [name, count] : *names) {
        EXPECT_TRUE(std::regex_match(name, rule)) << node.name << ": " << name << " is not snake_case";
        EXPECT_EQ(count, 1) << node.name << ": " << name << " is declared more than once";
      }
  }
}

TEST(EveryNode, HasUnitsThatAgreeWithTheNamesOfItsParameters) {
  for (const NodeInfo& node : installed_nodes())
    for (const ParamInfo& param : node.params) {
      const std::string promised = unit_of_name(param.name);
      if (!is_number(param)) {
        EXPECT_EQ(param.unit, "") << node.name << ": parameter " << param.name << " is no number and has a unit";
        continue;
      }
      EXPECT_NE(param.unit, "") << node.name << ": parameter " << param.name
                                << " has no unit (\"1\" where dimensionless)";
      if (promised.empty()) {
        // Compound units such as 1/px^2 have no suffix.
        EXPECT_TRUE(param.unit == "1" || param.unit.find_first_of("/^") != std::string::npos)
            << node.name << ": parameter " << param.name << " in " << param.unit << " does not name its unit";
      } else if (promised.find('/') != std::string::npos) {
        std::string unit = param.unit;
        unit.erase(std::remove(unit.begin(), unit.end(), ' '), unit.end());
        EXPECT_EQ(unit.substr(unit.find('/')), promised.substr(promised.find('/')))
            << node.name << ": parameter " << param.name << " in " << param.unit;
      } else {
        EXPECT_EQ(param.unit, promised) << node.name << ": parameter " << param.name << " in " << param.unit;
      }
    }
}

TEST(EveryNode, HasDefaultsThatItsParametersAllow) {
  for (const NodeInfo& node : installed_nodes())
    for (const ParamInfo& param : node.params) {
      const std::string where = node.name + ": parameter " + param.name;
      if (is_number(param)) {
        EXPECT_LT(param.low, param.high) << where << ": empty range";
        for (const double number : numbers_of(param.initial))
          EXPECT_TRUE(number >= param.low && number <= param.high)
              << where << ": default " << number << " is outside [" << param.low << ", " << param.high << "]";
      }
      if (param.kind == ParamKind::choice) {
        EXPECT_GE(param.choices.size(), 2u) << where << ": nothing to choose";
        for (const std::string& text : texts_of(param.initial))
          EXPECT_TRUE(std::find(param.choices.begin(), param.choices.end(), text) != param.choices.end())
              << where << ": default \"" << text << "\" is none of its choices";
      }
    }
}

TEST(EveryNode, TakesAndGivesTypesThatAPluginOrTheEngineDeclares) {
  const std::set<std::string> builtin = {"file", "text", "number", "integer", "flag"};
  const auto known = [&](const std::string& type) {
    return type.empty() || builtin.count(type) || plugins().types().count(type) || plugins().load_type(type);
  };
  for (const NodeInfo& node : installed_nodes()) {
    for (const auto& input : node.inputs)
      EXPECT_TRUE(known(input.type)) << node.name << ": input " << input.name << " takes unknown type " << input.type;
    for (const auto& output : node.outputs)
      EXPECT_TRUE(known(output.type)) << node.name << ": output " << output.name << " gives unknown type "
                                      << output.type;
  }
}

TEST(EveryNode, ComesBackFromItsListUnchanged) {
  for (const NodeInfo& node : installed_nodes()) {
    const std::string text = engine::write_node_list({{node}, {}});
    EXPECT_EQ(engine::write_node_list(engine::read_node_list(text)), text) << node.name << ": round trip through JSON";
  }
}

TEST(EveryNode, IsInItsLibraryAsTheListBesideItSays) {
  for (const std::string& plugin : plugins().plugin_names()) {
    const std::string library = std::string(FACEGRAPH_PLUGIN_DIR) + "/" + plugin + ".so";
    const engine::NodeList list = engine::list_plugin(library);
    const std::string text = engine::write_node_list(list);
    EXPECT_EQ(engine::write_node_list(engine::read_node_list(text)), text) << plugin << ": round trip through JSON";
    for (const NodeInfo& node : list.nodes) {
      const NodeInfo* listed = plugins().find(node.name);
      ASSERT_NE(listed, nullptr) << node.name << ": is in " << plugin << ".so but not in its list";
      EXPECT_EQ(engine::write_node_list({{*listed}, {}}), engine::write_node_list({{node}, {}})) << node.name;
    }
  }
}

}  // namespace
