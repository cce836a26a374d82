// SPDX-License-Identifier: Apache-2.0
// Workers, keys that others hold, stops, picked elements, and inputs that change under way.
#include <atomic>
#include <chrono>
#include <ctime>
#include <thread>

#include "tests/support/toy_run.h"

namespace {

using namespace std::chrono_literals;
using Scheduling = test::ToyRun;

const char* const sleepers = R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"slow": {"node": "toy.sleep", "inputs": {"text": "texts"}, "params": {"seconds": 0.3}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "slow"}})";

// Two runs with a store each, as two processes would have.
TEST_F(Scheduling, ARunGoesOnWithOtherTasksWhileAnotherHoldsAKey) {
  write_frames(6);
  const engine::Graph both = graph(sleepers, R"("all.txt": "all")");
  const auto other_store = engine::Store::open((folder() / "store").string());
  engine::RunOptions options;
  options.threads = 1;
  // Tasks of both runs that are at work at one moment. A clock would measure the machine's load too.
  std::atomic<int> at_work = 0, most_at_work = 0;
  options.observer = [&](const engine::RunEvent& event) {
    if (event.node != "slow") return;
    if (event.kind == engine::RunEvent::Kind::started) {
      const int now = ++at_work;
      if (now > most_at_work) most_at_work = now;
    } else if (event.kind == engine::RunEvent::Kind::finished) {
      --at_work;
    }
  };
  engine::RunResult first, second;
  std::thread other([&] {
    engine::Plugins plugins({FACEGRAPH_PLUGIN_DIR});
    engine::RunOptions alone = options;
    alone.out_folder = (folder() / "other").string();
    second = engine::run_graph(both, plugins, *other_store, alone);
  });
  first = run(both, options);
  other.join();
  EXPECT_EQ(first.tasks.run + second.tasks.run, 13u);
  EXPECT_GE(first.tasks.run, 4u);
  EXPECT_GE(second.tasks.run, 4u);
  EXPECT_EQ(most_at_work, 2);  // not one after the other
}

TEST_F(Scheduling, ATaskThatOutlivesTheTimeLimitFailsAndTheOthersGoOn) {
  write_frames(1);
  engine::Graph both = graph(R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"slow": {"node": "toy.sleep", "inputs": {"text": "texts"}, "params": {"seconds": 60}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "slow"}},
"quick": {"node": "toy.join_texts", "inputs": {"texts": "texts"}})",
                             R"("all.txt": "all", "quick.txt": "quick")");
  both.run.timeout_s = 0.05;
  const engine::RunResult result = run(both);
  ASSERT_EQ(result.failures.size(), 1u);
  EXPECT_EQ(result.failures[0].substr(0, result.failures[0].find(" [key")),
            "slow[1] (toy.sleep): it ran longer than the graph's timeout_s of 0.05 s");
  EXPECT_EQ(result.tasks.blocked, 1u);
  EXPECT_EQ(out("quick.txt"), "frame 1");
}

TEST_F(Scheduling, WarningsAreToldAgainWhenAResultIsReused) {
  write("frames/1.txt", "");
  write("frames/2.txt", "a text");
  for (const std::size_t reused : {0u, 5u}) {
    std::vector<std::string> warnings;
    engine::RunOptions options;
    options.observer = [&](const engine::RunEvent& event) {
      if (event.kind == engine::RunEvent::Kind::warning) warnings.push_back(event.element + ": " + event.text);
    };
    EXPECT_EQ(run(graph(sleepers, R"("all.txt": "all")", {{"slow.seconds", "0"}}), options).tasks.reused, reused);
    EXPECT_EQ(warnings, std::vector<std::string>{"1: an empty text sleeps"}) << reused;
  }
}

TEST_F(Scheduling, AnOutputThatCannotBeWrittenDoesNotHoldBackTheOthers) {
  write_frames(1);
  write("out/a.txt/somebody's file", "");
  const engine::RunResult result = run(graph(sleepers, R"("a.txt": "all", "b.txt": "all")", {{"slow.seconds", "0"}}));
  EXPECT_EQ(result.failures, std::vector<std::string>{"output a.txt: cannot write " +
                                                      (folder() / "out/a.txt").string() + ": Is a directory"});
  EXPECT_EQ(out("b.txt"), "frame 1");
}

