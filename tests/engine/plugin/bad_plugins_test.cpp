// SPDX-License-Identifier: Apache-2.0
// What a plugin that cannot be used does to those who have it: one line, and nothing else.
#include <elf.h>

#include <cstring>
#include <fstream>
#include <set>

#include "engine/plugin/descriptor.h"
#include "engine/plugin/library_digest.h"
#include "tests/end_to_end/command.h"
#include "tests/support/expect_throw_text.h"

namespace {

namespace fs = std::filesystem;
using engine::Plugins;
using test::read_file;
using Lines = std::vector<std::string>;

// Shared libraries of this process that lie in a folder.
Lines loaded_from(const fs::path& folder) {
  std::set<std::string> libraries;
  for (const std::string& line : test::lines_of(read_file("/proc/self/maps")))
    if (const std::size_t at = line.find(folder.string() + "/"); at != std::string::npos && line.ends_with(".so"))
      libraries.insert(line.substr(at));
  return {libraries.begin(), libraries.end()};
}

fs::path built(const std::string& name) { return fs::path(FACEGRAPH_BAD_PLUGINS) / (name + ".so"); }

class BadPlugins : public test::CommandTest {
 protected:
  BadPlugins() {
    fs::create_directories(bad());
    fs::create_directories(good());
  }
  fs::path bad() const { return folder() / "bad"; }
  fs::path good() const { return folder() / "good"; }
  void copy(const std::string& name) const { fs::copy_file(built(name), bad() / (name + ".so")); }

  // The good plugin with other tags.
  void write_tagged(const std::string& name, void (*change)(engine::PluginTags&)) const {
    std::string bytes = read_file(built("tiny"));
    const std::string section = engine::read_section(built("tiny").string(), engine::plugin_tags_section);
    engine::PluginTags tags;
    std::memcpy(&tags, section.data(), sizeof tags);
    change(tags);
    std::memcpy(bytes.data() + bytes.find(section), &tags, sizeof tags);
    write("bad/" + name + ".so", bytes);
  }
  // The good plugin with another name for its node: three digits at the end.
  void write_renamed(const std::string& file, const std::string& digits) const {
    std::string bytes = read_file(built("tiny"));
    const std::string name = "tiny.make_point_000";
    for (std::size_t at; (at = bytes.find(name)) != std::string::npos;)
      bytes.replace(at, name.size(), name.substr(0, name.size() - 3) + digits);
    write(file, bytes);
  }
  // The good plugin, cut off before its dynamic section; what is said of it.
  std::string write_truncated() const {
    const std::string bytes = read_file(built("tiny"));
    Elf64_Ehdr header;
    std::memcpy(&header, bytes.data(), sizeof header);
    Elf64_Phdr part{};
    for (int i = 0; i < header.e_phnum && part.p_type != PT_DYNAMIC; ++i)
      std::memcpy(&part, bytes.data() + header.e_phoff + static_cast<std::size_t>(i) * sizeof part, sizeof part);
    write("bad/truncated.so", bytes.substr(0, part.p_offset));
    return "it is no usable shared library: it is truncated: expected the dynamic section at bytes " +
           std::to_string(part.p_offset) + " to " + std::to_string(part.p_offset + part.p_filesz) + ", the file has " +
           std::to_string(part.p_offset);
  }

  // Writes nine bad plugins and a good one; what is said of the nine, in the order of their names.
  Lines write_nine() const {
    write_tagged("older_abi", [](engine::PluginTags& tags) { tags.abi = engine::abi_version - 1; });
    write_tagged("newer_abi", [](engine::PluginTags& tags) { tags.abi = engine::abi_version + 1; });
    write_tagged("other_compiler", [](engine::PluginTags& tags) { std::strcpy(tags.compiler, "icc 19"); });
    for (const char* name :
         {"missing_dependency", "throwing_initialiser", "duplicate_node", "no_descriptor", "other_layout"})
      copy(name);
    const std::string truncated = write_truncated();
    fs::copy_file(built("tiny"), good() / "tiny.so");
    const int abi = engine::abi_version;
    const std::string here = std::to_string(abi);
    return {
        "plugin bad/duplicate_node.so cannot be used: its node tiny.make_point_000 is already declared by plugin "
        "good/tiny.so",
        "plugin bad/missing_dependency.so cannot be used: it needs libgone.so, which cannot be opened: No such file or "
        "directory",
        "plugin bad/newer_abi.so cannot be used: it was built for plugin ABI " + std::to_string(abi + 1) +
            ", this engine has " + here + ": update the engine",
        "plugin bad/no_descriptor.so cannot be used: it has no Facegraph descriptor",
        "plugin bad/older_abi.so cannot be used: it was built for plugin ABI " + std::to_string(abi - 1) +
            ", this engine has " + here + ": rebuild the plugin",
        std::string("plugin bad/other_compiler.so cannot be used: it was built with compiler 'icc 19', expected '") +
            engine::this_abi.compiler + "'",
        "plugin bad/other_layout.so cannot be used: its type tiny_point is laid out differently in plugin good/tiny.so",
        "plugin bad/throwing_initialiser.so cannot be used: an initialiser throws: the licence has expired",
        "plugin bad/truncated.so cannot be used: " + truncated,
    };
  }

