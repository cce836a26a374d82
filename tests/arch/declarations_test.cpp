// SPDX-License-Identifier: Apache-2.0
// A node's declaration and the C++ that it declares have the same names; every node has a doc and a test.
#include <algorithm>
#include <regex>

#include "tests/arch/source_tree.h"

namespace {

using namespace test;

// Code without comments; every other character keeps its place.
std::string without_comments(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') {
      for (++i; i < text.size() && text[i] != '"'; ++i)
        if (text[i] == '\\') ++i;
    } else if (text.compare(i, 2, "//") == 0) {
      for (; i < text.size() && text[i] != '\n'; ++i) text[i] = ' ';
    } else if (text.compare(i, 2, "/*") == 0) {
      const std::size_t end = std::min(text.find("*/", i + 2), text.size() - 2) + 2;
      for (; i < end; ++i)
        if (text[i] != '\n') text[i] = ' ';
    }
  }
  return text;
}

// The text between a bracket and its partner; open is the place of "(".
std::string inside(const std::string& text, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && --depth == 0) return text.substr(open + 1, i - open - 1);
  }
  return {};
}

// "const Seq<Pair<A, B>>& a, int b" -> two
std::vector<std::string> arguments_of(const std::string& list) {
  std::vector<std::string> arguments(1);
  int depth = 0;
  for (const char c : list) {
    if (c == '<' || c == '(' || c == '{') ++depth;
    if (c == '>' || c == ')' || c == '}') --depth;
    if (c == ',' && depth == 0)
      arguments.emplace_back();
    else
      arguments.back() += c;
  }
  if (arguments.size() == 1 && arguments[0].find_first_not_of(" \n\t") == std::string::npos) arguments.clear();
  return arguments;
}

std::string line_of(const std::string& text, std::size_t at) {
  return std::to_string(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1);
}

struct Name {
  std::string declared;
  std::string member;  // of param and output: S::member; empty for input and whole outputs
  std::string place;
};

struct Declaration {
  std::string file, node, function, owner;
  bool doc = false;
  std::vector<Name> inputs, params, member_outputs, whole_outputs;
};

// A declaration's text with the words put in that its own headers define, such as parameters that two nodes share.
std::string with_definitions(const std::string& file) {
  std::string text = without_comments(text_of(file));
  for (const Include& include : includes_of(file)) {
    if (include.angled || include.file == "engine/node.h") continue;
    const std::string header = without_comments(text_of(include.file));
    const std::regex define("#define ([A-Z_]+)[ ]+((?:[^\n]*\\\\\n)*[^\n]*)");
    for (std::sregex_iterator at(header.begin(), header.end(), define), end; at != end; ++at) {
      std::string body = (*at)[2];
      std::replace(body.begin(), body.end(), '\\', ' ');
      const std::string word = (*at)[1];
      for (std::size_t place = text.find(word); place != std::string::npos;
           place = text.find(word, place + body.size()))
        text.replace(place, word.size(), body);
    }
  }
  return text;
}

Declaration declaration_of(const std::string& file) {
  Declaration found;
  found.file = file;
  const std::string text = with_definitions(file);
  std::smatch match;
  const std::regex head("NODE\\(\\s*\"([^\"]*)\"\\s*,\\s*&([\\w:]+)");
  EXPECT_TRUE(std::regex_search(text, match, head)) << file << ":1: no NODE(\"name\", &function, ...)";
  if (match.empty()) return found;
  found.node = match[1];
  const std::string qualified = match[2];
  found.function = qualified.substr(qualified.rfind(':') == std::string::npos ? 0 : qualified.rfind(':') + 1);
  found.doc = std::regex_search(text, std::regex("\\bdoc\\{\\s*\"[^\"]+"));

  const std::regex word("\\b(input\\{|param\\(|output\\()\\s*\"([^\"]*)\"\\s*,\\s*(?:&([\\w:]+)::(\\w+))?");
  for (std::sregex_iterator i(text.begin(), text.end(), word), end; i != end; ++i) {
    const std::string kind = (*i)[1];
    const Name name{(*i)[2], (*i)[4], file + ":" + line_of(text, static_cast<std::size_t>(i->position()))};
    if (kind == "input{") found.inputs.push_back(name);
    if (kind == "output(") (name.member.empty() ? found.whole_outputs : found.member_outputs).push_back(name);
    if (kind == "param(") {
      found.params.push_back(name);
      const std::string owner = (*i)[3];
      found.owner = owner.substr(owner.rfind(':') == std::string::npos ? 0 : owner.rfind(':') + 1);
    }
  }
  return found;
}

