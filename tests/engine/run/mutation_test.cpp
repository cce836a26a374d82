// SPDX-License-Identifier: Apache-2.0
// The mutation matrix: what reruns exactly what it affects, and what reruns nothing; and explain names the leaf cause.
#include <cstdlib>

#include "tests/support/toy_run.h"

namespace {

// numbers (cheap) -> more (gathered below) and, beside it, a subgraph: files -> texts -> sub/loud -> sub/all -> lengths
// -> twice.
class Mutation : public test::ToyRun {
 protected:
  Mutation() { use("base"); }

  // The variant of the plugin "vary" that runs from now on.
  void use(const std::string& variant) {
    vary_ = std::make_unique<engine::Plugins>(std::vector<std::string>{
        FACEGRAPH_PLUGIN_DIR, std::string(FACEGRAPH_PLUGIN_DIR) + "/../../../tests/plugins/" + variant});
    ASSERT_NE(vary_->find("vary.twice"), nullptr);
  }

  void SetUp() override {
    write_frames(6);
    write("seed/first.txt", "seed text");
    write("inner.json", R"({"facegraph": 1, "inputs": {"texts": "Seq<text>"},
"nodes": {"loud": {"node": "toy.upper", "inputs": {"text": "@texts"}},
          "all": {"node": "toy.concat", "inputs": {"texts": "loud"}}},
"outputs": {"joined": "all"}})");
    write("graph.json", text_);
  }

  engine::RunResult run_it(engine::RunOptions options = {}, const std::string& path = "graph.json") {
    options.out_folder = (folder() / "out").string();
    options.observer = [&](const engine::RunEvent& event) {
      if (event.kind == engine::RunEvent::Kind::finished)
        ran_.push_back(event.element.empty() ? event.node : event.node + "[" + event.element + "]");
    };
    ran_.clear();
    const engine::RunResult result = engine::run_graph(read_it(path), *vary_, *store_, options);
    EXPECT_EQ(result.failures, std::vector<std::string>{});
    std::sort(ran_.begin(), ran_.end());
    return result;
  }
  engine::Graph read_it(const std::string& path = "graph.json") {
    engine::GraphReading reading =
        engine::read_graph((folder() / path).string(), {}, folder().string(), test::context_of(*vary_));
    for (const engine::Problem& problem : reading.problems) ADD_FAILURE() << problem.line();
    return reading.graph;
  }
  void edit(const std::string& from, const std::string& to) {
    const std::size_t at = text_.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text_.replace(at, from.size(), to);
    write("graph.json", text_);
  }
  // The first cause of the end's rerun.
  std::string cause() {
    const auto explained = engine::explain_node(read_it(), *vary_, *store_, "end", "");
    if (explained.size() != 1 || explained[0].causes.empty()) return "none";
    return explained[0].causes[0].task + ": " + explained[0].causes[0].what;
  }
  void expect_nothing_runs() {
    const engine::RunResult result = run_it();
    EXPECT_EQ(result.tasks.run, 0u);
    EXPECT_EQ(ran_, Names{});
  }
  using Names = std::vector<std::string>;

  std::string text_ = R"({"facegraph": 1,
"params": {"folder": {"type": "path", "default": "frames"}},
"nodes": {
  "files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
  "texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
  "sub": {"graph": "inner.json", "inputs": {"texts": "texts"}},
  "length": {"node": "toy.length", "inputs": {"text": "sub.joined"}},
  "ids": {"node": "seq.ids", "inputs": {"sequence": "files"}},
  "dice": {"node": "toy.random_number", "inputs": {"id": "ids"}, "params": {"seed": 1}},
  "luck": {"node": "toy.sum_all", "inputs": {"numbers": "dice"}},
  "count": {"node": "toy.count_up", "params": {"count": 5}},
  "blobs": {"node": "toy.cheap_blob", "inputs": {"number": "count"}, "params": {"size_mb": 0.001}},
  "bytes": {"node": "toy.total_size", "inputs": {"blobs": "blobs"}},
  "both": {"node": "toy.add", "inputs": {"a": "length", "b": "bytes"}},
  "three": {"node": "toy.add", "inputs": {"a": "both", "b": "luck"}},
  "twice": {"node": "vary.twice", "inputs": {"number": "three"}},
  "shown": {"node": "toy.number_text", "inputs": {"number": "twice"}},
  "seed": {"node": "toy.read_text", "inputs": {"file": {"file": "seed/first.txt"}}},
  "tail": {"node": "toy.pair", "inputs": {"left": "shown", "right": "seed"}},
  "end": {"node": "toy.write_text", "inputs": {"text": "tail"}}
},
"outputs": {"end.txt": "end"}})";
  std::unique_ptr<engine::Plugins> vary_;
  std::vector<std::string> ran_;
};

// --- what reruns exactly what it affects
// -----------------------------------------------------------------------------------

