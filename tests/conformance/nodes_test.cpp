// SPDX-License-Identifier: Apache-2.0
// What holds for every installed node, so that nobody writes it per node. A failure names node, port and rule.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "engine/plugin/plugins.h"
#include "tests/conformance/node_samples.h"
#include "tests/conformance/rules.h"
#include "tests/support/expect_throw_text.h"

namespace {

using engine::NodeInfo;

engine::Plugins& plugins() {
  static engine::Plugins installed({FACEGRAPH_PLUGIN_DIR});
  return installed;
}

std::vector<NodeInfo> installed_nodes() {
  std::vector<NodeInfo> nodes;
  for (const std::string& name : plugins().node_names()) nodes.push_back(*plugins().find(name));
  return nodes;
}

TEST(EveryNode, IsListedWithoutAProblem) {
  for (const engine::Problem& problem : plugins().problems()) ADD_FAILURE() << problem.line();
  EXPECT_FALSE(plugins().plugin_names().empty()) << "no plugin in " << FACEGRAPH_PLUGIN_DIR;
}

TEST(EveryNode, IsDeclaredByTheRules) {
  for (const NodeInfo& node : installed_nodes())
    for (const std::string& line : conformance::broken_by_declaration(node, plugins().plugin_of(node.name)))
      ADD_FAILURE() << line;
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

// The areas' samples name nodes, parameters and inputs of today.
TEST(EveryNode, HasTheSamplesThatAreWrittenForIt) {
  const std::vector<std::string> built = plugins().plugin_names();
  const auto is_built = [&](const std::string& name) {
    return std::find(built.begin(), built.end(), name.substr(0, name.find('.'))) != built.end();
  };
  const auto expect_part = [&](const std::string& name, bool of_params, bool of_inputs) {
    if (!is_built(name)) return;
    const std::string part = name.substr(name.rfind('.') + 1);
    const NodeInfo* node = plugins().find(name.substr(0, name.rfind('.')));
    const bool found =
        node && ((of_params && node->find_param(part) >= 0) || (of_inputs && node->find_input(part) >= 0));
    EXPECT_TRUE(found) << name << ": has samples or a reason in tests/conformance/samples and does not exist";
  };
  const conformance::AreaSamples& all = conformance::all_samples();
  for (const auto& [name, maker] : all.inputs) expect_part(name, false, true);
  for (const auto& [name, length] : all.lengths) expect_part(name, false, true);
  for (const auto& [name, maker] : all.sequences) expect_part(name, false, true);
  for (const auto& [name, maker] : all.before) expect_part(name, false, true);
  for (const auto& [name, value] : all.params) expect_part(name, true, false);
  for (const auto& [name, values] : all.values) expect_part(name, true, false);
  for (const auto& [name, reason] : all.shown_elsewhere) expect_part(name, true, true);
  for (const auto& [name, reason] : all.only_refuses) expect_part(name, true, true);
  for (const auto& [node, settings] : all.settings)
    for (const auto& setting : settings)
      for (const auto& [param, value] : setting) expect_part(node + "." + param, true, false);
  for (const auto& [name, lines] : all.sins)
    EXPECT_TRUE(!is_built(name) || plugins().find(name)) << name << ": is listed with its sins and does not exist";
}

TEST(Samples, OfAnotherTypeThanTheirPortsAreRefused) {
  const conformance::Sample text = conformance::held(std::string("a"));
  EXPECT_EQ(conformance::checked_sample(text, "toy.upper.text", "text"), text.value);
  EXPECT_THROW_TEXT(conformance::checked_sample(text, "meshik.transfer_landmarks.key_shapes", "key_shapes"),
                    "the sample of meshik.transfer_landmarks.key_shapes is text, expected key_shapes");
}

// A test for each node, so that a new one has it with nothing written: EachNode.track_klt.
class KeepsTheRules : public testing::Test {
 public:
  explicit KeepsTheRules(std::string node) : node_(std::move(node)) {}
  void TestBody() override {
    if (conformance::asked_for_odd_input()) return conformance::try_odd_input(plugins(), node_);
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    conformance::Lines lines = conformance::broken_by_odd_input(std::string("EachNode.") + test.name());
    for (const std::string& line : conformance::broken_by_behaviour(plugins(), node_)) lines.push_back(line);
    const auto& sins = conformance::all_samples().sins;
    if (const auto sin = sins.find(node_); sin != sins.end()) {
      EXPECT_EQ(lines, sin->second) << node_ << ": breaks rules on purpose";
      return;
    }
    for (const std::string& line : lines) ADD_FAILURE() << line;
  }

 private:
  std::string node_;
};

const bool registered = [] {
  for (const std::string& name : plugins().node_names()) {
    if (plugins().plugin_of(name).empty()) continue;
    std::string test = name;
    std::replace(test.begin(), test.end(), '.', '_');
    testing::RegisterTest("EachNode", test.c_str(), nullptr, nullptr, __FILE__, __LINE__,
                          [name]() -> testing::Test* { return new KeepsTheRules(name); });
  }
  return true;
}();

}  // namespace
