// SPDX-License-Identifier: Apache-2.0
// 60 s of speech and its text to CSV and GLB at 60 fps, as the whole command with an empty store. To stay at or below
// 6 s (time) and 500 MB (peak_rss_mb) on 2 cores, on the embedded head (0) and on ICT's (1).
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <sndfile.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/bench/material.h"
#include "tests/support/toy_run.h"

namespace {

struct Child {
  int status = -1;
  double seconds = 0, cpu_s = 0, peak_rss_mb = 0;
};

Child run(const std::vector<std::string>& words, const std::string& log) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const auto start = std::chrono::steady_clock::now();
  const pid_t pid = fork();
  if (pid == 0) {
    const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(file, 1);
    dup2(file, 2);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  Child child;
  rusage usage{};
  wait4(pid, &child.status, 0, &usage);
  child.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto seconds_of = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  child.cpu_s = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  child.peak_rss_mb = static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
  return child;
}

void write_wav(const std::string& path, const face::Audio& audio) {
  SF_INFO info{};
  info.samplerate = static_cast<int>(audio.rate_hz);
  info.channels = 1;
  info.format = SF_FORMAT_WAV | SF_FORMAT_PCM_16;
  SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
  sf_writef_float(file, audio.samples.data(), static_cast<sf_count_t>(audio.samples.size()));
  sf_close(file);
}

void talk_for_a_minute(benchmark::State& state) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path().string();
  const bench::Speech speech = bench::speech_of(60);
  write_wav(path + "/line.wav", speech.audio);
  std::ofstream(path + "/line.txt") << speech.text;
  std::vector<std::string> words = {FACEGRAPH_COMMAND,
                                    "--store",
                                    path + "/store",
                                    "run",
                                    FACEGRAPH_SOURCE_DIR "/graphs/speech/curves.json",
                                    "--out",
                                    path + "/out",
                                    "--set",
                                    "audio=" + path + "/line.wav",
                                    "--set",
                                    "text=" + path + "/line.txt"};
  if (state.range(0) == 1) {
    if (!std::filesystem::exists(bench::ict_folder())) return state.SkipWithError("needs the ICT-FaceKit folder");
    words.insert(words.end(), {"--set", "rig=" + bench::ict_folder().string()});
  }
  double peak_rss_mb = 0, cpu_s = 0;
  for (auto _ : state) {
    std::filesystem::remove_all(path + "/store");
    std::filesystem::remove_all(path + "/out");
    const Child child = run(words, path + "/log");
    if (child.status != 0) return state.SkipWithError(test::read_file(path + "/log").c_str());
    state.SetIterationTime(child.seconds);
    peak_rss_mb = std::max(peak_rss_mb, child.peak_rss_mb);
    cpu_s = child.cpu_s;
  }
  state.counters["peak_rss_mb"] = peak_rss_mb;
  state.counters["cpu_s"] = cpu_s;
}
BENCHMARK(talk_for_a_minute)->ArgName("head")->Arg(0)->Arg(1)->Iterations(3)->UseManualTime()->Unit(benchmark::kSecond);

}  // namespace
