// SPDX-License-Identifier: Apache-2.0
// What the store costs: looking up a finished task, publishing one, keeping and reading values, opening.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "engine/store/store.h"

namespace {

using engine::Bytes;
using engine::Digest;
using engine::Store;
using engine::TaskRecord;

struct Folder {
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "store_bench.XXXXXX").string();
    path = mkdtemp(pattern.data());
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string path;
};

TaskRecord record_of(std::int64_t number) {
  TaskRecord record;
  record.key = engine::digest_of("task " + std::to_string(number));
  record.outputs = {{false, {{"", engine::digest_of("a " + std::to_string(number))}}},
                    {false, {{"", engine::digest_of("b " + std::to_string(number))}}}};
  for (const char* label :
       {"version", "plugin toy", "parameter levels", "parameter window", "input frames", "input rig"})
    record.parts.push_back({label, record.key.hex(), "node.output[" + std::to_string(number) + "]"});
  record.seconds = 0.1;
  return record;
}

Bytes noise(std::size_t size, unsigned seed) {
  std::mt19937 generator(seed);
  Bytes bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(generator() & 15);
  return bytes;
}

Digest digest_of_bytes(const Bytes& bytes) { return engine::digest_of(std::span<const std::uint8_t>(bytes)); }

// A store of 75,000 finished tasks: a sequence of 18,000 frames through four nodes.
constexpr std::int64_t kRecords = 75'000;
const std::string& full_store() {
  static const Folder folder;
  static const bool made = [] {
    const auto store = Store::open(folder.path);
    for (std::int64_t i = 0; i < kRecords; ++i) store->publish(record_of(i));
    return true;
  }();
  (void)made;
  return folder.path;
}

std::vector<Digest> shuffled_keys() {
  std::vector<Digest> keys;
  for (std::int64_t i = 0; i < kRecords; ++i) keys.push_back(record_of(i).key);
  std::shuffle(keys.begin(), keys.end(), std::mt19937(1));
  return keys;
}

// Every record once in a store just opened, as a rerun that does nothing does. Time per record.
void FindOutputsFreshlyOpened(benchmark::State& state) {
  const std::vector<Digest> keys = shuffled_keys();
  const std::string& folder = full_store();
  for (auto _ : state) {
    const auto store = Store::open(folder);
    for (const Digest& key : keys) {
      auto found = store->find_outputs(key);
      if (!found) state.SkipWithError("a record is missing");
      benchmark::DoNotOptimize(found);
    }
  }
  state.counters["per_record"] = benchmark::Counter(static_cast<double>(state.iterations() * kRecords),
                                                    benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(FindOutputsFreshlyOpened)->Unit(benchmark::kMillisecond);

void FindOutputsAbsent(benchmark::State& state) {
  const auto store = Store::open(full_store());
  std::vector<Digest> keys;
  for (int i = 0; i < 10'000; ++i) keys.push_back(engine::digest_of("absent " + std::to_string(i)));
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(store->find_outputs(keys[i++ % keys.size()]));
}
BENCHMARK(FindOutputsAbsent);

void FindWhole(benchmark::State& state) {
  const auto store = Store::open(full_store());
  const std::vector<Digest> keys = shuffled_keys();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(store->find(keys[i++ % keys.size()]));
}
BENCHMARK(FindWhole);

// A small result: lock, look again, put 200 bytes, publish. Includes the folding that keeps up meanwhile.
void PutAndPublishSmall(benchmark::State& state) {
  const Folder folder;
  const auto store = Store::open(folder.path);
  std::int64_t number = 0;
  for (auto _ : state) {
    const TaskRecord record = record_of(number);
    const Bytes value = noise(200, static_cast<unsigned>(number++));
    const auto lock = store->try_lock(record.key);
    benchmark::DoNotOptimize(store->find_outputs(record.key));
    store->put(digest_of_bytes(value), value);
    store->publish(record);
  }
}
BENCHMARK(PutAndPublishSmall)->Iterations(50'000)->MeasureProcessCPUTime()->UseRealTime();

// The same with the closing of the store: what 20,000 results cost in all.
void PublishTwentyThousandAndClose(benchmark::State& state) {
  for (auto _ : state) {
    const Folder folder;
    auto store = Store::open(folder.path);
    for (std::int64_t i = 0; i < 20'000; ++i) {
      const Bytes value = noise(200, static_cast<unsigned>(i));
      store->put(digest_of_bytes(value), value);
      store->publish(record_of(i));
    }
    store.reset();
  }
  state.counters["per_record"] = benchmark::Counter(static_cast<double>(state.iterations() * 20'000),
                                                    benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(PublishTwentyThousandAndClose)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void PutLarge(benchmark::State& state) {
  const Folder folder;
  const auto store = Store::open(folder.path);
  Bytes value = noise(static_cast<std::size_t>(state.range(0)), 1);
  std::uint64_t number = 0;
  for (auto _ : state) {
    std::memcpy(value.data(), &number, sizeof number);
    const Digest name = engine::digest_of(std::to_string(number++));
    store->put(name, value);
    if (number % 32 == 0) {
      state.PauseTiming();
      std::filesystem::remove_all(folder.path + "/objects");
      state.ResumeTiming();
    }
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * state.range(0));
}
BENCHMARK(PutLarge)->Arg(20'000)->Arg(10'000'000)->Unit(benchmark::kMicrosecond);

void GetLarge(benchmark::State& state) {
  const Folder folder;
  const auto store = Store::open(folder.path);
  const Bytes value = noise(static_cast<std::size_t>(state.range(0)), 1);
  const Digest digest = digest_of_bytes(value);
  store->put(digest, value);
  for (auto _ : state) benchmark::DoNotOptimize(store->get(digest));
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * state.range(0));
}
BENCHMARK(GetLarge)->Arg(20'000)->Arg(10'000'000)->Unit(benchmark::kMicrosecond);

void HasLarge(benchmark::State& state) {
  const Folder folder;
  const auto store = Store::open(folder.path);
  const Bytes value = noise(20'000, 1);
  const Digest digest = digest_of_bytes(value);
  store->put(digest, value);
  for (auto _ : state) benchmark::DoNotOptimize(store->has(digest));
}
BENCHMARK(HasLarge);

void DigestOfAKnownFile(benchmark::State& state) {
  const Folder folder;
  const auto store = Store::open(folder.path);
  for (auto _ : state) benchmark::DoNotOptimize(store->digest_file("/usr/include/stdio.h"));
}
BENCHMARK(DigestOfAKnownFile);

void OpenAndClose(benchmark::State& state) {
  for (auto _ : state) Store::open(full_store());
}
BENCHMARK(OpenAndClose)->Unit(benchmark::kMicrosecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