struct Argument {
  std::string type, name;
};

// The function's arguments as the header declares them.
bool find_function(const Declaration& declaration, std::vector<Argument>& arguments, std::string& place) {
  for (const Include& include : includes_of(declaration.file)) {
    if (include.angled || include.file == "engine/node.h") continue;
    const std::string text = without_comments(text_of(include.file));
    std::smatch match;
    if (!std::regex_search(text, match, std::regex("\\n[\\w:<>&* ]+[ &*]" + declaration.function + "\\("))) continue;
    const std::size_t open = static_cast<std::size_t>(match.position() + match.length()) - 1;
    place = include.file + ":" + line_of(text, open);
    for (std::string argument : arguments_of(inside(text, open))) {
      argument = argument.substr(0, argument.find('='));
      std::smatch parts;
      if (std::regex_match(argument, parts, std::regex("\\s*([\\s\\S]*[\\s&*>])(\\w+)\\s*")))
        arguments.push_back({parts[1], parts[2]});
      else
        arguments.push_back({argument, "(no name)"});
    }
    return true;
  }
  return false;
}

std::vector<std::string> node_files() {
  std::vector<std::string> files = files_below("nodes", {".node.cpp"});
  const std::vector<std::string> others = files_below("plugins", {".node.cpp"});
  files.insert(files.end(), others.begin(), others.end());
  return files;
}

using Lines = std::vector<std::string>;

std::string differs(const Name& name, const std::string& what, const std::string& expected) {
  return name.place + ": " + what + " \"" + name.declared + "\", expected \"" + expected + "\"";
}

// Inputs, and writers among the outputs, that are called otherwise than the arguments at their place.
Lines unlike_arguments(const std::string& file) {
  const Declaration declaration = declaration_of(file);
  std::vector<Argument> arguments;
  std::string place;
  if (!find_function(declaration, arguments, place))
    return {file + ":1: function " + declaration.function + " is declared in no header that is included"};
  std::vector<std::string> inputs, writers;
  for (const Argument& argument : arguments) {
    const auto is = [&](const std::string& type) { return argument.type.find(type) != std::string::npos; };
    if (is("Progress&") || is("Prior<")) continue;
    if (is("SeqWriter<")) {
      writers.push_back(argument.name);
      continue;
    }
    const bool options =
        !declaration.owner.empty() && std::regex_search(argument.type, std::regex("\\b" + declaration.owner + "\\b"));
    if (!options) inputs.push_back(argument.name);
  }
  Lines lines;
  const std::string as_there = "input of " + declaration.node + ", whose argument is at " + place + ", is";
  for (std::size_t i = 0; i < std::max(inputs.size(), declaration.inputs.size()); ++i) {
    const Name none{"(none)", "", file + ":1"};
    const Name& declared = i < declaration.inputs.size() ? declaration.inputs[i] : none;
    const std::string argument = i < inputs.size() ? inputs[i] : "(none)";
    if (declared.declared != argument) lines.push_back(differs(declared, as_there, argument));
  }
  // Writers come last; a whole result, which has no name in C++, first.
  const std::size_t wholes = declaration.whole_outputs.size();
  for (std::size_t i = 0; i < writers.size() && writers.size() <= wholes; ++i) {
    const Name& declared = declaration.whole_outputs[wholes - writers.size() + i];
    if (declared.declared != writers[i])
      lines.push_back(
          differs(declared, "output of " + declaration.node + ", whose SeqWriter is at " + place + ", is", writers[i]));
  }
  return lines;
}

