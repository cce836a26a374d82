// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/perform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "nodes/base/mouth.h"
#include "nodes/phantom/identity_modes.h"
#include "nodes/phantom/make_person.h"
#include "nodes/phantom/perform_table.h"
#include "tests/nodes/phantom/head_probe.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::phantom;

struct Performance {
  PerformResult result;
  std::vector<Weights> weights;
  std::vector<RigidMotion> world_from_head;

  double weight(std::size_t frame, std::string_view shape) const {
    return weights.at(frame).values.at(arkit_index(shape));
  }
  std::size_t frame_at(double time_s) const {
    std::size_t frame = 0;
    while (frame + 1 < result.timeline.time_s.size() && result.timeline.time_s[frame + 1] <= time_s + 1e-9) ++frame;
    return frame;
  }
};

Performance act(const Phones& phones, const PerformOptions& options, const Rig* rig = nullptr,
                const Timeline* timeline = nullptr, const std::string* take = nullptr) {
  Performance performance;
  engine::SeqWriter<Weights> weights(
      [&](const std::string&, Weights w) { performance.weights.push_back(std::move(w)); });
  engine::SeqWriter<RigidMotion> motions(
      [&](const std::string&, RigidMotion m) { performance.world_from_head.push_back(m); });
  performance.result = perform(phones, timeline, rig, take, weights, motions, options);
  return performance;
}

// Labels with their lengths in ms, one word.
Phones say(std::initializer_list<std::pair<const char*, int>> list) {
  Phones phones;
  double time_s = 0;
  for (const auto& [label, length_ms] : list) {
    const double end_s = time_s + length_ms / 1000.0;
    phones.phones.push_back({label, time_s, end_s, std::string(label) == "SIL" ? "" : "word", 0});
    time_s = end_s;
  }
  phones.duration_s = time_s;
  return phones;
}

Phones sentence() {
  return say({{"SIL", 200}, {"P.c", 70}, {"P.r", 30}, {"AE", 140}, {"M", 80},   {"B.c", 60}, {"B.r", 15},
              {"AO", 130},  {"T.c", 50}, {"T.r", 30}, {"F", 90},   {"AY", 190}, {"V", 60},   {"P.c", 75},
              {"P.r", 25},  {"ER", 120}, {"P.c", 30}, {"L", 70},   {"M", 35},   {"UW", 160}, {"V", 50},
              {"DH", 40},   {"AH", 60},  {"SH", 110}, {"AA", 170}, {"P", 90},   {"SIL", 600}});
}

PerformOptions still() {
  PerformOptions options;
  options.blink = options.brows = options.gaze = options.head_motion = 0;
  options.style = 0;
  return options;
}

void expect_shut_in_every_closure(const Phones& phones, const Performance& performance, const Rig& rig) {
  std::size_t frames = 0;
  for (const Phone& phone : phones.phones) {
    if (phone.label != "P.c" && phone.label != "B.c" && phone.label != "M") continue;
    std::size_t in_phone = 0;
    for (std::size_t f = 0; f < performance.weights.size(); ++f) {
      const double time_s = performance.result.timeline.time_s[f];
      if (time_s < phone.start_s || time_s > phone.end_s) continue;
      ++in_phone;
      EXPECT_NEAR(lip_gap_mm(rig, pose_points(rig, performance.weights[f])), 0, 1e-3)
          << phone.label << " at " << time_s;
    }
    frames += in_phone;
  }
  EXPECT_GT(frames, 20u);
}

TEST(Perform, ShutsTheLipsExactlyThroughoutEveryBilabial) {
  PerformOptions options;
  options.rate_hz = 100;
  for (options.seed = 1; options.seed <= 5; ++options.seed)
    expect_shut_in_every_closure(sentence(), act(sentence(), options, &probe::head()), probe::head());
}

TEST(Perform, ShutsTheLipsOfAWarpedPerson) {
  const ShapeSet modes = identity_modes();
  MakePersonOptions somebody;
  somebody.seed = 8;
  somebody.warp_mm = 3;
  const Rig rig = make_person(probe::head(), &modes, nullptr, somebody).person;
  PerformOptions options;
  options.rate_hz = 100;
  expect_shut_in_every_closure(sentence(), act(sentence(), options, &rig), rig);
}

