// SPDX-License-Identifier: Apache-2.0
// Synthetic voices speak sentences rich in P B M F V with exact phone times; heads mouth them; the lips are judged in
// mm.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <utility>

#include "nodes/decode/read_rig.h"
#include "nodes/phantom/make_head.h"
#include "nodes/speech/say.h"
#include "nodes/trajectory/read_visemes.h"
#include "nodes/trajectory/speak.h"
#include "nodes/types/arkit.h"
#include "tests/nodes/trajectory/judge_speech.h"
#include "tests/support/data.h"
#include "tests/support/folder_file.h"

namespace face::trajectory {
namespace {

constexpr std::array sentences = {"Peter Piper picked a peck of pickled peppers by the big brown barn.",
                                  "My mother bought a bumper crop of plums and blueberries from Bob.",
                                  "The famous baboon above the bamboo hut jumped from branch to branch.",
                                  "Have you ever viewed a valley full of vivid violet flowers?",
                                  "Maybe Pam will stop by before the summer camp begins.",
                                  "Five brave firemen fought a fierce fire for over five hours.",
                                  "We were away a year ago while you and I owned a yellow raven.",
                                  "The weather in September is often warm, wet, and rather windy.",
                                  "Which fresh fish should the chef choose for lunch?",
                                  "Please bring me a proper map, a lamp, and a pump before midnight.",
                                  "Baby Bobby blew a bubble, but the bubble popped on a pebble.",
                                  "Move the empty bamboo pipe up above the pump room, please.",
                                  "Half of the puffy muffins vanished from the plate before five.",
                                  "A happy puppy jumped up and bumped the lamp by the bed.",
                                  "Probably nobody remembers the problem with the public map.",
                                  "Beautiful purple plums, ripe melons, and warm apple pie.",
                                  "Jump back, climb up, and grab the rope before the boat bumps.",
                                  "Mom, may Emma come home from the museum on Monday morning?"};

void expect_good_lips(const Rig& rig) {
  const Visemes visemes =
      read_visemes(engine::File::at(std::string(FACEGRAPH_SOURCE_DIR) + "/graphs/speech/visemes.json"));
  engine::Progress silent;
  test::Verdict all;
  double speech_s = 0;
  float one_sided = 0;
  std::chrono::duration<double> spent{};
  for (const speech::Voice voice : {speech::Voice::slt, speech::Voice::rms})
    for (const char* sentence : sentences) {
      const Phones phones = speech::say(sentence, nullptr, {.voice = voice}, silent).phones;
      std::vector<Weights> weights;
      engine::SeqWriter<Weights> writer([&](std::string, Weights value) { weights.push_back(std::move(value)); });
      const auto start = std::chrono::steady_clock::now();
      const SpeakResult result = speak(phones, visemes, rig, writer, {});
      spent += std::chrono::steady_clock::now() - start;
      speech_s += phones.duration_s;
      const test::Verdict verdict = test::judge_speech(phones, weights, result.timeline, rig);
      EXPECT_EQ(result.missed_count, 0) << sentence;
      EXPECT_LE(verdict.widest_closure_mm, 1.0) << sentence;
      EXPECT_LE(verdict.farthest_teeth_mm, 1.0) << sentence;  // -1e9 where there are none
      for (const Weights& frame : weights)
        for (const char* side : {"mouthPress", "mouthLowerDown", "mouthUpperUp", "mouthStretch"})
          one_sided = std::max(one_sided, std::abs(frame.values[arkit_index(std::string(side) + "Left")] -
                                                   frame.values[arkit_index(std::string(side) + "Right")]));
      all.add(verdict);
    }
  EXPECT_LE(one_sided, 0.1f);  // speech is the same on both sides
  EXPECT_GE(all.bilabials, 300);
  EXPECT_GE(all.deepest_closure_mm, -0.3);
  EXPECT_GE(all.deepest_gap_mm, -0.3);
  EXPECT_GE(all.labiodentals, 60);
  EXPECT_GE(all.deepest_bite_mm, -1.0);
  EXPECT_GE(all.open_vowels, 100);
  EXPECT_GT(all.least_open_mm, 1.0);
  EXPECT_LE(all.high_energy, 0.02 * all.whole_energy);
  EXPECT_LE(all.largest_step, 0.25);
  std::cout << all.bilabials << " bilabials: gap " << all.deepest_closure_mm << " to " << all.widest_closure_mm
            << " mm; " << all.labiodentals << " labiodentals: " << all.deepest_bite_mm << " to "
            << all.farthest_teeth_mm << " mm; " << all.open_vowels << " open vowels: at least " << all.least_open_mm
            << " mm; above 12 Hz " << 100 * all.high_energy / all.whole_energy << " %; largest step "
            << all.largest_step << "; deepest gap " << all.deepest_gap_mm << " mm; " << speech_s << " s of speech took "
            << spent.count() << " s\n";
}

TEST(SpeakVoices, LipsOfTheIctHeadMeetInEveryBilabial) {
  DATA_FILE(path, "ict-face/FaceXModel");
  expect_good_lips(decode::read_rig(test::folder_file(path), nullptr));
}

TEST(SpeakVoices, LipsOfTheEmbeddedHeadMeetInEveryBilabial) { expect_good_lips(phantom::make_head()); }

}  // namespace
}  // namespace face::trajectory
