// SPDX-License-Identifier: Apache-2.0
// One graph with many settings: what variants share is made once, and a variant that fails is told and left behind.
#include "engine/run/sweep.h"

#include "engine/graph/metric.h"
#include "tests/support/toy_run.h"

namespace {

using engine::SweepSettings;
using engine::Variant;

class Sweep : public test::ToyRun {
 protected:
  static constexpr const char* nodes = R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"loud": {"node": "toy.upper", "inputs": {"text": "texts"}},
"all": {"node": "toy.concat", "inputs": {"texts": "loud"}},
"size": {"node": "toy.length", "inputs": {"text": "all"}},
"score": {"node": "toy.add", "inputs": {"a": "size"}},
"shown": {"node": "toy.number_text", "inputs": {"number": "score"}},
"file": {"node": "toy.write_text", "inputs": {"text": "shown"}})";

  std::vector<Variant> variants_of(const std::vector<SweepSettings::Vary>& vary, const char* of = nodes) {
    std::vector<Variant> variants;
    for (const auto& settings : engine::combinations(vary)) {
      Variant& variant = variants.emplace_back();
      variant.settings = settings;
      variant.graph = graph(of, R"("score.txt": "file")", settings);
    }
    return variants;
  }
  engine::SweepResult sweep(std::vector<Variant>& variants, const std::vector<std::string>& metrics = {"score.sum"}) {
    std::vector<engine::Metric> parsed;
    for (const std::string& text : metrics) {
      std::string error;
      EXPECT_TRUE(engine::parse_metric(text, parsed.emplace_back(), error)) << error;
    }
    return engine::run_sweep(variants, parsed, plugins_, *store_, {});
  }
};

TEST_F(Sweep, TriesEveryCombinationTheLastFastest) {
  std::string text;
  for (const auto& settings : engine::combinations({{"a", {"1", "2"}, {}}, {"b", {"x", "y", "z"}, {}}}))
    text += settings[0].value + settings[1].value + " ";
  EXPECT_EQ(text, "1x 1y 1z 2x 2y 2z ");
}

TEST_F(Sweep, RunsWhatVariantsShareOnce) {
  write_frames(5);
  auto variants = variants_of({{"score.amount", {"1", "10", "100"}, {}}});
  const engine::SweepResult first = sweep(variants);
  // 5 read, 5 upper, concat, length: once; the addition for each.
  EXPECT_EQ(first.tasks.run, 12u + 3u);
  EXPECT_EQ(first.tasks.reused, 0u);
  for (const Variant& variant : variants) {
    EXPECT_EQ(variant.failure, "");
    EXPECT_EQ(variant.run, 13u);
  }
  EXPECT_EQ(variants[2].values.at(0) - variants[0].values.at(0), 99);

  auto more = variants_of({{"loud.mode", {"upper", "title"}, {}}, {"score.amount", {"1", "5"}, {}}});
  const engine::SweepResult second = sweep(more);
  // Of "title": 5 changes of case and one concat; texts of one length have one length. Of 5: one addition.
  EXPECT_EQ(second.tasks.run, 5u + 1u + 1u + 1u);
  EXPECT_EQ(sweep(more).tasks.run, 0u);
}

TEST_F(Sweep, SharesWhatIsNotStoredToo) {
  const char* counted = R"("numbers": {"node": "toy.count_up", "params": {"count": 50}},
"sum": {"node": "toy.sum_all", "inputs": {"numbers": "numbers"}},
"score": {"node": "toy.add", "inputs": {"a": "sum"}},
"shown": {"node": "toy.number_text", "inputs": {"number": "score"}},
"file": {"node": "toy.write_text", "inputs": {"text": "shown"}})";
  auto variants = variants_of({{"score.amount", {"1", "2", "3", "4"}, {}}}, counted);
  std::vector<const engine::Graph*> graphs;
  for (const Variant& variant : variants) graphs.push_back(&variant.graph);
  const engine::MergedGraphs merged = engine::merge_graphs(graphs, {{2}, {2}, {2}, {2}});
  std::string names;
  for (const engine::GraphNode& node : merged.graph.nodes)
    if (node.needed) names += node.id + " ";
  EXPECT_EQ(names, "numbers sum score score#2 score#3 score#4 ");
}

