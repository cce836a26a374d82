// SPDX-License-Identifier: Apache-2.0
#include "plugins/toy/trials.h"

#include <chrono>
#include <stdexcept>
#include <thread>

namespace toy {
namespace {

void wait(double seconds, engine::Progress* progress) {
  using clock = std::chrono::steady_clock;
  const auto end = clock::now() + std::chrono::duration<double>(seconds);
  while (clock::now() < end && !(progress && progress->stop_requested()))
    std::this_thread::sleep_for(
        std::min<std::chrono::duration<double>>(std::chrono::milliseconds(10), end - clock::now()));
}

}  // namespace

std::string fail(const std::string& text, const FailOptions& options) {
  if (text.find(options.when) != std::string::npos)
    throw std::runtime_error("the text contains '" + options.when + "'");
  return text;
}

std::string sleep(const std::string& text, const SleepOptions& options, engine::Progress& progress) {
  if (text.empty()) progress.warn("an empty text sleeps");
  wait(options.seconds, &progress);
  return text;
}

void count_up(engine::SeqWriter<double>& numbers, const CountUpOptions& options) {
  for (int i = 0; i < options.count; ++i) numbers.push(i);
}

std::string blob(const double& number, const BlobOptions& options) {
  const std::string line = "blob number " + std::to_string(static_cast<long>(number)) + "\n";
  const auto size = static_cast<std::size_t>(options.size_mb * 1e6);
  std::string text;
  text.reserve(size);
  while (text.size() + line.size() <= size) text += line;
  text.resize(size, '.');
  return text;
}

void blob_film(engine::SeqWriter<std::string>& blobs, const BlobFilmOptions& options) {
  for (int i = 0; i < options.count; ++i) {
    wait(options.seconds, nullptr);
    blobs.push(blob(i, {options.size_mb}));
  }
}

std::string mark(const std::string& blob, const double& number) {
  std::string marked = blob;
  const std::string digits = std::to_string(static_cast<long>(number));
  marked.replace(0, digits.size(), digits);
  return marked;
}

double blob_size(const std::string& blob, const BlobSizeOptions& options) {
  wait(options.seconds, nullptr);
  return static_cast<double>(blob.size());
}

double total_size(const engine::Seq<std::string>& blobs, const BlobSizeOptions& options) {
  double total = 0;
  for (const std::string& blob : blobs) total += blob_size(blob, options);
  return total;
}

}  // namespace toy