TEST_F(Mutation, AParameterRerunsItsNodeAndWhatChanges) {
  run_it();
  edit(R"("seed": 1)", R"("seed": 2)");
  EXPECT_EQ(cause(), "dice[1]: parameter seed: 1 -> 2");
  run_it();
  EXPECT_EQ(ran_, (Names{"dice[1]", "dice[2]", "dice[3]", "dice[4]", "dice[5]", "dice[6]", "end", "luck", "shown",
                         "tail", "three", "twice"}));
}

TEST_F(Mutation, AByteOfAnInputFarUpstreamThroughSubgraphAndGather) {
  run_it();
  write("frames/4.txt", "frame 4 is longer");
  EXPECT_EQ(cause().substr(0, 15), "texts[4]: file ");
  run_it();
  EXPECT_EQ(ran_,
            (Names{"both", "end", "length", "shown", "sub/all", "sub/loud[4]", "tail", "texts[4]", "three", "twice"}));
}

TEST_F(Mutation, AByteOfAFileParameter) {
  run_it();
  write("seed/first.txt", "seed texT");
  EXPECT_EQ(cause().substr(0, 11), "seed: file ");
  run_it();
  EXPECT_EQ(ran_, (Names{"end", "seed", "tail"}));
}

TEST_F(Mutation, AParameterOfACheapNode) {
  run_it();
  edit(R"("size_mb": 0.001)", R"("size_mb": 0.002)");
  EXPECT_EQ(cause(), "blobs[0]: parameter size_mb: 0.001 -> 0.002");
  run_it();
  EXPECT_EQ(ran_, (Names{"both", "bytes", "end", "shown", "tail", "three", "twice"}));
}

TEST_F(Mutation, AnOverrideOfOneElement) {
  run_it();
  edit(R"("params": {"seed": 1})", R"("params": {"seed": 1}, "overrides": {"3": {"seed": 9}})");
  EXPECT_EQ(cause(), "dice[3]: parameter seed: 1 -> 9");
  run_it();
  EXPECT_EQ(ran_, (Names{"dice[3]", "end", "luck", "shown", "tail", "three", "twice"}));
}

TEST_F(Mutation, PluginCodeRerunsItsTasksAndNothingAfterWhereResultsAgree) {
  run_it();
  use("code");
  EXPECT_EQ(cause().substr(0, 27), "twice: plugin vary changed:");
  run_it();
  EXPECT_EQ(ran_, Names{"twice"});
}

TEST_F(Mutation, ANodeVersionRerunsItsTasks) {
  run_it();
  use("version");
  EXPECT_EQ(cause(), "twice: version: 1 -> 2");
  run_it();
  EXPECT_EQ(ran_, Names{"twice"});
}

// --- what reruns nothing
// ---------------------------------------------------------------------------------------------------

TEST_F(Mutation, CommentsInAPluginRerunNothing) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address and undefined sanitizers write line numbers into the code";
#endif
  run_it();
  use("commented");
  EXPECT_EQ(cause(), "none");
  expect_nothing_runs();
}

TEST_F(Mutation, TouchingAFileRerunsNothing) {
  run_it();
  std::filesystem::last_write_time(folder() / "frames/2.txt", std::filesystem::file_time_type::clock::now());
  expect_nothing_runs();
}

TEST_F(Mutation, MovingTheProjectRerunsNothing) {
  run_it();
  for (const char* name : {"frames", "seed", "inner.json", "graph.json"}) {
    std::filesystem::create_directories(folder() / "elsewhere/deep");
    std::filesystem::rename(folder() / name, folder() / "elsewhere/deep" / name);
  }
  EXPECT_EQ(run_it({}, "elsewhere/deep/graph.json").tasks.run, 0u);
}

TEST_F(Mutation, AnotherUserOnAnotherMachineRerunsNothing) {
  run_it();
  ::setenv("USER", "somebody-else", 1);
  ::setenv("HOME", "/nonexistent", 1);
  ::setenv("HOSTNAME", "another", 1);
  ::setenv("LC_ALL", "de_DE.UTF-8", 1);
  expect_nothing_runs();
}

TEST_F(Mutation, RenamingANodeRerunsNothing) {
  run_it();
  edit(R"("luck": {)", R"("fortune": {)");
  edit(R"("b": "luck")", R"("b": "fortune")");
  expect_nothing_runs();
}

TEST_F(Mutation, ReorderedAndReformattedJsonWithCommentsAndLayoutRerunsNothing) {
  run_it();
  edit(R"(  "seed": {"node": "toy.read_text", "inputs": {"file": {"file": "seed/first.txt"}}},)", "");
  edit(R"("nodes": {)", R"(
// a comment
"layout": {"end": {"x": 3}},
"run": {"memory": "2GB"},
"nodes": {
      "seed":   {"inputs": {"file": {"file": "seed/first.txt"}},
                 "node": "toy.read_text"},)");
  expect_nothing_runs();
}

TEST_F(Mutation, AnotherNumberOfThreadsRerunsNothing) {
  run_it();
  engine::RunOptions options;
  options.threads = 7;
  EXPECT_EQ(run_it(options).tasks.run, 0u);
}

}  // namespace
