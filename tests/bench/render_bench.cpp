// SPDX-License-Identifier: Apache-2.0
// One picture of 640 x 640 pixels of the embedded head (0) and of ICT's (1), mouth half open.
#include <benchmark/benchmark.h>

#include "nodes/render/render_head.h"
#include "nodes/types/arkit.h"
#include "tests/bench/heads.h"

namespace {

void render_a_frame(benchmark::State& state) {
  const auto rig = bench::head(state);
  if (!rig) return;
  face::Weights weights;
  for (const face::Shape& shape : rig->shapes) weights.values.push_back(shape.name == "jawOpen" ? 0.5f : 0.05f);
  for (auto _ : state) benchmark::DoNotOptimize(face::render::render_head(*rig, weights));
}
BENCHMARK(render_a_frame)->ArgName("head")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
