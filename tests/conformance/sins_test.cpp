// SPDX-License-Identifier: Apache-2.0
// A plugin whose nodes each break one rule: every one is found, by its rule and with its name.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/conformance/rules.h"

namespace {

using conformance::Lines;

engine::Plugins& sinners() {
  static engine::Plugins plugins({FACEGRAPH_SINS_DIR});
  return plugins;
}

Lines found(const std::string& node) {
  Lines lines = conformance::broken_by_declaration(*sinners().find(node), "sins");
  for (const std::string& line : conformance::broken_by_behaviour(sinners(), node)) lines.push_back(line);
  return lines;
}

struct Sin {
  std::string node;
  Lines lines;
};

TEST(Sins, AreFoundByTheirRuleAndNamed) {
  const std::vector<Sin> sins = {
      {"sins.count_calls", {"sins.count_calls: result: same result twice: the second differs"}},
      {"sins.read_clock", {"sins.read_clock: result: same result twice: the second differs"}},
      {"sins.draw_unseeded", {"sins.draw_unseeded: result: same result twice: the second differs"}},
      {"sins.sum_by_threads", {"sins.sum_by_threads: result: same result with 1 and 4 threads: with 1 it differs"}},
      {"sins.ignore_parameter",
       {"sins.ignore_parameter: parameter amount: every parameter counts: no value changes the result, and it is not "
        "declared inert{\"why\"}"}},
      {"sins.ignore_input", {"sins.ignore_input: input other: every input counts: no sample changes the result"}},
      {"sins.only_refuse",
       {"sins.only_refuse: parameter most: every parameter counts: some values are refused, none changes the result",
        "sins.only_refuse: input other: every input counts: some samples are refused, none changes the result"}},
      {"sins.mutate_input", {"sins.mutate_input: input number: inputs unchanged: it was changed by the call"}},
      {"sins.open_undeclared", {"sins.open_undeclared: call: only its inputs are read: it opened /etc/os-release"}},
      {"sins.name_without_unit", {"sins.name_without_unit: parameter radius: its name does not end with its unit, mm"}},
      {"sins.swap_units", {"sins.swap_units: parameter window_s: its name promises s, its unit is ms"}},
      {"sins.default_out_of_range", {"sins.default_out_of_range: parameter share: default 2 is outside [0, 1]"}},
      {"sins.swap_names", {}},  // nothing but its source tells: tests/arch/declarations_test.cpp
      {"sins.say_nothing",
       {"sins.say_nothing: no doc", "sins.say_nothing: input number: no doc", "sins.say_nothing: output same: no doc"}},
  };
  for (const Sin& sin : sins) {
    SCOPED_TRACE(sin.node);
    EXPECT_EQ(found(sin.node), sin.lines);
  }
}

// Each is tried in a process of its own.
TEST(Sins, CrashOnEmptyIsSurvivedAndNamed) {
  if (conformance::asked_for_odd_input()) return conformance::try_odd_input(sinners(), "sins.crash_on_empty");
  const Lines lines = conformance::broken_by_odd_input("Sins.CrashOnEmptyIsSurvivedAndNamed");
  ASSERT_EQ(lines.size(), 1u);
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  EXPECT_NE(lines[0].find("no element in the sequence: never crashes: "), std::string::npos) << lines[0];
#else
  EXPECT_EQ(lines[0],
            "CrashOnEmptyIsSurvivedAndNamed: input numbers: no element in the sequence: never crashes: ended by signal "
            "Segmentation fault");
#endif
}

TEST(Sins, AnErrorInALibrarysWordsIsNamed) {
  if (conformance::asked_for_odd_input()) return conformance::try_odd_input(sinners(), "sins.hide_the_reason");
  const Lines lines = conformance::broken_by_odd_input("Sins.AnErrorInALibrarysWordsIsNamed");
  ASSERT_EQ(lines.size(), 2u);  // empty, and one character
  EXPECT_EQ(lines[0].find("AnErrorInALibrarysWordsIsNamed: input text: empty: a named error or a report: "), 0u)
      << lines[0];
}

TEST(Sins, AreAllLookedAt) { EXPECT_EQ(sinners().node_names().size(), 16u + engine::structural_nodes().size()); }

}  // namespace
