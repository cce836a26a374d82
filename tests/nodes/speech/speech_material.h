// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>
#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "engine/port.h"
#include "nodes/base/random.h"
#include "nodes/types/audio.h"
#include "nodes/types/phones.h"

// Skips the test where Debian's pocketsphinx-en-us is not installed.
#define NEEDS_ACOUSTIC_MODEL()                               \
  if (!std::filesystem::exists(test::acoustic_model_folder)) \
  GTEST_SKIP() << "needs " << test::acoustic_model_folder << " (package pocketsphinx-en-us)"

namespace test {

inline const std::string acoustic_model_folder = "/usr/share/pocketsphinx/model/en-us/en-us";

inline engine::File acoustic_model() {
  std::vector<engine::File::Entry> entries;
  for (const auto& file : std::filesystem::directory_iterator(acoustic_model_folder))
    entries.push_back({file.path().filename().string(), file.path().string()});
  return engine::File::folder(acoustic_model_folder, entries);
}
inline engine::File dictionary() { return engine::File::at("/usr/share/pocketsphinx/model/en-us/cmudict-en-us.dict"); }
inline engine::File phone_model() { return engine::File::at("/usr/share/pocketsphinx/model/en-us/en-us-phone.lm.bin"); }

// Sentences rich in P B M F V. The aligner's constants were fixed on others, and on another voice.
inline constexpr std::array<const char*, 24> labial_sentences = {
    "Peter Piper picked a peck of pickled peppers.",       "Bob built a big blue boat by the bay.",
    "My mother makes much money from many maps.",          "Five of the voters favored a very vivid view.",
    "Beverly bought a fabulous velvet vest for Pam.",      "Please put the paper cup on top of the pump.",
    "A mob of men marched past the broken bridge.",        "The farmer found five fat foxes in the barn.",
    "Move the piano above the main platform before noon.", "Vivian prefers fresh berries over pumpkin pie.",
    "The baby babbled happily from morning until supper.", "A number of bombs fell on the empty village.",
    "Mom and pop keep the map in the brown cabinet.",      "I believe that every problem may be solved by proof.",
    "The pilot of the ship passed by the famous cape.",    "Perhaps they forgot to move the heavy bamboo box.",
    "The bumblebee buzzed above the purple violets.",      "Phil and Amy gave the puppy a bath in the bathtub.",
    "Have you ever fed a lamb from a plastic bottle?",     "The vapor from the swamp may form a pale film.",
    "Mark paid fifty pounds for a pair of warm gloves.",   "The jumbo shrimp in the soup tempted the chef.",
    "Remember to wipe the lamp above the sofa.",           "Pam bumped my arm, but the map stayed put."};

// Keeps the warnings.
struct Warnings final : engine::Progress {
  void warn(const std::string& text) override { texts.push_back(text); }
  std::vector<std::string> texts;
};

inline face::Audio read_wav(const std::string& path) {
  SF_INFO info{};
  SNDFILE* file = sf_open(path.c_str(), SFM_READ, &info);
  face::Audio audio;
  if (!file) return audio;
  audio.rate_hz = info.samplerate;
  audio.samples.resize(static_cast<std::size_t>(info.frames));
  sf_read_float(file, audio.samples.data(), info.frames);
  sf_close(file);
  return audio;
}

inline std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline face::Audio with_noise(face::Audio audio, double snr_db) {
  double energy = 0;
  for (const float s : audio.samples) energy += double{s} * s;
  const double level = std::sqrt(energy / static_cast<double>(audio.samples.size()) * std::pow(10.0, -snr_db / 10));
  face::Random random(7);
  for (float& s : audio.samples) s += static_cast<float>(level * random.normal());
  return audio;
}

// Phones with closure and release put together again.
inline std::vector<face::Phone> whole_phones(const face::Phones& phones) {
  std::vector<face::Phone> whole;
  for (face::Phone phone : phones.phones) {
    if (phone.label.ends_with(".r")) {
      whole.back().end_s = phone.end_s;
      continue;
    }
    if (phone.label.ends_with(".c")) phone.label.resize(phone.label.size() - 2);
    whole.push_back(phone);
  }
  return whole;
}

struct BoundaryErrors {
  std::vector<double> errors_ms;  // found - true

  void add(const BoundaryErrors& more) {
    errors_ms.insert(errors_ms.end(), more.errors_ms.begin(), more.errors_ms.end());
  }
  double mean_ms() const {
    double sum = 0;
    for (const double e : errors_ms) sum += std::abs(e);
    return sum / static_cast<double>(errors_ms.size());
  }
  double median_ms() const {
    std::vector<double> sorted = errors_ms;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
  double share_within(double limit_ms) const {
    const auto within =
        std::count_if(errors_ms.begin(), errors_ms.end(), [&](double e) { return std::abs(e) <= limit_ms + 1e-6; });
    return static_cast<double>(within) / static_cast<double>(errors_ms.size());
  }
};

// The two phone strings are matched by edit distance; a boundary counts where the phones on both its sides are matched
// and adjacent in both.
inline BoundaryErrors boundary_errors(const std::vector<face::Phone>& found, const std::vector<face::Phone>& truth) {
  const std::size_t n = found.size(), m = truth.size();
  std::vector<std::vector<std::size_t>> cost(n + 1, std::vector<std::size_t>(m + 1));
  const auto differ = [&](std::size_t i, std::size_t j) {
    return found[i - 1].label == truth[j - 1].label ? std::size_t{0} : std::size_t{1};
  };
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= m; ++j)
      cost[i][j] = i == 0   ? j
                   : j == 0 ? i
                            : std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + differ(i, j)});
  std::vector<std::size_t> match(n, m);
  for (std::size_t i = n, j = m; i > 0 && j > 0;) {
    if (cost[i][j] == cost[i - 1][j - 1] + differ(i, j)) {
      if (differ(i, j) == 0) match[i - 1] = j - 1;
      --i, --j;
    } else if (cost[i][j] == cost[i - 1][j] + 1) {
      --i;
    } else {
      --j;
    }
  }
  BoundaryErrors errors;
  for (std::size_t k = 0; k + 1 < n; ++k)
    if (match[k] < m && match[k + 1] == match[k] + 1)
      errors.errors_ms.push_back(1000 * (found[k].end_s - truth[match[k]].end_s));
  return errors;
}

}  // namespace test
