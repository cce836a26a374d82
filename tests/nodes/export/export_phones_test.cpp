// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "nodes/base/phones_json.h"
#include "nodes/base/text_grid.h"
#include "nodes/export/export_phones_json.h"
#include "nodes/export/export_text_grid.h"

namespace face::exports {
namespace {

Phones john() {
  return {{{"SIL", 0, 0.5, "", 0},
           {"JH", 0.5, 0.6, "john", -0.1},
           {"AA", 0.6, 0.8, "john", -0.2},
           {"N", 0.8, 0.9, "john", 0}},
          0.9,
          true};
}

TEST(ExportPhonesJson, ComesBackAsItWas) {
  const engine::File file = export_phones_json(john());
  EXPECT_EQ(file.suffix(), ".json");
  const Phones back = parse_phones_json(file.bytes(), "test");
  ASSERT_EQ(back.phones.size(), 4u);
  EXPECT_EQ(back.phones[1].label, "JH");
  EXPECT_EQ(back.phones[1].word, "john");
  EXPECT_EQ(back.phones[1].score, -0.1);
  EXPECT_EQ(back.phones[2].end_s, 0.8);
}

TEST(ExportTextGrid, HoldsWordsAndPhones) {
  const engine::File file = export_text_grid(john());
  EXPECT_EQ(file.suffix(), ".TextGrid");
  const TextGrid grid = parse_text_grid(file.bytes(), "test");
  ASSERT_EQ(grid.tiers.size(), 2u);
  EXPECT_EQ(grid.tiers[0].name, "words");
  EXPECT_EQ(grid.tiers[0].intervals.size(), 2u);  // silence, john
  EXPECT_EQ(grid.tiers[1].name, "phones");
  EXPECT_EQ(grid.tiers[1].intervals.size(), 4u);
  EXPECT_EQ(grid.end_s, 0.9);
}

}  // namespace
}  // namespace face::exports
