// SPDX-License-Identifier: Apache-2.0
// What every file must look like.
#include <regex>

#include "tests/arch/source_tree.h"

namespace {

using namespace test;

TEST(Files, HeadersIncludeTheStandardLibraryAndOurOwnAlone) {
  // Beside POSIX, the header that only declares nlohmann::json.
  const std::regex allowed("sys/[a-z]+\\.h|unistd\\.h|fcntl\\.h|nlohmann/json_fwd\\.hpp");
  const std::string bridge = "nodes/base/eigen_vector.h";  // to Eigen, which it includes; for .cpp files alone
  for (const char* folder : {"engine", "nodes", "plugins"})
    for (const std::string& file : files_below(folder, {".h"}))
      for (const Include& include : includes_of(file)) {
        EXPECT_TRUE(file == bridge || !include.angled || is_standard(include.file) ||
                    std::regex_match(include.file, allowed))
            << include.place << ": a header includes <" << include.file << ">; put it into the .cpp";
        EXPECT_NE(include.file, bridge) << include.place << ": only .cpp files include " << bridge;
      }
}

TEST(Files, HeadersHaveNoUsingNamespace) {
  const std::regex rule("^\\s*using\\s+namespace\\b");
  for (const char* folder : {"engine", "nodes", "plugins", "cli"})
    for (const std::string& file : files_below(folder, {".h"})) {
      const std::vector<std::string> lines = lines_of(text_of(file));
      for (std::size_t i = 0; i < lines.size(); ++i)
        EXPECT_FALSE(std::regex_search(lines[i], rule)) << file << ":" << i + 1 << ": using namespace in a header";
    }
}

TEST(Files, HeadersAreIncludedOnce) {
  for (const char* folder : {"engine", "nodes", "plugins", "cli", "tests"})
    for (const std::string& file : files_below(folder, {".h"}))
      EXPECT_NE(text_of(file).find("#pragma once\n"), std::string::npos) << file << ":1: no #pragma once";
}

TEST(Files, SourcesNameTheirLicence) {
  const std::string licence = "SPDX-License-Identifier: Apache-2.0";
  std::vector<std::string> files = kept_files({".h", ".cpp", ".cmake", "CMakeLists.txt", ".mjs", ".sh", ".py"});
  for (const char* script : {"demo", "check"})
    if (fs::exists(fs::path(FACEGRAPH_SOURCE_DIR) / script)) files.push_back(script);
  for (const std::string& file : files) {
    const std::vector<std::string> lines = lines_of(text_of(file));
    const bool found = (!lines.empty() && lines[0].find(licence) != std::string::npos) ||
                       (lines.size() > 1 && lines[0].starts_with("#!") && lines[1].find(licence) != std::string::npos);
    EXPECT_TRUE(found) << file << ":1: no line with " << licence;
  }
}

TEST(Files, AreAtMost600LinesLong) {
  for (const std::string& file : kept_files({".h", ".cpp", ".cmake", "CMakeLists.txt", ".mjs", ".sh", ".py"})) {
    const std::size_t count = lines_of(text_of(file)).size();
    EXPECT_LE(count, 600u) << file << ":" << count << ": has " << count << " lines; split it";
  }
}

TEST(Files, NameNoPlaceOfOneMachine) {
  // A path below a folder that differs between machines. What a Debian package installs is the same everywhere.
  const std::regex path("(?:^|[\"'`\\s(=:])(/(?:home|root|work|tmp|usr|opt|etc|mnt|media|srv|Users)/[^\"'`\\s)]*)");
  const std::vector<std::string> installed = {"/usr/share/pocketsphinx",
                                              "/usr/include/stdio.h",
                                              "/usr/bin",
                                              "/usr/local/lib",
                                              "/usr/lib",
                                              "/etc/ld.so",
                                              "/etc/os-release",
                                              "/etc/localtime",
                                              "/opt/facegraph",
                                              "/usr/share/zoneinfo/",
                                              "/etc/ssl/",
                                              "/usr/share/locale/"};
  for (const std::string& file :
       kept_files({".h", ".cpp", ".cmake", "CMakeLists.txt", ".json", ".md", ".mjs", ".sh", ".py"})) {
    if (file == "tests/arch/files_test.cpp") continue;
    const std::vector<std::string> lines = lines_of(text_of(file));
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::sregex_iterator match(lines[i].begin(), lines[i].end(), path), end; match != end; ++match) {
        const std::string found = (*match)[1];
        const bool known = std::any_of(installed.begin(), installed.end(),
                                       [&](const std::string& prefix) { return found.starts_with(prefix); });
        // "/tmp/" is also a folder of the store.
        const bool of_the_store = file.starts_with("engine/store/") || file.starts_with("tests/engine/store/");
        EXPECT_TRUE(known || (of_the_store && found.starts_with("/tmp/")))
            << file << ":" << i + 1 << ": absolute path " << found;
      }
  }
}

}  // namespace