TEST(Perform, HasAFrameWithShutLipsForEveryBilabialEvenAt25Hertz) {
  PerformOptions options;
  options.rate_hz = 25;
  const Phones phones = sentence();
  const Performance performance = act(phones, options, &probe::head());
  std::int64_t bilabials = 0;
  for (const Phone& phone : phones.phones) {
    if (phone.label != "P.c" && phone.label != "B.c" && phone.label != "M" && phone.label != "P") continue;
    ++bilabials;
    double least = 1e9;
    for (std::size_t f = 0; f < performance.weights.size(); ++f)
      if (std::abs(performance.result.timeline.time_s[f] - 0.5 * (phone.start_s + phone.end_s)) < 0.06)
        least =
            std::min(least, std::abs(lip_gap_mm(probe::head(), pose_points(probe::head(), performance.weights[f]))));
    EXPECT_LT(least, 1e-3) << phone.label << " at " << phone.start_s;
  }
  EXPECT_EQ(performance.result.closure_count, bilabials);
  EXPECT_EQ(performance.result.labiodental_count, 3);
}

TEST(Perform, ClosesOneToOneWithoutARig) {
  const Performance performance = act(sentence(), still());
  const std::size_t frame = performance.frame_at(0.235);  // in the first P.c
  EXPECT_EQ(performance.weights[frame].values[arkit_index("mouthClose")],
            performance.weights[frame].values[arkit_index("jawOpen")]);
  EXPECT_GT(performance.weight(frame, "jawOpen"), 0);
}

TEST(Perform, BringsTheLowerLipToTheTeethInLabiodentals) {
  PerformOptions options = still();
  options.rate_hz = 100;
  const Phones phones = say({{"SIL", 200}, {"AA", 150}, {"F", 100}, {"AA", 150}, {"V", 80}, {"IY", 150}, {"SIL", 200}});
  const Performance performance = act(phones, options, &probe::head());
  const LipTeeth measure(probe::head());
  for (const double time_s : {0.36, 0.40, 0.44, 0.61, 0.67}) {
    const double distance_mm = measure.nearest(performance.weights[performance.frame_at(time_s)].values).distance_mm;
    EXPECT_LT(distance_mm, 0.5) << time_s;
    EXPECT_GT(distance_mm, -0.3) << time_s;
  }
  EXPECT_LT(std::abs(performance.result.labiodental_distance_mm), 0.5);
  // Of an open vowel it is far away.
  EXPECT_GT(measure.nearest(performance.weights[performance.frame_at(0.27)].values).distance_mm, 3);
}

TEST(Perform, OpensTheMouthInOpenVowelsAndRoundsItInRoundOnes) {
  const Phones phones =
      say({{"SIL", 200}, {"AA", 180}, {"SIL", 250}, {"UW", 180}, {"SIL", 250}, {"IY", 180}, {"SIL", 200}});
  const Performance performance = act(phones, still(), &probe::head());
  const auto gap = [&](double time_s) {
    return lip_gap_mm(probe::head(), pose_points(probe::head(), performance.weights[performance.frame_at(time_s)]));
  };
  const std::size_t aa = performance.frame_at(0.29), uw = performance.frame_at(0.72), iy = performance.frame_at(1.15);
  EXPECT_GT(gap(0.29), 12);
  EXPECT_LT(gap(0.05), 1);
  EXPECT_GT(performance.weight(uw, "mouthPucker"), 0.6);
  EXPECT_GT(performance.weight(iy, "mouthStretchLeft"), 0.15);
  EXPECT_LT(performance.weight(iy, "mouthPucker"), 0.1);
  EXPECT_GT(performance.weight(aa, "jawOpen"), 2.5 * performance.weight(iy, "jawOpen"));
}

TEST(Perform, AnticipatesTheVowelInTheConsonantBeforeIt) {
  const auto pucker_in_s = [&](const char* vowel) {
    const Performance performance = act(say({{"SIL", 200}, {"S", 100}, {vowel, 150}, {"SIL", 200}}), still());
    return performance.weight(performance.frame_at(0.27), "mouthPucker");
  };
  EXPECT_GT(pucker_in_s("UW"), pucker_in_s("IY") + 0.15);
}

TEST(Perform, HasTheSamePoseAtTheSameTimeForAnyRate) {
  PerformOptions slow, fast;
  slow.rate_hz = 25;
  fast.rate_hz = 50;
  const Performance a = act(sentence(), slow, &probe::head()), b = act(sentence(), fast, &probe::head());
  ASSERT_GE(b.weights.size() + 1, 2 * a.weights.size());
  for (std::size_t f = 0; f < a.weights.size() && 2 * f < b.weights.size(); ++f) {
    EXPECT_EQ(a.weights[f].values, b.weights[2 * f].values) << f;
    EXPECT_EQ(a.world_from_head[f].rotation, b.world_from_head[2 * f].rotation) << f;
    EXPECT_EQ(a.world_from_head[f].translation_mm, b.world_from_head[2 * f].translation_mm) << f;
  }
}

