// SPDX-License-Identifier: Apache-2.0
// Forced alignment against the length of the speech. The counter x_real_time is to stay at or below 0.1.
#include <benchmark/benchmark.h>

#include <array>
#include <string>

#include "nodes/speech/align.h"
#include "nodes/speech/say.h"

namespace {

constexpr std::array<const char*, 6> lines = {
    "The birch canoe slid on the smooth planks.",      "Glue the sheet to the dark blue background.",
    "It's easy to tell the depth of a well.",          "These days a chicken leg is a rare dish.",
    "Four hours of steady work faced us, then lunch.", "A large size in stockings is hard to sell.",
};

void align_speech(benchmark::State& state) {
  engine::Progress progress;
  face::Audio audio;
  std::string text;
  for (std::size_t i = 0; audio.duration_s() < static_cast<double>(state.range(0)); ++i) {
    const auto said = face::speech::say(lines[i % lines.size()], nullptr, {}, progress);
    audio.samples.insert(audio.samples.end(), said.audio.samples.begin(), said.audio.samples.end());
    text += std::string(lines[i % lines.size()]) + " ";
  }
  const std::string models = "/usr/share/pocketsphinx/model/en-us/";
  const engine::File acoustic_model = engine::File::at(models + "en-us");
  const engine::File dictionary = engine::File::at(models + "cmudict-en-us.dict");
  for (auto _ : state)
    benchmark::DoNotOptimize(face::speech::align(audio, &text, acoustic_model, dictionary, nullptr, {}, progress));
  state.counters["x_real_time"] = benchmark::Counter(audio.duration_s() * static_cast<double>(state.iterations()),
                                                     benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(align_speech)
    ->ArgName("seconds")
    ->Arg(10)
    ->Arg(60)
    ->Arg(600)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);

}  // namespace
