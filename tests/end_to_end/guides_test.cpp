// SPDX-License-Identifier: Apache-2.0
// What README.md and the guides tell a reader to type is typed, and what they show of its output is looked for in it.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "tests/end_to_end/command.h"

namespace {

// What a line of a guide is run as in place of itself; empty: not at all.
using Instead = std::map<std::string, std::string>;

struct Guide {
  std::string file;      // below the project's folder
  std::string settings;  // before settings that stand alone in its text ("--set a=b"): a command that checks them
  Instead instead = {};
  std::string graphs = "graphs";  // where graphs that it shows as JSON are written, and what they need besides
  std::string graph_settings = "";
  bool planned = false;  // runs are laid out and not run
};

// The same command, laid out only: graph, files and parameters are looked at.
std::string plan_of(std::string command) {
  command = std::regex_replace(command, std::regex(" *(--out|-o) +\\S+"), "");
  command = std::regex_replace(command, std::regex("^facegraph run "), "facegraph plan ");
  return std::regex_replace(command, std::regex("^facegraph get +(\\S+) +\\S+"), "facegraph plan $1");
}

// What a guide has, in its order: lines of its plain blocks, spans of its text that are commands, and its JSON blocks.
class Reader {
 public:
  Reader(const Guide& guide, std::string text) : guide_(guide) {
    std::vector<std::string> block;
    std::string language, paragraph;
    bool inside = false;
    for (const std::string& line : test::lines_of(text)) {
      if (line.starts_with("```")) {
        if (inside) end_block(language, block, paragraph);
        if (!inside) language = line.substr(3), block.clear();
        inside = !inside;
        continue;
      }
      if (inside) {
        block.push_back(line);
      } else {
        spans(line);
        paragraph = line.empty() ? paragraph : line;
      }
    }
    for (const auto& [typed, other] : guide_.instead)
      EXPECT_TRUE(used_.contains(typed)) << guide_.file << " does not say: " << typed;
  }

  const std::string& script() const { return script_; }
  const std::vector<std::string>& shown() const { return shown_; }
  std::size_t commands() const { return commands_; }

 private:
  static bool is_command(const std::string& line) {
    return std::regex_search(line, std::regex("^(facegraph|echo|cp|cd|source|export|sudo|cmake|\\./[a-z]+)( |$)"));
  }

  void run(const std::string& typed, const std::string& as) {
    std::string what = as;
    if (const auto other = guide_.instead.find(typed); other != guide_.instead.end()) {
      what = other->second;
      used_.insert(typed);
    }
    if (what.empty()) return;
    if (guide_.planned) what = plan_of(what);
    script_ += what + "\n";
    ++commands_;
  }

  void spans(const std::string& line) {
    for (std::size_t at = line.find('`'); at != std::string::npos;) {
      const std::size_t end = line.find('`', at + 1);
      if (end == std::string::npos) return;
      const std::string span = line.substr(at + 1, end - at - 1);
      if (span.starts_with("facegraph ") && span.find("NODE") == std::string::npos) run(span, span);
      if (span.starts_with("--set ")) run(span, guide_.settings + " " + span);
      at = line.find('`', end + 1);
    }
  }

  void end_block(const std::string& language, const std::vector<std::string>& block, const std::string& paragraph) {
    if (language == "json") return json(block, paragraph);
    if (!language.empty() || block.empty()) return;
    if (!is_command(block[0])) {
      for (const std::string& line : block) shown_.push_back(line);
      return;
    }
    std::string command;
    for (const std::string& line : block) {
      if (line.empty()) continue;
      EXPECT_TRUE(!command.empty() || is_command(line)) << guide_.file << ": what kind of a line is this? " << line;
      command += command.empty() ? line : "\n" + line;
      if (line.ends_with("\\")) continue;
      run(command, command);
      command.clear();
    }
  }