TEST_F(Scheduling, AStoppedNodesHalfResultIsNotKept) {
  write_frames(1);
  engine::RunOptions options;
  std::atomic<bool> begun = false;
  options.observer = [&](const engine::RunEvent& event) {
    if (event.kind == engine::RunEvent::Kind::started && event.node == "slow") begun = true;
  };
  options.stop_requested = [&] { return begun.load(); };
  EXPECT_TRUE(run(graph(sleepers, R"("all.txt": "all")", {{"slow.seconds", "60"}}), options).cancelled);
  const engine::Plan plan =
      engine::plan_graph(graph(sleepers, R"("all.txt": "all")", {{"slow.seconds", "60"}}), plugins_, *store_);
  EXPECT_EQ(plan.cached, 1u);
  EXPECT_EQ(plan.runs, 1u);
}

// The sequence is not there yet when the graph is laid out.
TEST_F(Scheduling, AnElementCanBePickedFromASequenceThatIsStillToCome) {
  const std::string nodes = R"("numbers": {"node": "toy.count_up", "params": {"count": 8}},
"texts": {"node": "toy.number_text", "inputs": {"number": "numbers"}},
"fifth": {"node": "toy.upper", "inputs": {"text": "texts[5]"}},
"seed": {"node": "toy.number_text", "inputs": {"number": "numbers[2]"}},
"copies": {"node": "toy.repeat", "inputs": {"text": "texts"}, "params": {"times": 3}},
"joined": {"node": "toy.concat", "inputs": {"texts": "copies[4]"}},
"both": {"node": "toy.pair", "inputs": {"left": "fifth", "right": "joined"}},
"each": {"node": "toy.pair", "inputs": {"left": "both", "right": "seed"}},
"all": {"node": "toy.write_text", "inputs": {"text": "each"}})";
  for (const int threads : {1, 4}) {
    store_ = engine::Store::open((folder() / ("store" + std::to_string(threads))).string());
    engine::RunOptions options;
    options.threads = threads;
    EXPECT_EQ(run(graph(nodes, R"("all.txt": "all")"), options).failures, std::vector<std::string>{});
    EXPECT_EQ(out("all.txt"), "5 404142 2");
    EXPECT_EQ(run(graph(nodes, R"("all.txt": "all")"), options).tasks.run, 0u);
  }
}

// A film that is read once more comes first in the graph, and so would come after everything that is ready.
TEST_F(Scheduling, AStreamThatARunningTaskWaitsForGoesBeforeTasksNearerToTheOutputs) {
  const std::string nodes =
      R"("a_film": {"node": "toy.blob_film", "params": {"count": 30, "size_mb": 0.1, "seconds": 0}},
"b_sizes": {"node": "toy.blob_size", "inputs": {"blob": "a_film"}},
"c_sum": {"node": "toy.sum_all", "inputs": {"numbers": "b_sizes"}},
"d_numbers": {"node": "toy.count_up", "params": {"count": 30}},
"d_sums": {"node": "toy.add", "inputs": {"a": "d_numbers", "b": "c_sum"}},
"e_texts": {"node": "toy.number_text", "inputs": {"number": "d_sums"}},
"f_slow": {"node": "toy.sleep", "inputs": {"text": "e_texts"}, "params": {"seconds": 0.003}},
"g_total": {"node": "toy.total_size", "inputs": {"blobs": "a_film"}},
"h_text": {"node": "toy.number_text", "inputs": {"number": "g_total"}},
"i_file": {"node": "toy.write_text", "inputs": {"text": "h_text"}},
"j_all": {"node": "toy.join_texts", "inputs": {"texts": "f_slow"}})";
  std::size_t slow = 0, slow_before_total = 99;
  engine::RunOptions options;
  options.threads = 1;
  options.memory_bytes = 500'000;
  options.observer = [&](const engine::RunEvent& event) {
    if (event.kind != engine::RunEvent::Kind::finished) return;
    slow += event.node == "f_slow";
    if (event.node == "g_total") slow_before_total = slow;
  };
  EXPECT_EQ(run(graph(nodes, R"("total.txt": "i_file", "all.txt": "j_all")"), options).failures,
            std::vector<std::string>{});
  EXPECT_EQ(out("total.txt"), "3000000");
  EXPECT_EQ(slow, 30u);
  EXPECT_LT(slow_before_total, 15u);
}

// Tasks of the window run while elements are still being pushed.
TEST_F(Scheduling, WindowsOfAGrowingSequenceReadTheirNeighbours) {
  const std::string nodes = R"("numbers": {"node": "toy.count_up", "params": {"count": 3000}},
"smooth": {"node": "toy.window_mean", "inputs": {"values": "numbers"}},
"sum": {"node": "toy.sum_all", "inputs": {"numbers": "smooth"}},
"text": {"node": "toy.number_text", "inputs": {"number": "sum"}},
"all": {"node": "toy.write_text", "inputs": {"text": "text"}})";
  engine::RunOptions options;
  options.threads = 4;
  EXPECT_EQ(run(graph(nodes, R"("all.txt": "all")"), options).failures, std::vector<std::string>{});
  EXPECT_EQ(out("all.txt"), "4498500");  // means of the ends balance
}

