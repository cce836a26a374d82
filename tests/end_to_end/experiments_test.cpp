// SPDX-License-Identifier: Apache-2.0
// Sweeps, comparisons, pictures and reports, as a person asks for them.
#include <nlohmann/json.hpp>

#include "tests/end_to_end/command.h"

namespace {

using test::operator+;

class Experiments : public test::CommandTest {
 protected:
  void SetUp() override {
    for (int i = 1; i <= 4; ++i) write("frames/" + std::to_string(i) + ".txt", "frame " + std::to_string(i));
    write("graph.json", R"({
  "facegraph": 1, "doc": "Counts & adds <letters>",
  "params": {"folder": {"type": "path", "default": "frames"}, "extra": {"type": "real", "default": 0}},
  "nodes": {
    "files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
    "texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
    "loud": {"node": "toy.upper", "inputs": {"text": "texts"}, "params": {"mode": "upper"}},
    "all": {"node": "toy.concat", "inputs": {"texts": "loud"}},
    "size": {"node": "toy.length", "inputs": {"text": "all"}},
    "sizes": {"node": "toy.length", "inputs": {"text": "loud"}},
    "total": {"node": "toy.sum_all", "inputs": {"numbers": "sizes"}},
    "score": {"node": "toy.add", "inputs": {"a": "size", "b": "total"}, "params": {"amount": "${extra}"}},
    "shown": {"node": "toy.number_text", "inputs": {"number": "score"}},
    "file": {"node": "toy.write_text", "inputs": {"text": "shown"}},
    "page": {"node": "toy.write_text", "inputs": {"text": "all"}}
  },
  "outputs": {"score.txt": "file", "page.txt": "page"},
  "sweep": {"vary": {"extra": [5, -5], "all.separator": [", "]}, "metric": "score.sum"}
})");
  }
  // Without what a run says of its progress.
  static std::string table(const test::Ended& ended) {
    std::string text;
    for (const std::string& line : test::lines_of(ended.output))
      if (line.find("tasks run") == std::string::npos && !line.starts_with("note: ")) text += line + "\n";
    return text;
  }
};

TEST_F(Experiments, ASweepSortsByItsMetricAndListsWhatDiffers) {
  const test::Ended ended = command({"sweep", "graph.json", "--vary", "extra=10,-10,0", "--vary", "loud.mode=upper",
                                     "--metric", "score.sum", "--metric", "size", "--out", "out", "--quiet"});
  EXPECT_EQ(ended.code, 0) << ended.output;
  EXPECT_EQ(table(ended),
            "extra  score.sum  size\n-10           46    28\n0             56    28\n10            66    28\n");
  EXPECT_EQ(read("out/sweep.csv"), "variant,extra,score.sum,size,failure\n2,-10,46,28,\n3,0,56,28,\n1,10,66,28,\n");
  const auto json = nlohmann::json::parse(read("out/sweep.json"));
  EXPECT_EQ(json["variants"].size(), 3u);
  EXPECT_EQ(json["variants"][0]["settings"]["extra"], "-10");
  EXPECT_EQ(json["variants"][0]["metrics"]["score.sum"], 46);
  // 4 read, 4 upper, 4 lengths, concat, length, sum: once. An addition each.
  EXPECT_EQ(json["tasks"]["run"], 15 + 3);
  const test::Ended again =
      command({"sweep", "graph.json", "--vary", "extra=10,-10,0", "--metric", "score.sum", "--largest-first"});
  EXPECT_EQ(table(again), "extra  score.sum\n10            66\n0             56\n-10           46\n");
  EXPECT_NE(again.output.find("3 variants, 0 failed; 0 tasks run"), std::string::npos) << again.output;
}

