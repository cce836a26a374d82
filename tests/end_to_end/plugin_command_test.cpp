// SPDX-License-Identifier: Apache-2.0
// Commands that plugins ship as data: graphs in `commands` beside the libraries.
#include "tests/end_to_end/command.h"

namespace {

using test::operator+;

class PluginCommand : public test::CommandTest {
 protected:
  void SetUp() override {
    write("more/commands/repeat-text.json", R"({
      // A comment
      "facegraph": 1, "doc": "Repeat a text",
      "params": {
        "text": {"type": "path", "doc": "What is repeated"},
        "how_often": {"type": "integer", "default": 2, "doc": "Times"},
        "mode": {"type": "choice", "choices": ["upper", "lower"], "default": "upper"}
      },
      "nodes": {
        "read": {"node": "toy.read_text", "inputs": {"file": "${text}"}},
        "often": {"node": "toy.repeat", "inputs": {"text": "read"}, "params": {"times": "${how_often}"}},
        "joined": {"node": "toy.concat", "inputs": {"texts": "often"}},
        "loud": {"node": "toy.upper", "inputs": {"text": "joined"}, "params": {"mode": "${mode}"}},
        "file": {"node": "toy.write_text", "inputs": {"text": "loud"}}
      },
      "outputs": {"repeated.txt": "file"}
    })");
    write("word.txt", "yes");
  }
  test::Ended say(const test::Words& words) const { return command(test::Words{"--plugins", "more"} + words); }
};

TEST_F(PluginCommand, RunsItsGraphWithParametersAsOptions) {
  const test::Ended ended = say({"repeat-text", "--text", "word.txt", "--out", "here"});
  EXPECT_EQ(ended.code, 0) << ended.output;
  EXPECT_EQ(read("here/repeated.txt").substr(0, 3), "YES");
  EXPECT_EQ(say({"repeat-text", "--text=word.txt", "--how-often", "3", "--mode=lower", "--out", "here"}).code, 0);
  EXPECT_EQ(read("here/repeated.txt").find("yes"), 0u);
  EXPECT_NE(read("here/repeated.txt").rfind("yes"), read("here/repeated.txt").find("yes"));
}

TEST_F(PluginCommand, CallsItsOnlyOutputAsTheFileThatIsGiven) {
  EXPECT_EQ(say({"repeat-text", "--text", "word.txt", "--out", "loud.txt", "--quiet"}).code, 0);
  EXPECT_EQ(read("loud.txt").substr(0, 3), "YES");
  EXPECT_FALSE(exists("repeated.txt"));
}

TEST_F(PluginCommand, IsListedAndExplained) {
  EXPECT_NE(say({"--help"}).output.find("repeat-text                 Repeat a text"), std::string::npos)
      << say({"--help"}).output;
  const test::Ended help = say({"repeat-text", "--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* text : {"--text PATH", "What is repeated (needed)", "--how-often INTEGER", "--mode upper|lower"})
    EXPECT_NE(help.output.find(text), std::string::npos) << text << " in\n" << help.output;
}

TEST_F(PluginCommand, SaysWhatIsWrongWithItsOptions) {
  const auto refuses = [&](const test::Words& words, const std::string& text) {
    const test::Ended ended = say(test::Words{"repeat-text"} + words);
    EXPECT_EQ(ended.code, 2);
    EXPECT_EQ(ended.output, "error: command line: " + text + "\n");
  };
  refuses({}, "repeat-text needs --text PATH: What is repeated");
  refuses({"--txt", "word.txt"}, "repeat-text has no option --txt (did you mean '--text'?)");
  refuses({"--text"}, "--text needs a value");
  refuses({"word.txt"}, "word.txt is no option of repeat-text: they start with --");
  refuses({"--text", "word.txt", "--text", "word.txt"}, "--text is given twice");
  const test::Ended number = say({"repeat-text", "--text", "word.txt", "--how-often", "many"});
  EXPECT_EQ(number.code, 2);
  EXPECT_NE(number.output.find("how_often"), std::string::npos) << number.output;
  const test::Ended misspelt = say({"repeat-txt"});
  EXPECT_EQ(misspelt.code, 2);
  EXPECT_NE(misspelt.output.find("there is no command 'repeat-txt' (did you mean 'repeat-text'?)"), std::string::npos)
      << misspelt.output;
}

TEST_F(PluginCommand, CannotTakeTheNameOfOneOfTheProgramsOwn) {
  write("more/commands/nodes.json", read("more/commands/repeat-text.json"));
  EXPECT_NE(say({"nodes"}).output.find("toy.repeat"), std::string::npos);
}

}  // namespace