  // Without the folder of this test.
  std::string relative(std::string text) const {
    const std::string start = folder().string() + "/";
    for (std::size_t at; (at = text.find(start)) != std::string::npos;) text.erase(at, start.size());
    return text;
  }
  Lines told(const Plugins& plugins) const {
    Lines lines;
    for (const engine::Problem& problem : plugins.problems())
      lines.push_back("plugin " + relative(problem.place.file) + " cannot be used: " + relative(problem.text));
    return lines;
  }
};

TEST_F(BadPlugins, EachIsToldInOneLineAndNoneIsLoaded) {
  const Lines expected = write_nine();
  Plugins plugins({bad().string(), good().string()});
  EXPECT_EQ(told(plugins), expected);
  EXPECT_EQ(plugins.plugin_names(), Lines{"tiny"});
  EXPECT_EQ(loaded_from(folder()), Lines{});
  EXPECT_EQ(plugins.load("tiny.make_point_000").info.name, "tiny.make_point_000");
  EXPECT_EQ(loaded_from(folder()), Lines{(good() / "tiny.so").string()});
}

TEST_F(BadPlugins, GoodOnesRunBesideThem) {
  const Lines expected = write_nine();
  write("name.txt", "ada");
  write("loud.json", R"({"facegraph": 1, "params": {"file": {"type": "path", "default": "name.txt"}},
      "nodes": {"read": {"node": "toy.read_text", "inputs": {"file": "${file}"}},
                "loud": {"node": "toy.upper", "inputs": {"text": "read"}},
                "written": {"node": "toy.write_text", "inputs": {"text": "loud"}}},
      "outputs": {"loud.txt": "written"}})");
  const test::Ended ended =
      command({"--plugins", bad().string(), "--plugins", good().string(), "run", "loud.json", "--out", "out"});
  EXPECT_EQ(ended.code, 0) << ended.output;
  EXPECT_EQ(read("out/loud.txt"), "ADA");
  Lines warnings;
  for (const std::string& line : ended.warnings()) warnings.push_back(relative(line));
  EXPECT_EQ(warnings, expected);
}

