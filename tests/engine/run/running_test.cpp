// SPDX-License-Identifier: Apache-2.0
// Failure, cheap values, outputs, stopping, determinism.
#include "tests/support/expect_throw_text.h"
#include "tests/support/toy_run.h"

namespace {

using Running = test::ToyRun;

const char* const chain = R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"checked": {"node": "toy.fail", "inputs": {"text": "texts"}, "params": {"when": "bad"}},
"loud": {"node": "toy.upper", "inputs": {"text": "checked"}},
"each": {"node": "toy.write_text", "inputs": {"text": "loud"}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "loud"}})";

TEST_F(Running, AFailingElementDoesNotStopTheOthers) {
  write_frames(5);
  write("frames/3.txt", "bad");
  const engine::RunResult result = run(graph(chain, R"("each.txt": "each", "all.txt": "all")"));
  EXPECT_EQ(result.tasks.failed, 1u);
  EXPECT_EQ(result.tasks.blocked, 3u);  // loud[3], each[3], all
  ASSERT_EQ(result.failures.size(), 1u);
  EXPECT_EQ(result.failures[0].substr(0, result.failures[0].find(" [key")),
            "checked[3] (toy.fail): the text contains 'bad'");
  EXPECT_EQ(out("each/4.txt"), "FRAME 4");
  EXPECT_FALSE(std::filesystem::exists(folder() / "out/all.txt"));
}

TEST_F(Running, FailuresAreNotStored) {
  write_frames(2);
  write("frames/1.txt", "bad");
  EXPECT_EQ(run(graph(chain, R"("all.txt": "all")")).tasks.failed, 1u);
  EXPECT_EQ(run(graph(chain, R"("all.txt": "all")")).tasks.failed, 1u);
  write("frames/1.txt", "good");
  EXPECT_EQ(run(graph(chain, R"("all.txt": "all")")).tasks.failed, 0u);
}

TEST_F(Running, OutputsComeBackWithoutATask) {
  write_frames(3);
  const auto g = graph(chain, R"("each.txt": "each", "all.txt": "all")");
  run(g);
  const auto untouched = std::filesystem::last_write_time(folder() / "out/each/1.txt");
  std::filesystem::remove(folder() / "out/all.txt");
  write("out/each/2.txt", "edited by hand");
  const engine::RunResult result = run(g);
  EXPECT_EQ(result.tasks.run, 0u);
  EXPECT_EQ(out("all.txt"), "FRAME 1\nFRAME 2\nFRAME 3");
  EXPECT_EQ(out("each/2.txt"), "FRAME 2");
  EXPECT_EQ(std::filesystem::last_write_time(folder() / "out/each/1.txt"), untouched);
}

TEST_F(Running, CheapValuesAreMadeOnceAndNotAgainOnANoOp) {
  const std::string nodes = R"("numbers": {"node": "toy.count_up", "params": {"count": 2000}},
"more": {"node": "toy.add", "inputs": {"a": "numbers"}, "params": {"amount": 1}},
"shown": {"node": "toy.number_text", "inputs": {"number": "more"}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "shown"}})";
  EXPECT_EQ(run(graph(nodes, R"("all.txt": "all")")).tasks.run, 4001u);
  std::size_t started = 0;
  engine::RunOptions options;
  options.observer = [&](const engine::RunEvent& event) { started += event.kind == engine::RunEvent::Kind::started; };
  EXPECT_EQ(run(graph(nodes, R"("all.txt": "all")"), options).tasks.run, 0u);
  EXPECT_EQ(started, 0u);
}

TEST_F(Running, ThirtySixThousandCheapFramesRunNothingOnANoOp) {
  const std::string nodes = R"("numbers": {"node": "toy.count_up", "params": {"count": 36000}},
"frames": {"node": "toy.cheap_blob", "inputs": {"number": "numbers"}, "params": {"size_mb": 0.00003}},
"size": {"node": "toy.total_size", "inputs": {"blobs": "frames"}},
"shown": {"node": "toy.number_text", "inputs": {"number": "size"}},
"all": {"node": "toy.write_text", "inputs": {"text": "shown"}})";
  std::size_t started = 0, made = 0;
  engine::RunOptions options;
  options.observer = [&](const engine::RunEvent& event) {
    started += event.kind == engine::RunEvent::Kind::started;
    made += event.kind == engine::RunEvent::Kind::made;
  };
  EXPECT_EQ(run(graph(nodes, R"("all.txt": "all")"), options).tasks.run, 3u);  // size, shown, all
  EXPECT_EQ(made, 36'001u);  // numbers, and every frame
  EXPECT_EQ(out("all.txt"), "1080000");
  started = 0;
  EXPECT_EQ(run(graph(nodes, R"("all.txt": "all")"), options).tasks.run, 0u);
  EXPECT_EQ(started, 0u);
}