TEST_F(Experiments, ASweepIsWrittenDownInTheGraph) {
  const test::Ended ended = command({"sweep", "graph.json", "--quiet"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(table(ended), "extra  score.sum\n-5            57\n5             67\n");
  EXPECT_EQ(command({"run", "graph.json", "--out", "out", "--quiet"}).code, 0);
  EXPECT_EQ(read("out/score.txt"), "56");  // a run does not look at it
}

TEST_F(Experiments, VariantsThatFailAreRows) {
  const test::Ended ended =
      command({"sweep", "graph.json", "--vary", "loud.node=toy.upper,toy.fail,toy.length,toy.nothing", "--vary",
               "all.separator= ", "--metric", "size", "--out", "out", "--quiet"});
  EXPECT_EQ(ended.code, 1);
  const auto rows = test::lines_of(read("out/sweep.csv"));
  ASSERT_EQ(rows.size(), 5u) << ended.output;
  EXPECT_EQ(rows[1], "1,toy.upper,31,");
  EXPECT_EQ(rows[2], "2,toy.fail,31,");
  EXPECT_NE(rows[3].find("3,toy.length,,"), std::string::npos) << rows[3];
  EXPECT_NE(rows[4].find("--vary loud.node: no node is called"), std::string::npos) << rows[4];
}

TEST_F(Experiments, ASweepPublishesTheOutputsOfEachVariantWhereAsked) {
  EXPECT_EQ(command({"sweep", "graph.json", "--vary", "extra=1,2", "--outputs", "--out", "out", "--quiet"}).code, 0);
  EXPECT_EQ(read("out/variant1/score.txt"), "57");
  EXPECT_EQ(read("out/variant2/score.txt"), "58");
}

TEST_F(Experiments, ASweepSaysWhatIsWrongWithIt) {
  const auto refuses = [&](const test::Words& words, const std::string& text) {
    const test::Ended ended = command(test::Words{"sweep", "graph.json"} + words);
    EXPECT_EQ(ended.code, 2);
    EXPECT_EQ(ended.output, text);
  };
  refuses({"--vary", "extra=1", "--metric", "scor"},
          "error: command line: --metric scor: the graph has no node 'scor' (did you mean 'score'?)\n");
  refuses({"--vary", "extra=1", "--metric", "score.som"},
          "error: command line: --metric score.som: node 'score' has no output 'som' (did you mean 'sum'?)\n");
  refuses({"--vary", "extra=1", "--metric", "score.total"},
          "error: command line: --metric score.total: node 'score' has no output 'total'; it has 'sum'\n");
  refuses({"--vary", "extra"}, "error: command line: --vary extra: expected NAME=VALUE,VALUE,...\n");
  refuses({"--vary", "extra=1", "--set", "extra=2"}, "error: command line: extra is varied, and given another time\n");
  refuses({"--vary", "loud.mood=1,2"},
          "command line: --vary loud.mood: the node 'loud' has no parameter 'mood'; it has 'mode'\n"
          "none of the 2 variants is a valid graph; nothing was run\n");
}

TEST_F(Experiments, ComparesAGraphWithItselfUnderOtherSettings) {
  const test::Ended ended = command({"compare", "graph.json", "--set-b", "extra=2.5", "--quiet"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.output,
            "score\n  amount: 0 -> 2.5\n  sum: 56 -> 58.5; by at most 2.5\n"
            "shown\n  text: \"56\" -> \"58.5\"\n"
            "file\n  file: differs; 1 of 1 lines, the first is line 1\n"
            "8 nodes are the same in both\n");
  const test::Ended same = command({"compare", "graph.json", "graph.json", "--quiet"});
  EXPECT_EQ(same.output, "11 nodes are the same in both\n");
  EXPECT_EQ(command({"compare", "graph.json"}).code, 2);
}

TEST_F(Experiments, ComparesTwoGraphsElementByElement) {
  write("other.json", R"({"extends": "graph.json", "nodes": {
    "loud": {"params": {"mode": "lower"}},
    "extra_page": {"node": "toy.write_text", "inputs": {"text": "shown"}}}, "outputs": {"score.txt": "extra_page"}})");
  write("frames/2.txt", "22");
  const test::Ended ended = command({"compare", "graph.json", "other.json", "--all", "--json", "--quiet"});
  ASSERT_EQ(ended.code, 0) << ended.output;
  const auto json = nlohmann::json::parse(ended.output);
  const auto entry = [&](const std::string& name) {
    for (const auto& node : json["nodes"])
      if (node["node"] == name) return node;
    return nlohmann::json();
  };
  EXPECT_EQ(entry("loud")["changes"][0]["what"], "mode");
  EXPECT_EQ(entry("loud")["results"]["changed"]["elements"], nlohmann::json({"1", "3", "4"}));
  EXPECT_EQ(entry("loud")["results"]["changed"]["equal"], 1);
  EXPECT_EQ(entry("extra_page")["only_in"], "B");
  EXPECT_EQ(entry("file")["only_in"], "A");
  EXPECT_TRUE(entry("sizes").is_null());
}

TEST_F(Experiments, ComparesTwoFoldersOfResults) {
  for (const char* side : {"a", "b"}) {
    const std::string folder = side, seed = folder == "a" ? "1" : "2";
    write(folder + ".json", R"({"facegraph": 1, "nodes": {
      "made": {"node": "phantom.make_backdrop", "params": {"width_px": 64, "height_px": 48, "seed": )" +
                                seed + R"(}},
      "file": {"node": "export.png", "inputs": {"image": "made"}}}, "outputs": {"made.png": "file"}})");
    EXPECT_EQ(command({"run", folder + ".json", "--out", folder, "--quiet"}).code, 0);
    write(folder + "/same.txt", "the same");
    write(folder + "/deep/lines.txt", "one\ntwo " + folder + "\nthree\n");
    write(folder + "/numbers.json", folder == "a" ? R"({"x": [1, 2]})" : R"({"x": [1, 2.5]})");
    write(folder + "/numbers.csv", folder == "a" ? "name,x\np,1\nq,2\n" : "name,x\np,1\nq,4\n");
    write(folder + "/blob.bin", folder == "a" ? "12" : "345");
    write(folder + "/only_" + folder + ".txt", "x");
  }
  const test::Ended ended = command({"compare", "a", "b", "--out", "page.html", "--quiet"});
  EXPECT_EQ(ended.code, 0) << ended.output;
  const auto lines = test::lines_of(ended.output);
  ASSERT_EQ(lines.size(), 13u) << ended.output;
  EXPECT_EQ(lines[0] + lines[1], "blob.bin  content: differs; 2 B and 3 B");
  EXPECT_EQ(lines[2] + lines[3], "deep/lines.txt  content: differs; 1 of 3 lines, the first is line 2");
  EXPECT_EQ(lines[4] + lines[5].substr(0, 31), "made.png  content: differs; rms_levels ");
  EXPECT_EQ(lines[6] + lines[7], "numbers.csv  content: differs; largest 2, only_in_a 0, only_in_b 0, x 2");
  EXPECT_EQ(lines[8] + lines[9], "numbers.json  content: differs; by at most 0.5 at /x/1, rms 0.353553");
  EXPECT_EQ(lines[10] + lines[11], "only_a.txt: only in Aonly_b.txt: only in B");
  EXPECT_EQ(lines[12], "1 file is the same in both");
  const std::string page = read("page.html");
  EXPECT_NE(page.find("src=\"data:image/png;base64,"), std::string::npos);
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  const test::Ended one = command({"compare", "a/numbers.json", "b/numbers.json", "--quiet"});
  EXPECT_EQ(one.output,
            "numbers.json\n  content: differs; by at most 0.5 at /x/1, rms 0.353553\n"
            "0 files are the same in both\n");
  EXPECT_EQ(command({"compare", "a", "b/numbers.json"}).output,
            "error: command line: a and b/numbers.json: expected two folders or two files\n");
  EXPECT_EQ(command({"compare", "a", "b", "--set", "x=1"}).code, 2);
  EXPECT_EQ(command({"compare", "a", "c"}).output, "error: command line: c does not exist\n");
}