TEST_F(BadPlugins, AGraphThatNeedsOneIsInvalidAndSaysWhy) {
  copy("throwing_initialiser");
  write("half.json",
        R"({"facegraph": 1, "nodes": {"half": {"node": "throwing_initialiser.half"}}, "outputs": {"a.txt": "half"}})");
  const test::Ended ended = command({"--plugins", bad().string(), "validate", "half.json"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.output.find("the node \"throwing_initialiser.half\" cannot be used: its plugin cannot be used: an "
                              "initialiser throws: the licence has expired\n"),
            std::string::npos)
      << ended.output;
}

TEST_F(BadPlugins, ASymbolThatNoLibraryHasIsToldBeforeItIsCalled) {
  copy("missing_symbol");
  EXPECT_EQ(told(Plugins({bad().string()})), Lines{"plugin bad/missing_symbol.so cannot be used: no library has the "
                                                   "symbol that it needs: nowhere::halve(double)"});
}

TEST_F(BadPlugins, ACrashIsToldWithItsSignalAndLastWords) {
  copy("crashing_initialiser");
  EXPECT_EQ(told(Plugins({bad().string()})), Lines{"plugin bad/crashing_initialiser.so cannot be used: its first load "
                                                   "ended with signal 6 (Aborted): "
                                                   "first line; second line"});
}

TEST_F(BadPlugins, ALibraryThatBreaksAfterItWasListedIsToldWhenItIsNeeded) {
  fs::copy_file(built("tiny"), bad() / "tiny.so");
  Plugins plugins({bad().string()});
  EXPECT_EQ(told(plugins), Lines{});
  const std::string reason = write_truncated();
  fs::rename(bad() / "truncated.so", bad() / "tiny.so");
  EXPECT_THROW_TEXT(plugins.load("tiny.make_point_000"),
                    "plugin " + (bad() / "tiny.so").string() + " cannot be used: " + reason);
}

TEST_F(BadPlugins, ALibraryOtherThanItsListIsNotUsed) {
  write_renamed("good/tiny.so", "001");
  EXPECT_EQ(Plugins({good().string()}).problems().size(), 0u);
  const auto time = fs::last_write_time(good() / "tiny.so");
  write_renamed("good/tiny.so", "002");
  fs::last_write_time(good() / "tiny.so", time);
  Plugins plugins({good().string()});
  EXPECT_THROW_TEXT(plugins.load("tiny.make_point_001"),
                    "plugin " + (good() / "tiny.so").string() +
                        " cannot be used: its node list was written for another library: "
                        "delete " +
                        (good() / "tiny.nodes.json").string());
}

TEST_F(BadPlugins, TheListOfAFirstLoadIsKeptUntilTheLibraryChanges) {
  write_renamed("good/tiny.so", "001");
  EXPECT_NE(Plugins({good().string()}).find("tiny.make_point_001"), nullptr);
  EXPECT_TRUE(exists("good/tiny.nodes.json"));
  // Without a program to load it, the list alone tells of the node.
  EXPECT_NE(Plugins({good().string()}, path("no_such_program")).find("tiny.make_point_001"), nullptr);
  const auto time = fs::last_write_time(good() / "tiny.so");
  write_renamed("good/tiny.so", "002");
  fs::last_write_time(good() / "tiny.so", time + std::chrono::nanoseconds(1));
  EXPECT_NE(Plugins({good().string()}).find("tiny.make_point_002"), nullptr);
}

TEST_F(BadPlugins, AListThatCannotBeKeptIsStillUsed) {
  fs::copy_file(built("tiny"), good() / "tiny.so");
  write("good/tiny.nodes.json/in_the_way.txt", "");
  const Plugins plugins({good().string()});
  EXPECT_EQ(told(plugins), Lines{});
  EXPECT_NE(plugins.find("tiny.make_point_000"), nullptr);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(good())) ++files;
  EXPECT_EQ(files, 2u);
}

TEST_F(BadPlugins, ADamagedListIsWrittenAgain) {
  fs::copy_file(built("tiny"), good() / "tiny.so");
  write("good/tiny.nodes.json", "{\"facegraph_nodes\": 1, \"nodes\": [");
  EXPECT_NE(Plugins({good().string()}).find("tiny.make_point_000"), nullptr);
  EXPECT_NE(read("good/tiny.nodes.json").find("tiny.make_point_000"), std::string::npos);
}

TEST_F(BadPlugins, WithoutTheProgramThatLoadsThemOnlyListedPluginsAreUsed) {
  fs::copy_file(built("tiny"), good() / "tiny.so");
  EXPECT_EQ(
      told(Plugins({good().string()}, path("no_such_program"))),
      Lines{"plugin good/tiny.so cannot be used: it has no node list, and the program that would write one cannot be "
            "run: no_such_program: No such file or directory"});
}

TEST_F(BadPlugins, ListingAHundredPluginsLoadsNone) {
  write_renamed("good/tiny.so", "100");
  EXPECT_NE(Plugins({good().string()}).find("tiny.make_point_100"), nullptr);
  const std::string list = read("good/tiny.nodes.json");
  for (int i = 0; i < 100; ++i) {
    const std::string digits = std::to_string(900 + i);
    write_renamed("hundred/tiny_" + digits + ".so", digits);
    std::string own = list;
    own.replace(own.find("_100\""), 4, "_" + digits);
    write("hundred/tiny_" + digits + ".nodes.json", own);
  }
  // There is no program that could load one.
  Plugins plugins({(folder() / "hundred").string()}, path("no_such_program"));
  EXPECT_EQ(told(plugins), Lines{});
  EXPECT_EQ(plugins.plugin_names().size(), 100u);
  EXPECT_EQ(loaded_from(folder()), Lines{});
  EXPECT_EQ(plugins.load("tiny.make_point_942").info.name, "tiny.make_point_942");
  EXPECT_EQ(loaded_from(folder()), Lines{path("hundred/tiny_942.so")});
}

}  // namespace
