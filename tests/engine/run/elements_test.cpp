// SPDX-License-Identifier: Apache-2.0
// What an edit of one element reruns.
#include "tests/support/toy_run.h"

namespace {

using ElementReruns = test::ToyRun;

const char* const texts = R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"loud": {"node": "toy.upper", "inputs": {"text": "texts"}},
"checked": {"node": "toy.fail", "inputs": {"text": "loud"}, "params": {"when": "BAD"}},
"lengths": {"node": "toy.length", "inputs": {"text": "checked"}})";

TEST_F(ElementReruns, EditingOneFileOf250RunsFourTasks) {
  write_frames(250);
  const std::string path = std::string(FACEGRAPH_SOURCE_DIR) + "/graphs/toy/frames.json";
  const auto frames = [&] { return read(path, {{"folder", "frames"}}); };
  EXPECT_EQ(run(frames()).tasks.run, 751u);
  EXPECT_EQ(run(frames()).tasks.run, 0u);
  write("frames/17.txt", "another text");
  const engine::RunResult result = run(frames());
  EXPECT_EQ(result.tasks.run, 4u);
  EXPECT_EQ(result.tasks.reused, 747u);
  EXPECT_NE(out("all.txt").find("FRAME 16\nANOTHER TEXT\nFRAME 18"), std::string::npos);
}

TEST_F(ElementReruns, WorkStopsWhereResultsDoNotChange) {
  write_frames(5);
  const auto g = graph(std::string(texts) + R"(, "all": {"node": "toy.join_texts", "inputs": {"texts": "checked"}})",
                       R"("all.txt": "all")");
  run(g);
  write("frames/3.txt", "FRAME 3");  // other bytes, the same in upper case
  const engine::RunResult result = run(g);
  EXPECT_EQ(result.tasks.run, 2u);  // read, upper
}

TEST_F(ElementReruns, AppendingAnElementRunsNoOldTask) {
  write_frames(20);
  const std::string nodes =
      std::string(texts) + R"(, "all": {"node": "toy.join_texts", "inputs": {"texts": "checked"}})";
  run(graph(nodes, R"("all.txt": "all")"));
  write("frames/21.txt", "frame 21");
  EXPECT_EQ(run(graph(nodes, R"("all.txt": "all")")).tasks.run, 4u);
}

TEST_F(ElementReruns, RemovingAnElementRunsTheGatherAlone) {
  write_frames(20);
  const std::string nodes =
      std::string(texts) + R"(, "all": {"node": "toy.join_texts", "inputs": {"texts": "checked"}})";
  run(graph(nodes, R"("all.txt": "all")"));
  std::filesystem::remove(folder() / "frames/7.txt");
  EXPECT_EQ(run(graph(nodes, R"("all.txt": "all")")).tasks.run, 1u);
}

const char* const smoothed = R"(, "smooth": {"node": "toy.window_mean", "inputs": {"values": "lengths"}},
"shown": {"node": "toy.number_text", "inputs": {"number": "smooth"}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "shown"}})";

TEST_F(ElementReruns, AWindowOfTwoAtEachSideRerunsFiveWindows) {
  write_frames(30);
  const std::string nodes = std::string(texts) + smoothed;
  run(graph(nodes, R"("all.txt": "all")"));
  write("frames/15.txt", "a much longer text than before, by far");
  engine::RunOptions options;
  std::vector<std::string> windows;
  options.observer = [&](const engine::RunEvent& event) {
    if (event.kind == engine::RunEvent::Kind::finished && event.node == "smooth") windows.push_back(event.element);
  };
  run(graph(nodes, R"("all.txt": "all")"), options);
  std::sort(windows.begin(), windows.end());
  EXPECT_EQ(windows, (std::vector<std::string>{"13", "14", "15", "16", "17"}));
}

TEST_F(ElementReruns, ARecurrenceRunsFromTheEditUntilResultsAgreeAgain) {
  write_frames(9);
  const std::string nodes =
      std::string(texts) + R"(, "sums": {"node": "toy.running_sum", "inputs": {"value": "lengths"}},
"shown": {"node": "toy.number_text", "inputs": {"number": "sums"}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "shown"}})";
  run(graph(nodes, R"("all.txt": "all")"));
  EXPECT_EQ(out("all.txt"), "7\n14\n21\n28\n35\n42\n49\n56\n63");
  // One byte more at 4, one less at 6: sums differ at 4 and 5 only.
  write("frames/4.txt", "frame 4!");
  write("frames/6.txt", "frame6");
  std::vector<std::string> ran;
  engine::RunOptions options;
  options.observer = [&](const engine::RunEvent& event) {
    if (event.kind == engine::RunEvent::Kind::finished && event.node == "sums") ran.push_back(event.element);
  };
  run(graph(nodes, R"("all.txt": "all")"), options);
  EXPECT_EQ(ran, (std::vector<std::string>{"4", "5", "6"}));
  EXPECT_EQ(out("all.txt"), "7\n14\n21\n29\n36\n42\n49\n56\n63");
}

TEST_F(ElementReruns, AnOverrideRerunsItsElementAndTheGather) {
  write_frames(10);
  const auto nodes = [&](const std::string& overrides) {
    return R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"loud": {"node": "toy.upper", "inputs": {"text": "texts"})" +
           overrides + R"(},
"all": {"node": "toy.join_texts", "inputs": {"texts": "loud"}})";
  };
  run(graph(nodes(""), R"("all.txt": "all")"));
  const engine::RunResult result =
      run(graph(nodes(R"(, "overrides": {"4-5": {"mode": "title"}})"), R"("all.txt": "all")"));
  EXPECT_EQ(result.tasks.run, 3u);
  EXPECT_NE(out("all.txt").find("FRAME 3\nFrame 4\nFrame 5\nFRAME 6"), std::string::npos);
}

