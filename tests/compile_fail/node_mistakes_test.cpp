// SPDX-License-Identifier: Apache-2.0
// Wrong declarations do not compile, and the compiler says in a sentence what is wrong. Each file of mistakes/ names
// the sentence in its line "// expect: ..."; "nothing" is for what compiles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Compiled {
  int status = -1;
  std::string messages;
};

Compiled run(const std::string& command) {
  Compiled compiled;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return compiled;
  char buffer[4096];
  for (std::size_t count; (count = fread(buffer, 1, sizeof buffer, pipe)) > 0;) compiled.messages.append(buffer, count);
  compiled.status = pclose(pipe);
  return compiled;
}

// The messages in plain quotes whatever the language, so that a sentence may quote a name.
Compiled compile(const fs::path& file) {
  return run("LC_ALL=C '" FACEGRAPH_COMPILER "' -std=c++20 -fsyntax-only -I '" FACEGRAPH_SOURCE_DIR "' '" +
             file.string() + "'");
}

// The sentences, each as some compiler writes it: "what GCC says | what clang says".
std::vector<std::string> expected_in(const fs::path& file) {
  std::ifstream in(file);
  const std::string mark = "// expect: ", between = " | ";
  std::vector<std::string> sentences;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(mark)) continue;
    line.erase(0, mark.size());
    for (std::size_t end; (end = line.find(between)) != std::string::npos; line.erase(0, end + between.size()))
      sentences.push_back(line.substr(0, end));
    sentences.push_back(line);
  }
  return sentences;
}

std::vector<fs::path> mistakes() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(FACEGRAPH_SOURCE_DIR "/tests/compile_fail/mistakes"))
    if (entry.path().extension() == ".cpp") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class NodeMistakes : public ::testing::TestWithParam<fs::path> {};

TEST_P(NodeMistakes, AreToldInASentence) {
  if (run("'" FACEGRAPH_COMPILER "' --version").status != 0)
    GTEST_SKIP() << "needs the compiler " << FACEGRAPH_COMPILER;
  const fs::path file = GetParam();
  const std::vector<std::string> expected = expected_in(file);
  ASSERT_FALSE(expected.empty()) << file.filename().string() << ": no line // expect: ...";
  const Compiled compiled = compile(file);
  if (expected[0] == "nothing") {
    EXPECT_EQ(compiled.status, 0) << file.filename().string() << ":\n" << compiled.messages;
  } else {
    EXPECT_NE(compiled.status, 0) << file.filename().string() << " compiles";
    EXPECT_TRUE(std::any_of(expected.begin(), expected.end(),
                            [&](const std::string& text) { return compiled.messages.find(text) != std::string::npos; }))
        << file.filename().string() << ": the compiler does not say \"" << expected[0] << "\" but\n"
        << compiled.messages.substr(0, 2000);
  }
}

INSTANTIATE_TEST_SUITE_P(All, NodeMistakes, ::testing::ValuesIn(mistakes()),
                         [](const auto& mistake) { return mistake.param.stem().string(); });

}  // namespace
