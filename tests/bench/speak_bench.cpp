// SPDX-License-Identifier: Apache-2.0
// 60 s of flite's phones to the weights of 3,600 frames, on the embedded head (0) and on ICT's (1).
#include <benchmark/benchmark.h>

#include "nodes/trajectory/read_visemes.h"
#include "nodes/trajectory/speak.h"
#include "tests/bench/heads.h"

namespace {

void speak_for_a_minute(benchmark::State& state) {
  const auto rig = bench::head(state);
  if (!rig) return;
  const bench::Speech speech = bench::speech_of(60);
  const face::Visemes visemes = face::trajectory::read_visemes(
      engine::File::at(std::string(FACEGRAPH_SOURCE_DIR) + "/graphs/speech/visemes.json"));
  std::size_t frames = 0;
  for (auto _ : state) {
    engine::SeqWriter<face::Weights> weights([](const std::string&, const face::Weights&) {});
    benchmark::DoNotOptimize(face::trajectory::speak(speech.phones, visemes, *rig, weights));
    frames = weights.count();
  }
  state.counters["frames"] = static_cast<double>(frames);
}
BENCHMARK(speak_for_a_minute)->ArgName("head")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