// Parameters and outputs that are called otherwise than their members.
Lines unlike_members(const std::string& file) {
  const Declaration declaration = declaration_of(file);
  Lines lines;
  for (const Name& name : declaration.params)
    if (name.declared != name.member)
      lines.push_back(differs(name, "parameter of " + declaration.node + " is", name.member));
  for (const Name& name : declaration.member_outputs)
    if (name.declared != name.member)
      lines.push_back(differs(name, "output of " + declaration.node + " is", name.member));
  return lines;
}

TEST(Declarations, InputsAreNamedLikeTheArgumentsInTheirOrder) {
  for (const std::string& file : node_files())
    for (const std::string& line : unlike_arguments(file)) ADD_FAILURE() << line;
}

TEST(Declarations, ParametersAndOutputsAreNamedLikeTheirMembers) {
  for (const std::string& file : node_files())
    for (const std::string& line : unlike_members(file)) ADD_FAILURE() << line;
}

// The one sin of tests/plugins/sins that nothing but the source tells.
TEST(Declarations, SwappedNamesAreFound) {
  const std::string file = "tests/plugins/sins/swap_names.node.cpp";
  std::string place;
  std::vector<Argument> arguments;
  ASSERT_TRUE(find_function(declaration_of(file), arguments, place));
  const std::string input = "input of sins.swap_names, whose argument is at " + place + ", is ";
  EXPECT_EQ(unlike_arguments(file), (Lines{file + ":8: " + input + "\"other\", expected \"number\"",
                                           file + ":9: " + input + "\"number\", expected \"other\""}));
  EXPECT_EQ(unlike_members(file), (Lines{file + ":10: parameter of sins.swap_names is \"low\", expected \"high\"",
                                         file + ":11: parameter of sins.swap_names is \"high\", expected \"low\""}));
}

TEST(Declarations, FileAndFunctionHaveOneName) {
  for (const std::string& file : files_below("nodes", {".node.cpp"})) {
    const Declaration declaration = declaration_of(file);
    const std::string stem = fs::path(file).stem().stem().string();
    EXPECT_EQ(declaration.function, stem) << file << ":1: the function is named like the file";
    // area.verb_noun, or area.noun where the area is the verb.
    const std::string area = second_folder(file) + ".";
    EXPECT_TRUE(declaration.node.starts_with(area))
        << file << ":1: node " << declaration.node << " is not of area " << area;
    const std::string last = declaration.node.substr(declaration.node.find_last_of("._") + 1);
    // flow.robust is in robust_flow.cpp: the area as the last word says nothing new.
    EXPECT_TRUE(stem == last || stem.ends_with("_" + last) || stem == last + "_" + second_folder(file))
        << file << ":1: node " << declaration.node << " and its file end in different words";
  }
}

TEST(Declarations, EveryNodeHasADoc) {
  for (const std::string& file : node_files()) EXPECT_TRUE(declaration_of(file).doc) << file << ":1: no doc{\"...\"}";
}

TEST(Declarations, ANodeFileHoldsOneDeclarationAndNoLogic) {
  const std::regex logic("\\b(for|while|if|switch|return)\\b\\s*[({]?");
  const std::regex text_literal("\"(?:[^\"\\\\]|\\\\.)*\"");
  for (const std::string& file : node_files()) {
    const std::string text = std::regex_replace(without_comments(text_of(file)), text_literal, "\"\"");
    std::smatch match;
    EXPECT_FALSE(std::regex_search(text, match, logic)) << file << ":1: \"" << match.str() << "\" in a node file";
    std::size_t count = 0;
    for (std::size_t at = text.find("NODE("); at != std::string::npos; at = text.find("NODE(", at + 1)) ++count;
    EXPECT_EQ(count, 1u) << file << ":1: one NODE(...) per file";
  }
}

TEST(Declarations, EveryNodeHasATestThatMentionsItsFunction) {
  for (const std::string& file : files_below("nodes", {".node.cpp"})) {
    const Declaration declaration = declaration_of(file);
    const std::string folder = "tests/nodes/" + second_folder(file);
    const std::regex call("\\b" + declaration.function + "\\b\\s*\\(");
    bool found = false;
    for (const std::string& test : files_below(folder, {"_test.cpp"}))
      found = found || std::regex_search(text_of(test), call);
    EXPECT_TRUE(found) << file << ":1: no test in " << folder << " calls " << declaration.function;
  }
}

}  // namespace
