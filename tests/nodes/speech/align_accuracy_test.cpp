// SPDX-License-Identifier: Apache-2.0
// The figures that the project promises of its aligner (docs: speech.align).
#include <gtest/gtest.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "nodes/speech/align.h"
#include "nodes/speech/say.h"
#include "tests/nodes/speech/speech_material.h"
#include "tests/support/data.h"

using face::speech::align;
using face::speech::AlignResult;
using face::speech::Voice;

namespace {

void print(const char* title, const test::BoundaryErrors& errors) {
  std::cout << title << ": " << errors.errors_ms.size() << " boundaries, MAE " << errors.mean_ms() << " ms, median "
            << errors.median_ms() << " ms, within 20 ms " << 100 * errors.share_within(20) << " %\n";
}

}  // namespace

TEST(AlignAccuracy, MeetsTheSynthesisersExactPhoneEnds) {
  NEEDS_ACOUSTIC_MODEL();
  const engine::File model = test::acoustic_model(), dictionary = test::dictionary();
  engine::Progress progress;
  test::BoundaryErrors all;
  std::size_t true_boundaries = 0;
  for (const auto& [name, voice] : {std::pair{"slt", Voice::slt}, {"rms", Voice::rms}, {"awb", Voice::awb}}) {
    test::BoundaryErrors of_voice;
    for (const std::string text : test::labial_sentences) {
      const auto said = face::speech::say(text, nullptr, {voice}, progress);
      const AlignResult aligned = align(said.audio, &text, model, dictionary, nullptr, {}, progress);
      EXPECT_TRUE(aligned.matches) << name << ": " << text << " " << aligned.mean_score;
      const auto truth = test::whole_phones(said.phones);
      true_boundaries += truth.size() - 1;
      of_voice.add(test::boundary_errors(test::whole_phones(aligned.phones), truth));
    }
    print(name, of_voice);
    all.add(of_voice);
  }
  print("slt, rms, awb", all);
  EXPECT_LE(all.mean_ms(), 11);
  EXPECT_GE(all.share_within(20), 0.88);
  EXPECT_LE(std::abs(all.median_ms()), 3);
  EXPECT_GE(static_cast<double>(all.errors_ms.size()), 0.75 * static_cast<double>(true_boundaries));  // none dropped
}

TEST(AlignAccuracy, AgreesWithPocketSphinx5OnAReader) {
  NEEDS_ACOUSTIC_MODEL();
  DATA_FILE(wav, "librivox/0870.wav");
  DATA_FILE(text_file, "librivox/0870.txt");
  DATA_FILE(reference_file, "librivox/0870.phone.json");
  engine::Progress progress;
  const std::string text = test::read_text(text_file);
  const AlignResult aligned =
      align(test::read_wav(wav), &text, test::acoustic_model(), test::dictionary(), nullptr, {}, progress);
  constexpr double reference_lag_s = 0.006;  // that aligner's own bias
  std::vector<face::Phone> reference;
  const auto json = nlohmann::json::parse(test::read_text(reference_file));
  for (const auto& word : json["w"])
    for (const auto& phone : word["w"])
      reference.push_back({phone["t"], phone["b"].get<double>() + reference_lag_s,
                           phone["b"].get<double>() + phone["d"].get<double>() + reference_lag_s, "", 0});
  const test::BoundaryErrors errors = test::boundary_errors(test::whole_phones(aligned.phones), reference);
  print("0870", errors);
  EXPECT_GE(errors.errors_ms.size(), 70u);  // of 79
  EXPECT_GE(errors.share_within(20), 0.9);
  EXPECT_TRUE(aligned.matches);
}