TEST_F(Running, AGatherReadsACheapSequenceInOnePass) {
  const std::string nodes = R"("numbers": {"node": "toy.count_up", "params": {"count": 500}},
"total": {"node": "toy.sum_all", "inputs": {"numbers": "numbers"}},
"shown": {"node": "toy.number_text", "inputs": {"number": "total"}},
"all": {"node": "toy.write_text", "inputs": {"text": "shown"}})";
  std::size_t passes = 0;
  engine::RunOptions options;
  options.observer = [&](const engine::RunEvent& event) {
    passes += event.kind == engine::RunEvent::Kind::started && event.node == "numbers";
  };
  run(graph(nodes, R"("all.txt": "all")"), options);
  EXPECT_EQ(out("all.txt"), "124750");
  EXPECT_EQ(passes, 1u);
}

TEST_F(Running, AnOptionalInputThatFollowsAStreamIsReadInTheSamePass) {
  const std::string nodes = R"("numbers": {"node": "toy.count_up", "params": {"count": 500}},
"shown": {"node": "toy.number_text", "inputs": {"number": "numbers"}},
"lengths": {"node": "toy.length", "inputs": {"text": "shown"}},
"sums": {"node": "toy.add", "inputs": {"a": "numbers", "b": "lengths"}},
"total": {"node": "toy.sum_all", "inputs": {"numbers": "sums"}},
"text": {"node": "toy.number_text", "inputs": {"number": "total"}},
"all": {"node": "toy.write_text", "inputs": {"text": "text"}})";
  std::size_t passes = 0;
  engine::RunOptions options;
  options.observer = [&](const engine::RunEvent& event) {
    passes += event.kind == engine::RunEvent::Kind::started && event.node == "numbers";
  };
  EXPECT_EQ(run(graph(nodes, R"("all.txt": "all")"), options).failures, std::vector<std::string>{});
  EXPECT_EQ(out("all.txt"), "126140");  // 0 + ... + 499, and 10 of 1, 90 of 2, 400 of 3 digits
  EXPECT_EQ(passes, 1u);
}

TEST_F(Running, ASmallBudgetMakesCheapValuesAgainRatherThanHoldThem) {
  const std::string nodes = R"("numbers": {"node": "toy.count_up", "params": {"count": 30}},
"blobs": {"node": "toy.cheap_blob", "inputs": {"number": "numbers"}, "params": {"size_mb": 1}},
"sizes": {"node": "toy.blob_size", "inputs": {"blob": "blobs"}},
"total": {"node": "toy.total_size", "inputs": {"blobs": "blobs"}},
"sum": {"node": "toy.sum_all", "inputs": {"numbers": "sizes"}},
"both": {"node": "toy.add", "inputs": {"a": "sum", "b": "total"}},
"shown": {"node": "toy.number_text", "inputs": {"number": "both"}},
"all": {"node": "toy.write_text", "inputs": {"text": "shown"}})";
  engine::RunOptions options;
  options.memory_bytes = 4'000'000;
  const engine::RunResult result = run(graph(nodes, R"("all.txt": "all")"), options);
  EXPECT_EQ(result.failures, std::vector<std::string>{});
  EXPECT_EQ(out("all.txt"), "60000000");
}

TEST_F(Running, ResultsDoNotDependOnTheNumberOfThreads) {
  write_frames(40);
  std::string first;
  for (const int threads : {1, 2, 7}) {
    store_ = engine::Store::open((folder() / ("store" + std::to_string(threads))).string());
    engine::RunOptions options;
    options.threads = threads;
    EXPECT_EQ(run(graph(chain, R"("all.txt": "all")"), options).tasks.run, 40u * 3 + 1);
    if (first.empty()) first = out("all.txt");
    EXPECT_EQ(out("all.txt"), first);
  }
}

TEST_F(Running, AStopLeavesFinishedTasksFinished) {
  write_frames(60);
  const std::string nodes = R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"slow": {"node": "toy.sleep", "inputs": {"text": "texts"}, "params": {"seconds": 0.02}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "slow"}})";
  engine::RunOptions options;
  std::atomic<int> finished = 0;
  options.observer = [&](const engine::RunEvent& event) {
    finished += event.kind == engine::RunEvent::Kind::finished && event.node == "slow";
  };
  options.stop_requested = [&] { return finished >= 5; };
  const engine::RunResult stopped = run(graph(nodes, R"("all.txt": "all")"), options);
  EXPECT_TRUE(stopped.cancelled);
  const engine::RunResult result = run(graph(nodes, R"("all.txt": "all")"));
  EXPECT_GE(result.tasks.reused, 5u);
  EXPECT_EQ(result.tasks.run + result.tasks.reused, 121u);
}

TEST_F(Running, PartOfTheElementsCanBeTried) {
  write_frames(50);
  engine::RunOptions options;
  options.to = "loud";
  options.elements = {"1-3", "7"};
  const engine::RunResult result = run(graph(chain, R"("all.txt": "all")"), options);
  EXPECT_EQ(result.tasks.run, 4u * 3);
  options.elements = {"900-901"};
  EXPECT_EQ(run(graph(chain, R"("all.txt": "all")"), options).failures,
            std::vector<std::string>{"loud: it has none of the elements asked for"});
}

