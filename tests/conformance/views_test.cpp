// SPDX-License-Identifier: Apache-2.0
// What value types name to be shown and compared by is there, takes them, and says something.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/describe/view.h"
#include "engine/plugin/plugins.h"
#include "tests/support/samples.h"

namespace conformance {
namespace {

engine::Plugins& installed() {
  static engine::Plugins plugins({FACEGRAPH_PLUGIN_DIR});
  return plugins;
}

engine::Value sample_value(const std::string& type, int variant) {
  const engine::TypeInfo* info = installed().load_type(type);
  const auto data = info ? test::sample(type, variant) : nullptr;
  return data ? engine::Value(*info, data) : engine::Value();
}

TEST(Types, AreShownByTheirViews) {
  std::size_t shown = 0;
  for (const auto& [name, summary] : installed().types())
    for (const auto& [suffix, node] : summary.views) {
      ASSERT_NE(installed().find(node), nullptr) << name << ": its view " << node << " is not there";
      const engine::Value value = sample_value(name, 0);
      if (!value) continue;
      const std::string bytes = engine::view_value(value, "." + suffix, installed());
      EXPECT_GT(bytes.size(), 30u) << name << " as ." << suffix;
      if (suffix == "png") {
        EXPECT_EQ(bytes.substr(1, 3), "PNG") << name;
      }
      ++shown;
    }
  EXPECT_GE(shown, 10u);
}

TEST(Types, AreComparedByTheirDifferences) {
  std::size_t compared = 0;
  for (const auto& [name, summary] : installed().types()) {
    if (summary.difference.empty()) continue;
    ASSERT_NE(installed().find(summary.difference), nullptr) << name << ": " << summary.difference << " is not there";
    const engine::Value a = sample_value(name, 0), b = sample_value(name, 1);
    if (!a || !b) continue;
    const auto first_number = [&](const engine::Value& x, const engine::Value& y) {
      const auto said = engine::compare_values(x, y, installed());
      EXPECT_FALSE(said.empty()) << name;
      const auto json = nlohmann::json::parse(said.at(0).value.type().show(said.at(0).value.data().get()));
      EXPECT_TRUE(json.contains("columns") && json.contains("rows") && !json["rows"].empty())
          << name << ": the first output of " << summary.difference << " is no table with a row that sums up";
      return json["rows"][0]["values"][0];
    };
    const auto none = first_number(a, a), some = first_number(a, b);
    if (name != "phones") {  // counts boundaries first
      EXPECT_EQ(none, 0) << name;
      EXPECT_GT(some, 0) << name;
    }
    ++compared;
  }
  EXPECT_GE(compared, 10u);
}

TEST(Types, SayWhereTheyCannotBeShownOrCompared) {
  const engine::Value timeline = sample_value("timeline", 0);
  ASSERT_TRUE(timeline);
  EXPECT_TRUE(engine::compare_values(timeline, timeline, installed()).empty());
  try {
    engine::view_value(timeline, ".png", installed());
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "a value of type timeline cannot be written as '.png'; it can be as .json");
  }
  EXPECT_THROW(engine::compare_values(timeline, sample_value("image", 0), installed()), std::logic_error);
}

}  // namespace
}  // namespace conformance