TEST_F(Experiments, ComparesValuesAsTheirTypesSay) {
  write("backdrop.json", R"({"facegraph": 1, "nodes": {
    "made": {"node": "phantom.make_backdrop", "params": {"width_px": 64, "height_px": 48}},
    "file": {"node": "export.png", "inputs": {"image": "made"}}}, "outputs": {"made.png": "file"}})");
  const test::Ended ended =
      command({"compare", "backdrop.json", "--set-b", "made.seed=9", "--json", "--out", "page.html", "--quiet"});
  ASSERT_EQ(ended.code, 0) << ended.output;
  const auto json = nlohmann::json::parse(ended.output);
  const auto& image = json["nodes"][0]["results"]["image"];
  EXPECT_GT(image["measures"]["rms_levels"], 1);
  EXPECT_GT(image["measures"]["differing_percent"], 50);
  // The file is compared by what it shows, not by its bytes.
  EXPECT_EQ(json["nodes"][1]["results"]["file"]["measures"], image["measures"]);
  EXPECT_NE(read("page.html").find("picture"), std::string::npos);
}

TEST_F(Experiments, DrawsAGraph) {
  const test::Ended svg = command({"graph", "graph.json", "--svg"});
  EXPECT_EQ(svg.code, 0);
  EXPECT_EQ(svg.output.substr(0, 4), "<svg");
  for (const char* text :
       {">texts<", ">toy.read_text<", ">score.txt<", ">frames<", "texts.text \u2192 text (Seq&lt;text&gt;)"})
    EXPECT_NE(svg.output.find(text), std::string::npos) << text;
  const test::Ended dot = command({"graph", "graph.json", "--dot"});
  EXPECT_NE(dot.output.find("[label=\"score\\ntoy.add\"]"), std::string::npos) << dot.output;
  EXPECT_EQ(command({"graph", "graph.json", "-o", "picture.svg"}).code, 0);
  EXPECT_EQ(read("picture.svg"), svg.output);
}

