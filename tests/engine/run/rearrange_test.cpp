// SPDX-License-Identifier: Apache-2.0
// The engine's own nodes.
#include "tests/support/toy_run.h"

namespace {

class Rearranging : public test::ToyRun {
 protected:
  // The texts that come out of a chain behind "texts" (five files), joined.
  std::string joined(const std::string& nodes, const std::string& last) {
    write_frames(5);
    const auto g = graph(R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},)" +
                             nodes + R"("all": {"node": "toy.join_texts", "inputs": {"texts": ")" + last + R"("}})",
                         R"("all.txt": "all")");
    const engine::RunResult result = run(g);
    EXPECT_EQ(result.failures, std::vector<std::string>{});
    return out("all.txt");
  }
};

TEST_F(Rearranging, SelectTakesIdsAndRanges) {
  EXPECT_EQ(
      joined(R"("some": {"node": "seq.select", "inputs": {"sequence": "texts"}, "params": {"ids": ["4-9", "2"]}},)",
             "some"),
      "frame 2\nframe 4\nframe 5");
}
TEST_F(Rearranging, SliceTakesPositions) {
  EXPECT_EQ(
      joined(R"("some": {"node": "seq.slice", "inputs": {"sequence": "texts"}, "params": {"begin": 1, "end": 3}},)",
             "some"),
      "frame 2\nframe 3");
}
TEST_F(Rearranging, EveryTakesEveryNth) {
  EXPECT_EQ(
      joined(R"("some": {"node": "seq.every", "inputs": {"sequence": "texts"}, "params": {"step": 2, "offset": 1}},)",
             "some"),
      "frame 2\nframe 4");
}
TEST_F(Rearranging, IdsAreTexts) {
  EXPECT_EQ(joined(R"("names": {"node": "seq.ids", "inputs": {"sequence": "texts"}},)", "names"), "1\n2\n3\n4\n5");
}
TEST_F(Rearranging, WhereKeepsWhatIsFlagged) {
  EXPECT_EQ(joined(R"("flags": {"node": "toy.contains", "inputs": {"text": "texts"}, "params": {"part": "4"}},
"some": {"node": "seq.where", "inputs": {"sequence": "texts", "flags": "flags"}},)",
                   "some"),
            "frame 4");
}
TEST_F(Rearranging, FlattenJoinsInnerSequences) {
  EXPECT_EQ(joined(R"("two": {"node": "seq.slice", "inputs": {"sequence": "texts"}, "params": {"begin": 0, "end": 2}},
"copies": {"node": "toy.repeat", "inputs": {"text": "two"}, "params": {"times": 2}},
"flat": {"node": "seq.flatten", "inputs": {"sequences": "copies"}},)",
                   "flat"),
            "frame 10\nframe 11\nframe 20\nframe 21");
}
TEST_F(Rearranging, MergeOrdersById) {
  EXPECT_EQ(joined(R"("late": {"node": "seq.slice", "inputs": {"sequence": "texts"}, "params": {"begin": 3, "end": 5}},
"early": {"node": "seq.slice", "inputs": {"sequence": "texts"}, "params": {"begin": 0, "end": 2}},
"both": {"node": "seq.merge", "inputs": {"sequences": ["late", "early"]}},)",
                   "both"),
            "frame 1\nframe 2\nframe 4\nframe 5");
}
TEST_F(Rearranging, AnElementIsPickedById) {
  EXPECT_EQ(
      joined(R"("copies": {"node": "toy.repeat", "inputs": {"text": "texts[4]"}, "params": {"times": 2}},)", "copies"),
      "frame 40\nframe 41");
}
TEST_F(Rearranging, PickingWhatIsNotThereSaysWhatIs) {
  write_frames(3);
  const auto g = graph(R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"text": {"node": "toy.read_text", "inputs": {"file": "files[7]"}},
"all": {"node": "toy.write_text", "inputs": {"text": "text"}})",
                       R"("all.txt": "all")");
  EXPECT_EQ(run(g).failures,
            std::vector<std::string>{"files[7]: there is no element '7'; the sequence has 3 elements, '1' to '3'"});
}
TEST_F(Rearranging, PickTakesTheElementThatAParameterNamesElseTheFirst) {
  const auto picked = [&](const std::string& params) {
    return joined(R"("one": {"node": "seq.pick", "inputs": {"sequence": "texts"})" + params + R"(},
"copies": {"node": "toy.repeat", "inputs": {"text": "one"}, "params": {"times": 2}},)",
                  "copies");
  };
  EXPECT_EQ(picked(R"(, "params": {"element": "04"})"), "frame 40\nframe 41");
  EXPECT_EQ(picked(""), "frame 10\nframe 11");
}
TEST_F(Rearranging, PickTakesTheElementsThatNodesFind) {
  EXPECT_EQ(joined(R"("names": {"node": "seq.ids", "inputs": {"sequence": "texts"}},
"two": {"node": "seq.slice", "inputs": {"sequence": "names"}, "params": {"begin": 3, "end": 5}},
"those": {"node": "seq.pick", "inputs": {"sequence": "texts", "id": "two"}},)",
                   "those"),
            "frame 4\nframe 5");
}
TEST_F(Rearranging, PickedElementsFollowTheIdThatANodeMakes) {
  write_frames(5);
  write("frames/choice.txt", "3");
  const auto g =
      graph(R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}, "params": {"pattern": "?.txt"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"choice": {"node": "files.list", "inputs": {"folder": "${folder}"}, "params": {"pattern": "choice.txt"}},
"found": {"node": "toy.read_text", "inputs": {"file": "choice[choice]"}},
"one": {"node": "seq.pick", "inputs": {"sequence": "texts", "id": "found"}},
"all": {"node": "toy.write_text", "inputs": {"text": "one"}})",
            R"("all.txt": "all")");
  const engine::Plan plan = engine::plan_graph(g, plugins_, *store_);
  EXPECT_EQ(plan.may_run, 1u);
  EXPECT_EQ(plan.tasks.back().depends_on, "found");
  EXPECT_EQ(run(g).failures, std::vector<std::string>{});
  EXPECT_EQ(out("all.txt"), "frame 3");
  write("frames/choice.txt", "5");
  EXPECT_EQ(run(g).tasks.run, 2u);  // the id is read, the other text is written
  EXPECT_EQ(out("all.txt"), "frame 5");
  write("frames/choice.txt", "9");
  EXPECT_EQ(run(g).failures,
            std::vector<std::string>{"one: its input 'id' names no element; the sequence has 5 elements, '1' to '5'"});
}
TEST_F(Rearranging, FirstTakesThePresentAlternative) {
  EXPECT_EQ(joined(R"("chosen": {"node": "first", "inputs": {"alternatives": ["texts"]}},)", "chosen"),
            "frame 1\nframe 2\nframe 3\nframe 4\nframe 5");
}

TEST_F(Rearranging, AlternativesBehindThePresentOneDoNotRun) {
  write_frames(2);
  const auto g = graph(R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"loud": {"node": "toy.upper", "inputs": {"text": "texts"}},
"chosen": {"node": "first", "inputs": {"alternatives": ["texts", "loud"]}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "chosen"}})",
                       R"("all.txt": "all")");
  EXPECT_EQ(run(g).tasks.run, 3u);
}

}  // namespace