  // A graph is written under the name that stands before it, and must be valid.
  void json(const std::vector<std::string>& block, const std::string& paragraph) {
    std::string text;
    for (const std::string& line : block) text += line + "\n";
    auto value = nlohmann::json::parse(text, nullptr, false, true);
    if (value.is_discarded())
      value = nlohmann::json::parse("{" + text + "}", nullptr, false, true);  // part of an object
    EXPECT_FALSE(value.is_discarded()) << guide_.file << ": no JSON:\n" << text;
    if (!value.is_object() || (!value.contains("extends") && !value.contains("nodes"))) return;
    std::smatch name;
    if (!std::regex_search(paragraph, name, std::regex("`([^`]*\\.json)`"))) {
      ADD_FAILURE() << guide_.file << ": a graph has no name before it:\n" << text;
      return;
    }
    const std::string path = guide_.graphs + "/" + name[1].str();
    script_ +=
        "cat > " + path + " <<'END'\n" + text + "END\nfacegraph validate " + path + " " + guide_.graph_settings + "\n";
  }

  const Guide& guide_;
  std::string script_;
  std::vector<std::string> shown_;
  std::set<std::string> used_;
  std::size_t commands_ = 0;
};

class Guides : public test::CommandTest {
 protected:
  void SetUp() override {
    const std::filesystem::path source(FACEGRAPH_SOURCE_DIR);
    std::filesystem::copy(source / "graphs", folder() / "graphs", std::filesystem::copy_options::recursive);
  }

  void follow(const Guide& guide, std::size_t fewest) {
    const Reader reader(guide, test::read_file(std::filesystem::path(FACEGRAPH_SOURCE_DIR) / guide.file));
    EXPECT_GE(reader.commands(), fewest);
    write("guide.sh", "export HOME=" + path("home") + " FACEGRAPH_STORE=" + path("store") +
                          "\nmkdir -p ~/.zfunc\nfacegraph() { echo \"+ facegraph $*\" >&2; " FACEGRAPH_COMMAND
                          " \"$@\"; }\n" +
                          "set -eE\ntrap 'echo \"a line of the guide failed: $BASH_COMMAND\"' ERR\n" + reader.script());
    const test::Ended ended = wait(start({path("guide.sh")}, "/bin/bash"));
    EXPECT_EQ(ended.code, 0) << guide.file;
    const std::vector<std::string> said = test::lines_of(ended.output);
    for (const std::string& line : reader.shown()) {
      const std::regex pattern(pattern_of(line));
      EXPECT_TRUE(std::any_of(said.begin(), said.end(),
                              [&](const std::string& other) { return std::regex_match(trimmed(other), pattern); }))
          << guide.file << " shows what is not said: " << line;
    }
    if (HasFailure())
      ADD_FAILURE() << "what was said ends with\n"
                    << ended.output.substr(ended.output.size() - std::min<std::size_t>(ended.output.size(), 4000));
  }

  static std::string trimmed(const std::string& line) {
    const std::size_t first = line.find_first_not_of(' ');
    return first == std::string::npos ? "" : line.substr(first, line.find_last_not_of(' ') + 1 - first);
  }

  // "..." stands for anything, a number with three decimals or more for any number.
  static std::string pattern_of(const std::string& line) {
    std::string pattern = std::regex_replace(trimmed(line), std::regex("[.^$|()\\[\\]{}*+?\\\\]"), "\\$&");
    pattern = std::regex_replace(pattern, std::regex("\\\\.\\\\.\\\\."), ".*");
    pattern = std::regex_replace(pattern, std::regex(" +"), " +");
    return std::regex_replace(pattern, std::regex("[0-9]+\\\\.[0-9]{3,}"), "[-+.e0-9]+");
  }