TEST(Perform, FollowsAGivenTimeline) {
  Timeline timeline;
  timeline.time_s = {0.24, 0.32, 1.0};
  timeline.duration_s = 1.04;
  PerformOptions options;
  options.rate_hz = 50;
  const Performance given = act(sentence(), options, nullptr, &timeline), whole = act(sentence(), options);
  ASSERT_EQ(given.weights.size(), 3u);
  EXPECT_EQ(given.result.timeline.time_s, timeline.time_s);
  EXPECT_EQ(given.weights[0].values, whole.weights[12].values);
  EXPECT_EQ(given.weights[2].values, whole.weights[50].values);
}

TEST(Perform, IsTheSameForASeedAndAnotherForAnother) {
  PerformOptions options;
  const Performance a = act(sentence(), options), b = act(sentence(), options);
  options.seed = 2;
  const Performance c = act(sentence(), options);
  for (std::size_t f = 0; f < a.weights.size(); ++f) EXPECT_EQ(a.weights[f].values, b.weights[f].values);
  EXPECT_NE(a.weights[30].values, c.weights[30].values);
  EXPECT_NE(a.world_from_head[30].translation_mm, c.world_from_head[30].translation_mm);
}

TEST(Perform, KeepsStillWhatIsSwitchedOff) {
  const Performance performance = act(sentence(), still());
  for (std::size_t f = 0; f < performance.weights.size(); ++f) {
    for (std::size_t s = 0; s < arkit_count; ++s)
      if (arkit_names[s].starts_with("eye") || arkit_names[s].starts_with("brow")) {
        EXPECT_EQ(performance.weights[f].values[s], 0) << arkit_names[s];
      }
    EXPECT_EQ(performance.world_from_head[f].rotation, RigidMotion().rotation);
    EXPECT_EQ(performance.world_from_head[f].translation_mm, RigidMotion().translation_mm);
  }
}

TEST(Perform, TurnsTheHeadToBothSidesWhereAsked) {
  PerformOptions options = still();
  options.turn_deg = 30;
  options.turn_s = 2;
  const Performance performance = act(sentence(), options);
  const auto turned_deg = [&](double time_s) {
    const auto& r = performance.world_from_head[performance.frame_at(time_s)].rotation;
    EXPECT_NEAR(r[4], 1, 1e-12);  // about the vertical alone
    return std::atan2(r[2], r[0]) * 180 / std::numbers::pi;
  };
  EXPECT_NEAR(turned_deg(0), 0, 1e-9);
  EXPECT_NEAR(turned_deg(0.5), 30, 1e-9);  // its left is +x
  EXPECT_NEAR(turned_deg(1.5), -30, 1e-9);
  // About the neck, which stays, and with the same face.
  const RigidMotion& side = performance.world_from_head[performance.frame_at(0.5)];
  EXPECT_NEAR(side.translation_mm[1], 0, 1e-12);
  const Performance straight = act(sentence(), still());
  for (std::size_t f = 0; f < straight.weights.size(); ++f)
    EXPECT_EQ(straight.weights[f].values, performance.weights[f].values);
  options.turn_s = 0;
  EXPECT_THROW_TEXT(act(sentence(), options), "turn_s is 0, expected more than 0");
}

TEST(Perform, LivesInPauses) {
  PerformOptions options;
  options.rate_hz = 50;
  const Performance performance = act(say({{"SIL", 20000}}), options, &probe::head());
  int blinks = 0;
  double farthest_deg = 0, most_gaze = 0;
  for (std::size_t f = 1; f < performance.weights.size(); ++f) {
    blinks += performance.weight(f, "eyeBlinkLeft") > 0.5 && performance.weight(f - 1, "eyeBlinkLeft") <= 0.5;
    most_gaze = std::max(most_gaze, performance.weight(f, "eyeLookOutLeft"));
    const double trace = performance.world_from_head[f].rotation[0] + performance.world_from_head[f].rotation[4] +
                         performance.world_from_head[f].rotation[8];
    farthest_deg = std::max(farthest_deg, std::acos(std::min(1.0, 0.5 * (trace - 1))) * 57.2958);
    EXPECT_LT(performance.weight(f, "jawOpen"), 0.02);
  }
  EXPECT_GE(blinks, 3);
  EXPECT_LE(blinks, 14);
  EXPECT_GT(farthest_deg, 2);
  EXPECT_LT(farthest_deg, 20);
  EXPECT_GT(most_gaze, 0.05);
}

