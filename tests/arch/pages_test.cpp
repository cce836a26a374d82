// SPDX-License-Identifier: Apache-2.0
// Where the pages send their readers.
#include <iterator>
#include <regex>

#include "tests/arch/source_tree.h"

namespace {

using namespace test;

// The name by which a heading is linked: "How good it is" -> "how-good-it-is".
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (c == ' ') anchor += '-';
  }
  return anchor;
}

// Without what stands between fences, which is shown and not followed.
std::vector<std::string> prose_of(const std::string& page) {
  std::vector<std::string> prose;
  bool inside = false;
  for (const std::string& line : lines_of(text_of(page))) {
    if (line.starts_with("```")) inside = !inside;
    prose.push_back(inside || line.starts_with("```") ? "" : line);
  }
  return prose;
}

bool has_heading(const std::string& page, const std::string& anchor) {
  const std::vector<std::string> prose = prose_of(page);
  return std::any_of(prose.begin(), prose.end(), [&](const std::string& line) {
    const std::size_t text = line.find_first_not_of('#');
    return text != 0 && text != std::string::npos && line[text] == ' ' && anchor_of(line.substr(text + 1)) == anchor;
  });
}

TEST(Pages, LinksLeadToFilesAndHeadingsThatAreThere) {
  const std::regex link("\\]\\(([^)# ]*)(?:#([^) ]*))?\\)");
  for (const std::string& page : kept_files({".md"})) {
    const std::vector<std::string> prose = prose_of(page);
    for (std::size_t i = 0; i < prose.size(); ++i)
      for (std::sregex_iterator match(prose[i].begin(), prose[i].end(), link), end; match != end; ++match) {
        const std::string file = (*match)[1], heading = (*match)[2];
        if (file.find("://") != std::string::npos) continue;
        const std::string place = page + ":" + std::to_string(i + 1);
        const std::string target =
            file.empty() ? page : (fs::path(page).parent_path() / file).lexically_normal().generic_string();
        if (!fs::exists(fs::path(FACEGRAPH_SOURCE_DIR) / target)) {
          ADD_FAILURE() << place << ": links to " << target << ", which is not there";
        } else if (!heading.empty()) {
          EXPECT_TRUE(has_heading(target, heading)) << place << ": " << target << " has no heading #" << heading;
        }
      }
  }
}

TEST(Pages, ThatOtherFilesNameAreThere) {
  const std::regex named("\\bdocs/[A-Za-z0-9_/-]+\\.md\\b");
  for (const std::string& file : kept_files({".h", ".cpp", ".cmake", "CMakeLists.txt", ".json", ".md", ".sh", ".py"})) {
    const std::vector<std::string> lines = lines_of(text_of(file));
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::sregex_iterator match(lines[i].begin(), lines[i].end(), named), end; match != end; ++match)
        EXPECT_TRUE(fs::exists(fs::path(FACEGRAPH_SOURCE_DIR) / match->str()))
            << file << ":" << i + 1 << ": names " << match->str() << ", which is not there";
  }
}

// What stands behind a figure is told in docs/measured/, so that the guide's table stays one that is read.
TEST(Pages, CellsOfTheTablesOfBarsAreShort) {
  constexpr std::size_t most_words = 45;
  for (const std::string& page : files_below("docs", {".md"})) {
    if (page.starts_with("docs/measured/")) continue;
    const std::vector<std::string> prose = prose_of(page);
    bool bars = false;
    for (std::size_t i = 0; i < prose.size(); ++i) {
      if (prose[i].starts_with("## ")) bars = prose[i] == "## How good it is";
      if (!bars || !prose[i].starts_with("|")) continue;
      std::istringstream cells(prose[i]);
      for (std::string cell; std::getline(cells, cell, '|');) {
        std::istringstream words(cell);
        const auto count = static_cast<std::size_t>(
            std::distance(std::istream_iterator<std::string>(words), std::istream_iterator<std::string>()));
        EXPECT_LE(count, most_words) << page << ":" << i + 1 << ": a cell of " << count
                                     << " words; tell it in docs/measured/: " << cell.substr(0, 60);
      }
    }
  }
}

}  // namespace