TEST_F(Running, OneElementBehindARecurrenceNeedsTheElementsBeforeIt) {
  write_frames(9);
  const auto g = graph(R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"lengths": {"node": "toy.length", "inputs": {"text": "texts"}},
"sums": {"node": "toy.running_sum", "inputs": {"value": "lengths"}},
"both": {"node": "toy.add", "inputs": {"a": "lengths", "b": "sums"}},
"shown": {"node": "toy.number_text", "inputs": {"number": "both"}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "shown"}})",
                       R"("all.txt": "all")");
  const engine::GotValue got = engine::get_value(g, plugins_, *store_, {"shown", "", {"7"}}, {});
  EXPECT_EQ(got.value.as<std::string>(), "56");  // 7 + 7 * 7
}

TEST_F(Running, AValueInsideASubgraphIsNamedByItsNode) {
  write_frames(2);
  write("loud.json", R"({"facegraph": 1, "inputs": {"texts": "Seq<text>"},
"nodes": {"loud": {"node": "toy.upper", "inputs": {"text": "@texts"}},
          "all": {"node": "toy.join_texts", "inputs": {"texts": "loud"}}},
"outputs": {"joined": "all"}})");
  const auto g = graph(R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"sub": {"graph": "loud.json", "inputs": {"texts": "texts"}})",
                       R"("all.txt": "sub.joined")");
  EXPECT_EQ(engine::get_value(g, plugins_, *store_, {"sub/loud", "", {"1"}}, {}).value.as<std::string>(), "FRAME 1");
  EXPECT_THROW_TEXT(engine::get_value(g, plugins_, *store_, {"sub", "joined", {}}, {}),
                    "'sub' is a subgraph, expected one of its nodes: sub/loud, sub/all");
}

TEST_F(Running, ExplainTellsAChangeAlongARecurrenceOnce) {
  write_frames(9);
  const std::string nodes = R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"lengths": {"node": "toy.length", "inputs": {"text": "texts"}},
"sums": {"node": "toy.running_sum", "inputs": {"value": "lengths"}},
"shown": {"node": "toy.number_text", "inputs": {"number": "sums"}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "shown"}})";
  run(graph(nodes, R"("all.txt": "all")"));
  write("frames/3.txt", "frame three");
  const auto explained = engine::explain_node(graph(nodes, R"("all.txt": "all")"), plugins_, *store_, "sums", "8");
  ASSERT_EQ(explained.size(), 1u);
  ASSERT_EQ(explained[0].causes.size(), 1u);
  EXPECT_EQ(explained[0].causes[0].task, "texts[3]");
}

TEST_F(Running, LostValuesAreMadeAgainOnlyWhenSomebodyMustReadThem) {
  write_frames(4);
  write("frames/2.txt", std::string(50000, 'x'));
  const auto g = graph(chain, R"("all.txt": "all")");
  run(g);
  store_->gc(0, 0);
  store_ = engine::Store::open((folder() / "store").string());
  store_->gc(0, 0);
  EXPECT_EQ(run(g).tasks.run, 0u);
  std::filesystem::remove(folder() / "out/all.txt");
  const engine::RunResult result = run(g);
  EXPECT_EQ(result.failures, std::vector<std::string>{});
  EXPECT_NE(out("all.txt").find("FRAME 1\nXXX"), std::string::npos);
}

TEST_F(Running, ExplainNamesTheLeafCause) {
  write_frames(4);
  run(graph(chain, R"("all.txt": "all")"));
  write("frames/3.txt", "changed");
  auto explained = engine::explain_node(graph(chain, R"("all.txt": "all")"), plugins_, *store_, "all", "");
  ASSERT_EQ(explained.size(), 1u);
  ASSERT_EQ(explained[0].causes.size(), 1u);
  EXPECT_EQ(explained[0].causes[0].task, "texts[3]");
  EXPECT_EQ(explained[0].causes[0].what.substr(0, explained[0].causes[0].what.find(" changed")),
            "file " + (folder() / "frames/3.txt").string());
  EXPECT_EQ(explained[0].causes[0].path, (std::vector<std::string>{"texts[3]", "checked[3]", "loud[3]", "all"}));

  run(graph(chain, R"("all.txt": "all")"));
  explained =
      engine::explain_node(graph(chain, R"("all.txt": "all")", {{"loud.mode", "title"}}), plugins_, *store_, "all", "");
  ASSERT_EQ(explained[0].causes.size(), 1u);
  EXPECT_EQ(explained[0].causes[0].others, 3u);
  EXPECT_EQ(explained[0].causes[0].task, "loud[1]");
  EXPECT_EQ(explained[0].causes[0].what, "parameter mode: \"upper\" -> \"title\"");
}

TEST_F(Running, ThePlanSaysWhatWouldRun) {
  write_frames(3);
  run(graph(chain, R"("all.txt": "all")"));
  write("frames/2.txt", "changed");
  const engine::Plan plan = engine::plan_graph(graph(chain, R"("all.txt": "all")"), plugins_, *store_);
  EXPECT_EQ(plan.cached, 6u);
  EXPECT_EQ(plan.runs, 1u);
  EXPECT_EQ(plan.may_run, 3u);
}

}  // namespace