TEST_F(ElementReruns, NestedSequencesRunElementByElement) {
  write_frames(3);
  const std::string nodes = R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"copies": {"node": "toy.repeat", "inputs": {"text": "texts"}, "params": {"times": 4}},
"loud": {"node": "toy.upper", "inputs": {"text": "copies"}},
"joined": {"node": "toy.join_texts", "inputs": {"texts": "loud"}})";
  EXPECT_EQ(run(graph(nodes, R"("take.txt": "joined")")).tasks.run, 3u + 3u + 12u + 3u);
  EXPECT_EQ(out("take/2.txt"), "FRAME 20\nFRAME 21\nFRAME 22\nFRAME 23");
  write("frames/2.txt", "x");
  EXPECT_EQ(run(graph(nodes, R"("take.txt": "joined")")).tasks.run, 1u + 1u + 4u + 1u);
}

TEST_F(ElementReruns, ASparseOptionalInputIsAbsentWhereItHasNoElement) {
  write_frames(4);
  write("more/2.txt", "xx");
  const std::string nodes = std::string(texts) + R"(,
"more": {"node": "files.list", "inputs": {"folder": {"file": "more"}}},
"more_texts": {"node": "toy.read_text", "inputs": {"file": "more"}},
"more_lengths": {"node": "toy.length", "inputs": {"text": "more_texts"}},
"sums": {"node": "toy.add", "inputs": {"a": "lengths", "b": "more_lengths"}},
"shown": {"node": "toy.number_text", "inputs": {"number": "sums"}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "shown"}})";
  EXPECT_EQ(run(graph(nodes, R"("all.txt": "all")")).failures, std::vector<std::string>{});
  EXPECT_EQ(out("all.txt"), "7\n9\n7\n7");
  write("more/9.txt", "xx");
  EXPECT_EQ(
      run(graph(nodes, R"("all.txt": "all")")).failures,
      std::vector<std::string>{"sums: input 'b' has an element '9' that input 'a' has not, which has '1' to '4'"});
}

// Of a film in which nobody is seen every later step said that its own inputs did not fit.
TEST_F(ElementReruns, ASparseInputOfWhatCouldNotBeMadeIsNoFailureOfItsOwn) {
  write_frames(2);
  write("more/0.txt", "xx");
  const std::string nodes = std::string(texts) + R"(,
"whole": {"node": "toy.join_texts", "inputs": {"texts": "texts"}},
"whole_text": {"node": "toy.read_text", "inputs": {"file": "whole"}},
"refused": {"node": "toy.fail", "inputs": {"text": "whole_text"}, "params": {"when": "frame"}},
"copies": {"node": "toy.repeat", "inputs": {"text": "refused"}},
"copy_lengths": {"node": "toy.length", "inputs": {"text": "copies"}},
"more": {"node": "files.list", "inputs": {"folder": {"file": "more"}}},
"more_texts": {"node": "toy.read_text", "inputs": {"file": "more"}},
"more_lengths": {"node": "toy.length", "inputs": {"text": "more_texts"}},
"sums": {"node": "toy.add", "inputs": {"a": "copy_lengths", "b": "more_lengths"}},
"shown": {"node": "toy.number_text", "inputs": {"number": "sums"}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "shown"}})";
  const engine::RunResult result = run(graph(nodes, R"("all.txt": "all")"));
  ASSERT_EQ(result.failures.size(), 1u);
  EXPECT_EQ(result.failures[0].substr(0, 7), "refused");
}

TEST_F(ElementReruns, UnequalIdsNameBothPortsAndTheFirstOddId) {
  write_frames(3);
  write("others/1.txt", "a");
  write("others/2.txt", "a");
  write("others/4.txt", "a");
  const std::string nodes = R"("a": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"b": {"node": "files.list", "inputs": {"folder": {"file": "others"}}},
"a_texts": {"node": "toy.read_text", "inputs": {"file": "a"}},
"b_texts": {"node": "toy.read_text", "inputs": {"file": "b"}},
"pairs": {"node": "toy.pair", "inputs": {"left": "a_texts", "right": "b_texts"}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "pairs"}})";
  EXPECT_EQ(
      run(graph(nodes, R"("all.txt": "all")")).failures,
      std::vector<std::string>{
          "pairs: inputs 'left' and 'right' have different ids: at position 2 the first has '3', the second '4'"});
  std::filesystem::remove(folder() / "others/4.txt");
  EXPECT_EQ(run(graph(nodes, R"("all.txt": "all")")).failures,
            std::vector<std::string>{
                "pairs: inputs 'left' and 'right' have different ids: '3' is only in the first (3 and 2 elements)"});
}

TEST_F(ElementReruns, FilesAreOrderedByNumberAndRefusedWhereTwoGiveOneId) {
  write("frames/10.txt", "ten");
  write("frames/9.txt", "nine");
  write("frames/b.txt", "bee");
  const std::string nodes = std::string(texts) + R"(, "all": {"node": "toy.join_texts", "inputs": {"texts": "texts"}})";
  run(graph(nodes, R"("all.txt": "all")"));
  EXPECT_EQ(out("all.txt"), "nine\nten\nbee");
  write("frames/09.txt", "again");
  EXPECT_EQ(run(graph(nodes, R"("all.txt": "all")")).failures,
            std::vector<std::string>{"files: files 09.txt and 9.txt give one id, '9': choose one by 'pattern'"});
}

}  // namespace
