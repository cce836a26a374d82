// SPDX-License-Identifier: Apache-2.0
// The installed tree: the command in it, and a plugin that is built from it alone, outside the project.
#include <gtest/gtest.h>

#include "tests/end_to_end/command.h"

namespace {

namespace fs = std::filesystem;
using test::read_file;

const fs::path source = FACEGRAPH_SOURCE_DIR;
const fs::path build = fs::path(FACEGRAPH_PLUGIN_DIR).parent_path().parent_path().parent_path();

class Sdk : public test::CommandTest {
 protected:
  void SetUp() override {
    for (const char* area : {"decode", "phantom", "speech", "trajectory", "track", "render", "export", "toy"})
      if (!fs::exists(fs::path(FACEGRAPH_PLUGIN_DIR) / (std::string(area) + ".nodes.json")))
        GTEST_SKIP() << "needs every plugin: build all of the project";
    must({"cmake", "--install", build.string(), "--prefix", path("sdk")});
  }
  // A program that is looked up as a person's shell does.
  void must(const test::Words& words) const {
    const test::Ended ended = wait(start(words, "/usr/bin/env"));
    ASSERT_EQ(ended.code, 0) << ended.output;
  }
};

TEST_F(Sdk, AnExampleIsBuiltFromItAndRuns) {
  // The sources alone, in a folder that has nothing else of the project near.
  for (const char* name : {"CMakeLists.txt", "list_pauses.cpp", "pauses.json"}) {
    fs::create_directories(folder() / "example");
    fs::copy_file(source / "plugins" / "example" / name, folder() / "example" / name);
  }
  must({"cmake", "-S", path("example"), "-B", path("built"), "-G", "Ninja", "-DCMAKE_PREFIX_PATH=" + path("sdk")});
  must({"cmake", "--build", path("built")});
  EXPECT_TRUE(exists("built/example.nodes.json"));

  // Also after the installed tree was moved.
  fs::rename(folder() / "sdk", folder() / "moved");
  fs::create_directories(folder() / "sdk");
  fs::rename(folder() / "moved", folder() / "sdk" / "there");
  write("phones.json",
        R"([{"phone": "SIL", "start_s": 0, "end_s": 0.5}, {"phone": "AA", "start_s": 0.5, "end_s": 0.75, "word": "a"},
      {"phone": "SIL", "start_s": 0.75, "end_s": 1}, {"phone": "AA", "start_s": 1, "end_s": 1.25, "word": "a"},
      {"phone": "SIL", "start_s": 1.25, "end_s": 2}])");
  const test::Ended ended = wait(start({"--store", path("store"), "--plugins", path("built"), "run",
                                        "example/pauses.json", "--set", "phones=phones.json", "--out", "out"},
                                       path("sdk/there/bin/facegraph")));
  EXPECT_EQ(ended.code, 0) << ended.output;
  EXPECT_EQ(ended.warnings(), std::vector<std::string>{}) << ended.output;
  EXPECT_EQ(read("out/pauses.csv"), "start_s,end_s\n0.000000,0.500000\n1.250000,2.000000\n");
}

TEST_F(Sdk, TheInstalledPluginsAreTheBuiltOnes) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder() / "sdk" / "lib" / "facegraph" / "plugins")) {
    const fs::path built = fs::path(FACEGRAPH_PLUGIN_DIR) / entry.path().filename();
    EXPECT_TRUE(read_file(entry.path()) == read_file(built)) << built;
    ++files;
  }
  EXPECT_GE(files, 2u);
  const test::Ended ended = wait(start({"validate", path("sdk/share/facegraph/graphs/speech/talk.json"), "--set",
                                        "text=" + path("sdk/share/facegraph/graphs/speech/demo.txt")},
                                       path("sdk/bin/facegraph")));
  EXPECT_EQ(ended.code, 0) << ended.output;
}

TEST(Example, IsAtMostFortyLinesLong) {
  std::size_t lines = 0;
  for (const char* name : {"CMakeLists.txt", "list_pauses.cpp"})
    lines += test::lines_of(read_file(source / "plugins" / "example" / name)).size();
  EXPECT_LE(lines, 40u);
}

TEST(Example, IsWhatItsGuideShows) {
  const std::string guide = read_file(source / "docs" / "writing-a-plugin.md");
  for (const char* name : {"CMakeLists.txt", "list_pauses.cpp", "pauses.json"}) {
    const std::string text = read_file(source / "plugins" / "example" / name);
    ASSERT_FALSE(text.empty()) << name;
    EXPECT_NE(guide.find("\n" + text + "```\n"), std::string::npos)
        << "docs/writing-a-plugin.md does not show " << name;
  }
}

}  // namespace