TEST_F(Sweep, PutsAnotherKindOfNodeInPlace) {
  write_frames(2);
  auto variants = variants_of({{"loud.node", {"toy.upper", "toy.fail"}, {}}, {"score.amount", {"0"}, {}}});
  EXPECT_EQ(variants[1].graph.nodes[2].info->name, "toy.fail");
  // toy.fail has another output, and the graph asks for the only one.
  EXPECT_EQ(sweep(variants).tasks.failed, 0u);
  EXPECT_EQ(variants[0].values, variants[1].values);
}

TEST_F(Sweep, TellsOfAVariantThatFailsAndGoesOn) {
  write_frames(3);
  const char* failing = R"("files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"checked": {"node": "toy.fail", "inputs": {"text": "texts"}},
"all": {"node": "toy.concat", "inputs": {"texts": "checked"}},
"score": {"node": "toy.length", "inputs": {"text": "all"}},
"file": {"node": "toy.write_text", "inputs": {"text": "all"}})";
  auto variants = variants_of({{"checked.when", {"nothing", "frame 2", "bad"}, {}}}, failing);
  const engine::SweepResult result = sweep(variants, {"score.length"});
  EXPECT_EQ(result.tasks.failed, 1u);
  EXPECT_EQ(variants[0].values, (std::vector<double>{21}));
  EXPECT_EQ(variants[2].values, (std::vector<double>{21}));
  EXPECT_TRUE(variants[1].values.empty());
  EXPECT_EQ(variants[1].failure.substr(0, 24), "checked[2] (toy.fail): t") << variants[1].failure;
}

TEST_F(Sweep, FindsNumbersInTheJsonFormOfAValue) {
  const std::string table = R"({"columns": ["lips_mm", "all_mm"], "rows": [{"name": "mean", "values": [1.5, 2]},
    {"name": "worst", "values": [3, true, null]}]})";
  EXPECT_EQ(engine::number_at(table, {"rows", "worst", "values", "0"}), 3);
  EXPECT_EQ(engine::number_at(table, {"rows", "0", "values", "0"}), 1.5);
  EXPECT_EQ(engine::number_at(table, {"rows", "worst", "values", "1"}), 1);
  EXPECT_EQ(engine::number_at("7", {}), 7);
  const auto refusal = [&](const std::vector<std::string>& path) -> std::string {
    try {
      engine::number_at(table, path);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(refusal({"row"}), "the value is an object with 'columns', 'rows': there is no 'row' in it");
  EXPECT_EQ(refusal({"rows", "best"}), "'rows' is a list of 2: there is no 'best' in it");
  EXPECT_EQ(refusal({"rows", "mean"}),
            "'mean' is an object with 'name', 'values', expected a number: name one in it with /");
  EXPECT_EQ(refusal({"rows", "worst", "values", "2"}), "'2' is no number, expected a number");
}

TEST_F(Sweep, ReadsTheNamesOfNumbers) {
  engine::Metric metric;
  std::string error;
  ASSERT_TRUE(engine::parse_metric("sub/score.table[take03/17]/rows/mean/0", metric, error)) << error;
  EXPECT_EQ(metric.reference.node, "sub/score");
  EXPECT_EQ(metric.reference.output, "table");
  EXPECT_EQ(metric.reference.element, (std::vector<std::string>{"take03", "17"}));
  EXPECT_EQ(metric.path, (std::vector<std::string>{"rows", "mean", "0"}));
  ASSERT_TRUE(engine::parse_metric("sub/score", metric, error));
  EXPECT_EQ(metric.reference.node, "sub/score");
  EXPECT_TRUE(metric.path.empty());
  EXPECT_FALSE(engine::parse_metric("score.table/rows//0", metric, error));
  EXPECT_EQ(error, "'score.table/rows//0' is no number's name: a step of its path is empty");
}

}  // namespace
