// SPDX-License-Identifier: Apache-2.0
// A store keeps to its limit without being told.
#include "tests/end_to_end/command.h"

namespace {

class StoreLimit : public test::CommandTest {
 protected:
  // Publishes a text of so many MB, which lies in the store as it is.
  test::Ended run_with(const std::string& size_mb, const std::string& limit) const {
    write("page.json", R"({"facegraph": 1,
"nodes": {"numbers": {"node": "toy.count_up", "params": {"count": 1}},
          "blob": {"node": "toy.blob", "inputs": {"number": "numbers[0]"}, "params": {"size_mb": 1}},
          "page": {"node": "toy.write_text", "inputs": {"text": "blob"}}},
"outputs": {"page.txt": "page"}})");
    return command({"run", "page.json", "--set", "blob.size_mb=" + size_mb, "--out", "out", "--store-limit", limit});
  }
};

TEST_F(StoreLimit, ARunThatEndsAboveItRemovesWhatWasNotUsedForLongest) {
  EXPECT_EQ(run_with("2", "4MB").said("the store was over "), std::vector<std::string>{});
  const std::vector<std::string> told = run_with("3", "4MB").said("the store was over 4.0 MB: ");
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(told[0].starts_with("2.0 MB removed that were not used for longest, 3.0 MB left")) << told[0];
  EXPECT_EQ(run_with("3", "4MB").said("0 run, ").size(), 1u);  // what was just made is there
}

TEST_F(StoreLimit, IsAnAmount) {
  const test::Ended ended = run_with("1", "lots");
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.output,
            "error: command line: --store-limit lots: expected an amount such as \"500MB\" or \"8GB\" (B, kB, MB, GB, "
            "TB)\n");
}

}  // namespace