TEST_F(Experiments, AReportIsOnePageThatNeedsNothingElse) {
  const test::Ended ended =
      command({"report", "graph.json", "--set", "all.separator=a 'b'<", "--out", "pages/page.html", "--quiet"});
  EXPECT_EQ(ended.code, 0) << ended.output;
  const std::string page = read("pages/page.html");
  for (const char* text :
       {"<svg", "Counts &amp; adds &lt;letters&gt;", "id=\"node-score\"", "19 tasks run", "class=\"curve\"", "FRAME 1",
        "facegraph run graph.json --set 'all.separator=a '\\''b'\\''&lt;' --out out", "(default &quot;&quot;)",
        "name=\"viewport\"", "4 values, 7 to 7, mean 7"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  for (const char* text : {"src=\"http", "href=\"http", "url(http", "@import", "<script"})
    EXPECT_EQ(page.find(text), std::string::npos) << text;
  EXPECT_EQ(command({"report", "graph.json", "--set", "all.separator=a 'b'<", "--out", "again.html", "--quiet"}).code,
            0);
  EXPECT_NE(read("again.html").find("4 reused"), std::string::npos);
}

TEST_F(Experiments, AReportOfARunThatFailedSaysWhy) {
  write("frames/2.txt", "bad");
  write("failing.json",
        R"({"extends": "graph.json", "nodes": {"loud": {"node": "toy.fail", "params": {"mode": null}}}})");
  const test::Ended ended = command({"report", "failing.json", "--quiet"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(read("report.html").find("class=\"bad\">loud[2] (toy.fail): "), std::string::npos);
}

TEST_F(Experiments, NewCopiesStarterGraphsThatAreValid) {
  for (const char* from : {"speech", "laser"}) {
    const std::string folder = std::string("mine/") + from;
    const test::Ended ended = command({"new", folder, "--from", from});
    EXPECT_EQ(ended.code, 0) << ended.output;
    EXPECT_TRUE(exists(folder + "/.vscode/graph.schema.json"));
  }
  write("line.txt", "Bob may move.");
  EXPECT_EQ(command({"validate", "mine/speech/talk.json", "--set", "text=line.txt"}).code, 0);
  EXPECT_TRUE(exists("mine/laser/speech/visemes.json"));
  EXPECT_EQ(read("mine/laser/reanimate.json").find("../"), std::string::npos);
  const test::Ended again = command({"new", "mine/speech", "--from", "speech"});
  EXPECT_EQ(again.code, 2);
  EXPECT_EQ(again.output, "error: command line: mine/speech is there already: name a new or an empty folder\n");
  const test::Ended unknown = command({"new", "x", "--from", "speach"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.output.find("(did you mean 'speech'?)"), std::string::npos) << unknown.output;
}

TEST_F(Experiments, TheDoctorFindsNothingWrongHereAndSaysWhatIs) {
  const test::Ended ended = command({"doctor"});
  EXPECT_NE(ended.output.find("ok       store " + path("store")), std::string::npos) << ended.output;
  EXPECT_NE(ended.output.find("toy"), std::string::npos);
  write("plugins/broken.so", "no library");
  const test::Ended broken = command({"--plugins", "plugins", "doctor"});
  EXPECT_EQ(broken.code, 1);
  EXPECT_NE(broken.output.find("problem  plugin plugins/broken.so: "), std::string::npos) << broken.output;
}

TEST_F(Experiments, TheDoctorLooksAtAFileOfOnesOwn) {
  write("head.json", R"({"facegraph": 1, "nodes": {
    "head": {"node": "phantom.make_head"},
    "weights": {"node": "decode.animation", "inputs": {"file": "${table}"}},
    "glb": {"node": "export.gltf", "inputs": {"rig": "head", "frames": "weights.weights", "timeline": "weights.timeline"}}},
    "params": {"table": {"type": "path", "default": "still.csv"}}, "outputs": {"head.glb": "glb"}})");
  write("still.csv", "Timecode,JawOpen\n00:00:00:00,0\n00:00:00:01,0\n");
  ASSERT_EQ(command({"run", "head.json", "--out", "out", "--quiet"}).code, 0);
  const test::Ended ended = command({"doctor", "out/head.glb", "--out", "checked"});
  EXPECT_EQ(ended.code, 0) << ended.output;
  EXPECT_NE(ended.output.find("ok       out/head.glb\n         head.glb: 52 shapes; 52 of ARKit's 52 are there\n"),
            std::string::npos)
      << ended.output;
  EXPECT_EQ(read("checked/names.json"), "{}\n");
  const test::Ended again = command({"doctor", "out/head.glb", "--out", "checked"});
  EXPECT_NE(again.output.find("checked/names.json is there already and was left alone"), std::string::npos);
  std::filesystem::copy_file(folder() / "out/head.glb", folder() / "avatar.vrm");
  EXPECT_EQ(command({"doctor", "avatar.vrm", "--out", "avatar"}).code, 0);
  write("bad.glb", "no");
  EXPECT_EQ(command({"doctor", "bad.glb", "--out", "other"}).code, 1);
  EXPECT_EQ(command({"doctor", "missing.glb"}).code, 2);
  const test::Ended unknown = command({"doctor", "still.csv"});
  EXPECT_EQ(unknown.output, "error: command line: doctor still.csv: expected .glb, .gltf, .vrm, a folder\n");
}

TEST_F(Experiments, BashCompletesCommandsOptionsAndFiles) {
  const test::Ended script = command({"completion", "bash"});
  ASSERT_EQ(script.code, 0);
  write("complete.sh", script.output + R"(
complete_words() { COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); compopt() { :; }; _facegraph; echo "${COMPREPLY[@]}"; }
complete_words facegraph sw
complete_words facegraph sweep --vary x=1 --met
complete_words facegraph cache p
complete_words facegraph run gra
)");
  const test::Ended ended = wait(start({path("complete.sh")}, "/bin/bash"));
  const auto lines = test::lines_of(ended.output);
  ASSERT_EQ(lines.size(), 4u) << ended.output;
  EXPECT_EQ(lines[0], "sweep");
  EXPECT_EQ(lines[1], "--metric");
  EXPECT_EQ(lines[2].substr(0, 3), "pin");
  EXPECT_EQ(lines[3], "graph.json");
  EXPECT_EQ(command({"completion", "zsh"}).output.substr(0, 19), "#compdef facegraph\n");
  EXPECT_EQ(command({"completion", "fish"}).code, 2);
}

// In an interactive shell of its own, as keys are pressed there.
TEST_F(Experiments, ZshCompletesCommandsOptionsNodesAndFiles) {
  if (!std::filesystem::exists("/usr/bin/zsh")) GTEST_SKIP() << "needs zsh";
  const test::Ended script = command({"completion", "zsh"});
  ASSERT_EQ(script.code, 0);
  write("fpath/_facegraph", script.output);
  write("bin/facegraph", "#!/bin/sh\nexec " FACEGRAPH_COMMAND " \"$@\"\n");
  std::filesystem::permissions(folder() / "bin/facegraph", std::filesystem::perms::owner_all);
  // Waits for what is to appear, and no longer.
  write("complete.zsh", "cd " + folder().string() + R"(
zmodload zsh/zpty
wait_for() {
  local all= out= i
  for i in {1..400}; do
    while zpty -r -t z out; do all+=$out; done
    [[ $all == *$1* ]] && return 0
    sleep 0.05
  done
  print -r -- "no $1 in: $all"
}
zpty z "env TERM=dumb HOME=$PWD PATH=$PWD/bin:$PATH zsh -f -i"
zpty -w z 'PS1= ; fpath=($PWD/fpath $fpath); autoload -U compinit; compinit -u -D; echo RE''ADY'
wait_for READY
try() {
  zpty -n -w z "$1"$'	'
  wait_for "$2" && print -r -- "$1 -> $2"
  zpty -n -w z $'\C-u'
}
try 'facegraph swe' 'facegraph sweep '
try 'facegraph sweep --vary x=1 --met' '--metric '
try 'facegraph cache unp' 'cache unpin '
try 'facegraph describe toy.runn' 'toy.running_sum '
try 'facegraph run gra' 'graph.json '
zpty -d z
)");
  const test::Ended ended = wait(start({path("complete.zsh")}, "/usr/bin/zsh"));
  EXPECT_EQ(test::lines_of(ended.output).size(), 5u) << ended.output;
  EXPECT_EQ(ended.output.find("no "), std::string::npos) << ended.output;
}

// Graphs that compare or check files are valid, as those of graphs/ are.
TEST_F(Experiments, GraphsThatPluginsShipForFilesAreValid) {
  write("file.txt", "x");
  std::size_t graphs = 0;
  for (const char* kind : {"differences", "checks"})
    for (const auto& entry : std::filesystem::directory_iterator(std::string(FACEGRAPH_PLUGIN_DIR) + "/" + kind)) {
      test::Words words = {"validate", entry.path().string()};
      if (std::string(kind) == "differences")
        words = words + test::Words{"--set", "a=file.txt", "--set", "b=file.txt"};
      else
        words = words + test::Words{"--set", "file=file.txt"};
      const test::Ended ended = command(words);
      EXPECT_EQ(ended.code, 0) << entry.path() << ended.output;
      ++graphs;
    }
  EXPECT_GE(graphs, 15u);
}

}  // namespace