TEST_F(Scheduling, AFileThatChangesWhileItIsReadFailsItsTask) {
  write("frames/1.txt", std::string(100, 'a'));
  const std::string nodes = R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.slow_read", "inputs": {"file": "files"}, "params": {"seconds": 0.3}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "texts"}})";
  engine::RunOptions options;
  options.observer = [&](const engine::RunEvent& event) {
    if (event.kind == engine::RunEvent::Kind::started) write("frames/1.txt", std::string(100, 'b'));
  };
  const engine::RunResult result = run(graph(nodes, R"("all.txt": "all")"), options);
  ASSERT_EQ(result.failures.size(), 1u);
  EXPECT_EQ(result.failures[0].substr(0, result.failures[0].find(" [key")),
            "texts[1] (toy.slow_read): file " + (folder() / "frames/1.txt").string() +
                " changed while it was read: run again");
  EXPECT_EQ(run(graph(nodes, R"("all.txt": "all")")).failures, std::vector<std::string>{});
  EXPECT_EQ(out("all.txt"), std::string(100, 'b'));
}

TEST_F(Scheduling, AnObserverThatThrowsEndsTheRunAndNotTheProcess) {
  write_frames(20);
  engine::RunOptions options;
  options.threads = 3;
  options.observer = [](const engine::RunEvent& event) {
    if (event.kind == engine::RunEvent::Kind::finished && event.element == "7")
      throw std::runtime_error("no more room");
  };
  EXPECT_THROW(run(graph(sleepers, R"("all.txt": "all")", {{"slow.seconds", "0.001"}}), options), std::exception);
  EXPECT_EQ(run(graph(sleepers, R"("all.txt": "all")", {{"slow.seconds", "0.001"}})).failures,
            std::vector<std::string>{});
}

TEST_F(Scheduling, AManyFiledFolderCostsLittleMoreThanAFewFiledOne) {
  const std::string nodes = R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"last": {"node": "toy.upper", "inputs": {"text": "texts[1]"}},
"all": {"node": "toy.concat", "inputs": {"texts": "texts"}},
"both": {"node": "toy.pair", "inputs": {"left": "all", "right": "last"}},
"file": {"node": "toy.write_text", "inputs": {"text": "both"}})";
  const auto seconds_for = [&](int count) {  // of processor time: the machine may have other work
    write_frames(count);
    const engine::Graph of_all = graph(nodes, R"("all.txt": "file")");
    const std::clock_t before = std::clock();
    EXPECT_EQ(run(of_all).tasks.failed, 0u);
    return static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  };
  const double few = seconds_for(500), many = seconds_for(4000);
  EXPECT_LT(many, 20 * few + 0.2) << "8 times the files";
}

TEST_F(Scheduling, AnAuditRunsASampleAgainAndNamesWhatDiffers) {
  write_frames(40);
  const std::string nodes = R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"odd": {"node": "toy.unsteady", "inputs": {"text": "texts"}, "params": {"unsteady": false}},
"copies": {"node": "toy.repeat", "inputs": {"text": "odd"}},
"each": {"node": "toy.concat", "inputs": {"texts": "copies"}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "each"}})";
  const auto audit = [&](const engine::Graph& g, double share, std::uint64_t seed) {
    return engine::audit_graph(g, plugins_, *store_, share, seed, {});
  };
  const engine::Graph steady = graph(nodes, R"("all.txt": "all")");
  EXPECT_EQ(audit(steady, 1, 1).checked, 0u);
  run(steady);
  engine::AuditResult result = audit(steady, 1, 1);
  EXPECT_EQ(result.stored, 161u);
  EXPECT_EQ(result.checked, 161u);
  EXPECT_EQ(result.differing, std::vector<std::string>{});
  result = audit(steady, 0.2, 7);
  EXPECT_GT(result.checked, 10u);
  EXPECT_LT(result.checked, 60u);
  EXPECT_EQ(audit(steady, 0.2, 7).checked, result.checked);
  EXPECT_EQ(audit(steady, 1e-9, 1).checked, 1u);

  const engine::Graph unsteady = graph(nodes, R"("all.txt": "all")", {{"odd.unsteady", "true"}});
  run(unsteady);
  result = audit(unsteady, 1, 1);
  ASSERT_EQ(result.differing.size(), 40u);
  for (const std::string& text : result.differing) {
    EXPECT_TRUE(text.starts_with("odd[")) << text;
    EXPECT_NE(text.find("(toy.unsteady): run again, it gave another result than before: it is not deterministic"),
              std::string::npos)
        << text;
  }
}

}  // namespace
