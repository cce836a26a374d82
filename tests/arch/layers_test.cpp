// SPDX-License-Identifier: Apache-2.0
// Who may depend on whom.
#include <map>
#include <regex>

#include "tests/arch/source_tree.h"

namespace {

using namespace test;

std::size_t position(const std::vector<std::string>& order, const std::string& name) {
  return static_cast<std::size_t>(std::find(order.begin(), order.end(), name) - order.begin());
}

TEST(Layers, EngineAndCommandKnowNothingOfFaces) {
  const std::regex domain_library("(Eigen|opencv2?|OpenMesh|sndfile|pocketsphinx|flite|tiny_gltf|libav|libsw).*");
  for (const char* folder : {"engine", "cli"})
    for (const std::string& file : sources_below(folder))
      for (const Include& include : includes_of(file)) {
        EXPECT_FALSE(include.file.starts_with("nodes/")) << include.place << ": includes " << include.file;
        EXPECT_FALSE(std::regex_match(include.file, domain_library)) << include.place << ": includes " << include.file;
      }
}

TEST(Layers, CommandIncludesNothingButTheEngineAndItself) {
  for (const std::string& file : sources_below("cli"))
    for (const Include& include : includes_of(file))
      EXPECT_TRUE(include.angled || include.file.starts_with("cli/") || include.file.starts_with("engine/"))
          << include.place << ": includes " << include.file;
}

TEST(Layers, CommandHasNoDomainWord) {
  const std::regex word(
      "\\b(meshes|mesh|rigs?|phones?|visemes?|landmarks?|vertex|vertices|speech|lips?|heads?|videos?)\\b",
      std::regex::icase);
  for (const std::string& file : sources_below("cli")) {
    const std::vector<std::string> lines = lines_of(text_of(file));
    for (std::size_t i = 0; i < lines.size(); ++i) {
      // Of a page's own language: <head>, <video, and the style of the latter.
      const std::string line = std::regex_replace(lines[i], std::regex("</?(head|video)\\b|,video\\{"), "");
      std::smatch match;
      EXPECT_FALSE(std::regex_search(line, match, word))
          << file << ":" << i + 1 << ": \"" << match.str() << "\" belongs to a plugin";
    }
  }
}

TEST(Layers, EachPartOfTheEngineIncludesOnlyThoseToItsLeft) {
  const std::vector<std::string> order = {"base", "value", "declare", "plugin", "graph", "store", "run", "describe"};
  for (const std::string& file : sources_below("engine")) {
    const std::string part = second_folder(file);
    if (part.empty()) continue;  // port.h and node.h
    ASSERT_LT(position(order, part), order.size()) << file << ": engine/" << part << " is no known part";
    for (const Include& include : includes_of(file)) {
      if (!include.file.starts_with("engine/")) continue;
      const std::string other = second_folder(include.file);
      EXPECT_NE(include.file, "engine/node.h") << include.place << ": engine/node.h is for node files";
      EXPECT_LE(other.empty() ? 0 : position(order, other), position(order, part))
          << include.place << ": " << part << " includes " << include.file << ", which stands to its right";
    }
  }
}

TEST(Layers, PortIncludesTheStandardLibraryAlone) {
  for (const Include& include : includes_of("engine/port.h"))
    EXPECT_TRUE(include.angled && is_standard(include.file)) << include.place << ": includes " << include.file;
}

TEST(Layers, AlgorithmsIncludeNothingOfTheEngineButPort) {
  for (const std::string& file : sources_below("nodes"))
    for (const Include& include : includes_of(file))
      EXPECT_TRUE(!include.file.starts_with("engine/") || include.file == "engine/port.h" ||
                  (is_adapter(file) && include.file == "engine/node.h"))
          << include.place << ": includes " << include.file;
}

TEST(Layers, AlgorithmsIncludeNoPluginCommandOrTest) {
  for (const std::string& file : sources_below("nodes"))
    for (const Include& include : includes_of(file))
      EXPECT_TRUE(include.angled || include.file.starts_with("nodes/") || include.file.starts_with("engine/"))
          << include.place << ": includes " << include.file;
}

// Of an area's CMakeLists.txt: the other areas in area(NAME LINKS ...).
std::set<std::string> linked_areas(const std::string& area) {
  const std::string text = text_of("nodes/" + area + "/CMakeLists.txt");
  const std::regex declaration("(?:^|\\n)area\\(" + area + "([^)]*)\\)");
  std::smatch match;
  EXPECT_TRUE(std::regex_search(text, match, declaration))
      << "nodes/" << area << "/CMakeLists.txt: no area(" << area << " ...)";
  const std::string links = match[1];
  const std::regex name("face_([a-z]+)");
  std::set<std::string> areas;
  for (std::sregex_iterator i(links.begin(), links.end(), name), end; i != end; ++i) areas.insert((*i)[1]);
  return areas;
}

// The areas that exist, in the order of nodes/CMakeLists.txt.
std::vector<std::string> areas() {
  const std::string text = text_of("nodes/CMakeLists.txt");
  std::smatch match;
  EXPECT_TRUE(std::regex_search(text, match, std::regex("set\\(areas ([a-z\\s]+)\\)")))
      << "nodes/CMakeLists.txt: no set(areas ...)";
  std::vector<std::string> names;
  std::istringstream words(match[1].str());
  for (std::string word; words >> word;)
    if (fs::exists(fs::path(FACEGRAPH_SOURCE_DIR) / "nodes" / word / "CMakeLists.txt")) names.push_back(word);
  return names;
}

TEST(Layers, AreasLinkOnlyThoseAboveThem) {
  const std::vector<std::string> order = areas();
  for (const std::string& area : order)
    for (const std::string& other : linked_areas(area))
      EXPECT_TRUE(other == "base" || other == "types" || position(order, other) < position(order, area))
          << "nodes/" << area << "/CMakeLists.txt: links face_" << other
          << ", which does not stand above it in nodes/CMakeLists.txt";
}

TEST(Layers, AreasIncludeOnlyWhatTheyLink) {
  std::map<std::string, std::set<std::string>> allowed = {{"base", {"base", "types"}}, {"types", {"base", "types"}}};
  for (const std::string& area : areas()) {
    allowed[area] = linked_areas(area);
    allowed[area].insert({area, "base", "types"});
  }
  for (const std::string& file : sources_below("nodes")) {
    const std::string area = second_folder(file);
    ASSERT_TRUE(allowed.count(area)) << file << ": nodes/" << area << " is no area of nodes/CMakeLists.txt";
    for (const Include& include : includes_of(file))
      EXPECT_TRUE(!include.file.starts_with("nodes/") || allowed[area].count(second_folder(include.file)))
          << include.place << ": area " << area << " includes " << include.file << " but does not link face_"
          << second_folder(include.file);
  }
}

TEST(Layers, Cli11IsInOneFile) {
  for (const char* folder : {"engine", "cli", "nodes", "plugins", "tests"})
    for (const std::string& file : sources_below(folder))
      for (const Include& include : includes_of(file))
        EXPECT_TRUE(!include.file.starts_with("CLI/") || file == "cli/command_line.cpp")
            << include.place << ": CLI11 is slow to compile";
}

}  // namespace