  // A small film of a head that speaks, its head and its sound.
  void make_material() {
    write("line.txt", "Good morning.");
    write("make.json", "{\"extends\": \"" + graph("speech/talk.json") + R"(",
      "nodes": {"pictures": {"params": {"width_px": 160, "height_px": 160}},
                "wav": {"node": "export.wav", "inputs": {"audio": "sound"}}},
      "outputs": {"talk.glb": null, "talk.csv": null, "talk.TextGrid": null, "talk.phones.json": null,
                  "talk.sheet.png": null, "talk.mp4": null, "clip.mp4": "video", "head.glb": "gltf", "line.wav": "wav"}})");
    const test::Ended made = command({"run", "make.json", "--set", "text=line.txt", "--out", ".", "--quiet"});
    ASSERT_EQ(made.code, 0) << made.output;
  }
};

TEST_F(Guides, TheReadmeRuns) {
  make_material();
  std::filesystem::rename(folder() / "clip.mp4", folder() / "clip.mpg");
  write("clip.landmarks.json",
        R"({"image_size": [160, 160], "points": {"mouth": [80, 104], "nose": [80, 84], "eye": [66, 66]}})");
  write("fix.json", R"([{"frame": 10, "point": "mouth", "xy": [81, 105]}])");
  for (const char* take : {"one", "two"}) write(std::string("takes/") + take + ".wav", read("line.wav"));
  write("takes/one.txt", "Good morning.");
  follow(
      {.file = "README.md",
       .settings = "facegraph plan graphs/speech/talk.json --set text=line.txt --set rig=head.glb",
       .instead = {{"./demo      # installs what is missing, builds, and makes a head speak: six files in out/demo",
                    ""},
                   {"./check     # installs what is missing, builds everything and runs all tests", ""},
                   {"facegraph validate graph.json", "facegraph validate graphs/speech/talk.json --set text=line.txt"}},
       .graphs = "graphs/speech",
       .graph_settings = "--set text=line.txt"},
      17);
  for (const char* made : {"out/talk.glb", "out/tracks.csv", "out/overlay.mp4", "sweep/sweep.csv", "compare.html",
                           "talk.html", "frame17.png", "names.json"})
    EXPECT_TRUE(exists(made)) << made;
}

TEST_F(Guides, ExperimentsRun) {
  follow(
      {.file = "docs/experiments.md",
       .settings = "facegraph plan graphs/speech/talk.json --set text=line.txt",
       // A name; what tests/end_to_end/experiments_test.cpp does.
       .instead = {{"facegraph get", ""}, {"facegraph sweep graph.json", ""}, {"facegraph compare a.json b.json", ""}}},
      14);
  for (const char* made :
       {"sweep/sweep.csv", "compare.html", "talk.html", "talk.svg", "talk.dot", "mine/talk.json", "checked/names.json"})
    EXPECT_TRUE(exists(made)) << made;
}

TEST_F(Guides, TheFirstHourEndsWithAHeadThatSaysARecording) {
  make_material();
  follow({.file = "docs/first-hour.md",
          .settings = "facegraph plan talk.json --set text=line.txt --set rig=head.glb",
          .instead = {{"./demo", ""},
                      {"export PATH=$PWD/build/release/bin:$PATH", ""},
                      {"sudo apt install ./facegraph_0.1.0_amd64.deb", ""},
                      {"cd mine", "cd mine; cp ../line.wav ../line.txt ."},
                      {"facegraph get talk.json speak.worst_closure_mm ...",
                       "facegraph get talk.json speak.worst_closure_mm --set text=line.txt"},
                      {"--set names=...", ""},
                      {"--set phones=talk.TextGrid",
                       "facegraph plan talk.json --set audio=line.wav --set phones=out/talk.TextGrid"}},
          .graphs = "."},
         16);
  for (const char* made : {"mine/first/talk.mp4", "mine/out/talk.glb", "mine/frames/talk.usda",
                           "mine/frames/talk/0.obj", "mine/sweep/sweep.csv", "mine/compare.html", "mine/report.html"})
    EXPECT_TRUE(exists(made)) << made;
}