TEST(Perform, MovesWithoutJumps) {
  PerformOptions options;
  options.rate_hz = 120;
  const Performance performance = act(sentence(), options, &probe::head());
  for (std::size_t f = 1; f < performance.weights.size(); ++f) {
    for (std::size_t s = 0; s < arkit_count; ++s) {
      const float weight = performance.weights[f].values[s];
      EXPECT_TRUE(weight >= 0 && weight <= 1) << arkit_names[s];
      // The fastest are a roll into F (1 in 70 ms, eased: 2/s at 1.5 of the mean) and the lids.
      EXPECT_LT(std::abs(weight - performance.weights[f - 1].values[s]), 0.27) << arkit_names[s] << " " << f;
    }
    const RigidMotion &a = performance.world_from_head[f - 1], &b = performance.world_from_head[f];
    for (std::size_t k = 0; k < 9; ++k) EXPECT_LT(std::abs(a.rotation[k] - b.rotation[k]), 0.01);
    double determinant_row = 0;
    for (std::size_t k = 0; k < 3; ++k) determinant_row += b.rotation[k] * b.rotation[k];
    EXPECT_NEAR(determinant_row, 1, 1e-12);
  }
}

TEST(Perform, MumblesAtLowStrength) {
  PerformOptions quiet = still();
  quiet.strength = 0.3;
  const Performance loud = act(sentence(), still()), low = act(sentence(), quiet);
  const std::size_t frame = loud.frame_at(0.37);  // AE
  EXPECT_LT(low.weight(frame, "jawOpen"), 0.4 * loud.weight(frame, "jawOpen"));
}

TEST(Perform, KnowsEveryPhoneOfArpabet) {
  for (const char* label : {"AA", "AE", "AH", "AO", "AW", "AY", "B", "CH", "D", "DH", "EH", "ER", "EY", "F",
                            "G",  "HH", "IH", "IY", "JH", "K",  "L", "M",  "N", "NG", "OW", "OY", "P",  "R",
                            "S",  "SH", "T",  "TH", "UH", "UW", "V", "W",  "Y", "Z",  "ZH", "SIL"})
    EXPECT_NE(find_gesture(label), nullptr) << label;
}

TEST(Perform, HasNoFramesOfNothing) {
  EXPECT_TRUE(act(Phones(), {}).weights.empty());
  Timeline timeline;
  timeline.time_s = {0};
  timeline.duration_s = 0.04;
  EXPECT_EQ(act(Phones(), {}, nullptr, &timeline).weights.size(), 1u);
}

TEST(Perform, RejectsTimesWithoutEnd) {
  Timeline timeline;
  timeline.time_s = {0, INFINITY};
  timeline.duration_s = INFINITY;
  EXPECT_THROW_TEXT(act(sentence(), {}, nullptr, &timeline),
                    "timeline frame 1 is at inf s, expected a time within 1000000 s");
  Phones phones = sentence();
  phones.duration_s = NAN;
  EXPECT_THROW_TEXT(act(phones, {}), "the end of phones is at nan s, expected a time within 1000000 s");
}

TEST(Perform, RejectsWhatItCannotSay) {
  EXPECT_THROW_TEXT(act(say({{"SIL", 100}, {"AA1", 100}}), {}),
                    "phone 1 is \"AA1\", expected an ARPAbet label without stress or SIL");
  PerformOptions options;
  options.strength = -1;
  EXPECT_THROW_TEXT(act(sentence(), options), "strength is -1, expected at least 0");
}

// A stream in which all takes blinked at the same times, with the head in the same place, could not tell a blink from
// what is said first.
TEST(Perform, TakesOfOneSpeakerDifferInAllBesideSpeech) {
  const Phones phones = say({{"SIL", 2000}, {"AA", 300}, {"M", 100}, {"IY", 2600}});
  const std::string one = "1", two = "2";
  const Performance alone = act(phones, {}), first = act(phones, {}, nullptr, nullptr, &one),
                    again = act(phones, {}, nullptr, nullptr, &one), second = act(phones, {}, nullptr, nullptr, &two);
  const auto differ = [](const Performance& a, const Performance& b, const char* shape) {
    double most = 0;
    for (std::size_t f = 0; f < a.weights.size(); ++f)
      most = std::max(most, std::abs(a.weight(f, shape) - b.weight(f, shape)));
    return most;
  };
  for (const Performance* other : {&alone, &second}) {
    EXPECT_GT(differ(first, *other, "eyeBlinkLeft"), 0.5);
    EXPECT_GT(differ(first, *other, "eyeLookInLeft"), 0.01);
    for (const char* shape : {"jawOpen", "mouthClose", "mouthSmileLeft", "mouthPucker"})
      EXPECT_EQ(differ(first, *other, shape), 0) << shape;
    EXPECT_NE(first.world_from_head[40].rotation, other->world_from_head[40].rotation);
  }
  EXPECT_EQ(differ(first, again, "eyeBlinkLeft"), 0);
}

}  // namespace