// What takes minutes, or pictures and scans that only a reader has, is laid out: graphs, files and settings are there.
TEST_F(Guides, CommandsOfTheOtherPagesFitTheirGraphs) {
  for (const char* file : {"sfm_shape_3448.bin",
                           "expression_blendshapes_3448.bin",
                           "clip.mpg",
                           "clip.mp4",
                           "clip.txt",
                           "clip.landmarks.json",
                           "clip.points.json",
                           "clip.phones.json",
                           "fix.json",
                           "line.txt",
                           "line.wav",
                           "portrait.png",
                           "portrait.landmarks.json",
                           "model.npz",
                           "points.npy",
                           "basis.npy",
                           "targets.npy",
                           "means.npy",
                           "variances.npy",
                           "reference.npy",
                           "examples.npy",
                           "faces.npy",
                           "weights.npy",
                           "takes/one.wav",
                           "takes/one.txt",
                           "stream/depth/one/0.png",
                           "stream/sound/one.wav",
                           "FaceXModel/generic_neutral_mesh.obj"})
    write(file, "");
  write("FOLDER/0.json", "");
  const std::string talk = "facegraph plan graphs/speech/talk.json --set text=line.txt";
  const std::string face =
      "facegraph plan graphs/laser_scan/track.json --set video=clip.mp4 --set points=clip.landmarks.json "
      "--set rig=FaceXModel";
  const std::string film = "facegraph plan graphs/phantom/video.json";
  const std::string map =
      "facegraph plan graphs/video_to_mesh/speak.json --set video=clip.mpg --set points=clip.landmarks.json "
      "--set text=clip.txt --set new_text=line.txt";
  const std::string track =
      "facegraph plan graphs/video_to_mesh/track.json --set video=clip.mpg --set points=clip.landmarks.json";
  const std::string any = "facegraph plan graphs/phantom/scan_stream.json";
  const std::vector<std::pair<Guide, std::size_t>> pages = {
      {{.file = "docs/tracking.md",
        .settings = track,
        .instead =
            {{"facegraph annotate --clip clip.mpg --points lips18 --out page.html", "facegraph annotate --help"},
             {"facegraph annotate --clip clip.mpg --start clip.landmarks.json --corrections fix.json --out again.html",
              "facegraph annotate --help"}}},
       7},
      {{.file = "docs/speech.md", .settings = talk}, 10},
      {{.file = "docs/scan-streams.md", .settings = any}, 8},
      {{.file = "docs/video-to-mesh.md", .settings = map, .instead = {{"--set smoothness", ""}}}, 8},
      {{.file = "docs/morphable-model.md", .settings = face, .instead = {{"facegraph get graph.json fit", face}}}, 8},
      {{.file = "docs/speech-to-video.md", .settings = any}, 5},
      {{.file = "docs/phantom.md",
        .settings = film,
        .instead = {{"facegraph get graph.json 'scan.scan[1/17]' -o scan.json", any}}},
       3},
      {{.file = "docs/metrics.md", .settings = talk}, 1},
      {{.file = "docs/solvers.md", .settings = any}, 4}};
  for (auto [guide, fewest] : pages) {
    guide.planned = true;
    follow(guide, fewest);
  }
}

TEST_F(Guides, TheLineToWhichANewNodeIsAddedIsThere) {
  const std::filesystem::path source(FACEGRAPH_SOURCE_DIR);
  std::smatch line;
  const std::string guide = test::read_file(source / "docs/writing-a-node.md");
  ASSERT_TRUE(std::regex_search(guide, line, std::regex("\n(node\\(.*) clamp_number\\)\n")));
  EXPECT_NE(test::read_file(source / "plugins/toy/CMakeLists.txt").find("\n" + line[1].str() + ")\n"),
            std::string::npos)
      << line[1].str();
}

TEST_F(Guides, ASweepAndAReportOfEachSystemRun) {
  follow({.file = "docs/systems.md", .settings = "facegraph plan graphs/speech/talk.json --set text=line.txt"}, 11);
  for (const char* name : {"speech", "video", "scans", "laser", "pictures"}) {
    EXPECT_TRUE(exists(std::string(name) + "/sweep.csv")) << name;
    EXPECT_TRUE(exists(std::string(name) + ".html")) << name;
  }
}

}  // namespace
