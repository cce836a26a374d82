// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/find_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "tests/nodes/track/grid_clip.h"
#include "tests/nodes/track/lips_in.h"
#include "tests/nodes/track/phantom_clip.h"
#include "tests/support/data.h"
#include "tests/support/expect_throw_text.h"

using namespace face;

namespace {

std::vector<double> contacts_of(const std::vector<double>& openings, const track::FindContactOptions& options = {},
                                const engine::Seq<Landmarks>* landmarks = nullptr) {
  std::vector<double> found;
  engine::SeqWriter<double> writer([&](const std::string&, double contact) { found.push_back(contact); });
  track::find_contact(engine::Seq<double>(openings), landmarks, writer, options);
  return found;
}

// Of frames whose points are known.
std::vector<double> contacts_of(const std::vector<std::shared_ptr<const Image>>& frames,
                                const std::vector<Landmarks>& points) {
  std::vector<double> openings;
  std::vector<Landmarks> lips;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    openings.push_back(test::mouth_opening_in(*frames[i], points[i]));
    lips.push_back(test::inner_lips_in(*frames[i], points[i]));
  }
  const engine::Seq<Landmarks> landmarks(lips);
  return contacts_of(openings, {}, &landmarks);
}

// 80 frames, of which five are shut.
std::vector<double> mostly_open() {
  std::vector<double> openings(80, 0.1);
  for (std::size_t i = 10; i < 15; ++i) openings[i] = 0.006 + 0.0001 * static_cast<double>(i);
  return openings;
}

}  // namespace

TEST(FindContact, TellsTheFewFramesThatShowLeast) {
  const std::vector<double> found = contacts_of(mostly_open());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i], i >= 10 && i < 15 ? 1 : 0) << i;
}

TEST(FindContact, ASeamThatShowsLittleMakesWhoSmilesOpenNoSooner) {
  std::vector<double> openings = mostly_open();
  for (double& opening : openings)
    if (opening < 0.05) opening = 0;  // lips that are pressed show nothing
  openings[40] = 0.008;               // and lips at rest a little
  openings[41] = 0.014;
  const std::vector<double> found = contacts_of(openings);
  EXPECT_EQ(found[12], 1);
  EXPECT_EQ(found[40], 1);
  EXPECT_EQ(found[41], 0);
}

TEST(FindContact, AMouthThatNeverShutsMeetsNowhere) {
  std::vector<double> openings(80, 0.2);
  for (std::size_t i = 10; i < 30; ++i) openings[i] = 0.08;
  for (const double contact : contacts_of(openings)) EXPECT_EQ(contact, 0);
}

TEST(FindContact, FadesFromShutToOpen) {
  std::vector<double> openings = mostly_open(), found;
  for (std::size_t i = 0; i < 20; ++i) openings[40 + i] = 0.01 + 0.0015 * static_cast<double>(i);
  found = contacts_of(openings);
  EXPECT_EQ(found[40], 1);
  EXPECT_EQ(found[59], 0);
  for (std::size_t i = 41; i < 60; ++i) {
    EXPECT_LE(found[i], found[i - 1]);
    EXPECT_LE(found[i - 1] - found[i], 0.2);  // a little more is no leap
  }
}

TEST(FindContact, KnowsNothingOfFramesThatAreNotSeen) {
  std::vector<double> openings = mostly_open();
  openings[11] = -1;
  EXPECT_EQ(contacts_of(openings)[11], 0);
  EXPECT_EQ(contacts_of({-1, -1}), (std::vector<double>{0, 0}));
  EXPECT_TRUE(contacts_of(std::vector<double>{}).empty());
}

TEST(FindContact, ALowerLipBehindTheTeethMeetsNoLip) {
  const std::vector<double> openings(20, 0.006);
  std::vector<Landmarks> lips;
  for (int t = 0; t < 20; ++t) {
    const double lower_px = t == 7 ? 8 : t == 8 ? 11 : 12;
    Landmarks points;
    for (int k = 1; k <= 3; ++k) {
      points.points.push_back({"lip_" + std::to_string(k + 1), 10.0 * k, 100, true});
      points.points.push_back({"inner_lip_" + std::to_string(k), 10.0 * k, t == 7 ? 110.0 : 108.0, true});
      points.points.push_back({"inner_lip_" + std::to_string(8 - k), 10.0 * k, 111, true});
      points.points.push_back({"lip_" + std::to_string(11 - k), 10.0 * k, 111 + lower_px, true});
    }
    lips.push_back(points);
  }
  const engine::Seq<Landmarks> landmarks(lips);
  const std::vector<double> found = contacts_of(openings, {}, &landmarks);
  for (std::size_t t = 0; t < found.size(); ++t) EXPECT_EQ(found[t], t == 7 ? 0 : 1) << t;
}

TEST(FindContact, RejectsWhatIsNoOpening) {
  EXPECT_THROW_TEXT(contacts_of({0.5, NAN}), "the opening of frame 1 is nan, expected a finite number");
  const engine::Seq<Landmarks> none;
  EXPECT_THROW_TEXT(contacts_of({0.5}, {}, &none), "there are 0 landmarks, expected 1 as openings");
  track::FindContactOptions options;
  options.shut_ratio = 2, options.open_ratio = 1.5;
  EXPECT_THROW_TEXT(contacts_of({0.5}, options), "shut_ratio is 2, expected less than open_ratio, which is 1.5");
}

// Where the phantom's lips meet and where they are 2 mm apart and more, from the true outer points.
TEST(FindContact, TellsThePhantomsClosures) {
  const test::PhantomClip clip = test::film_phantom("Bob may move five warm loaves.", 60, test::Dots::none);
  const std::vector<double> found = contacts_of(clip.frames, clip.truth);
  const double shut_px = *std::min_element(clip.inner_gap_px.begin(), clip.inner_gap_px.end());
  int shut = 0, open = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double gap_px = clip.inner_gap_px[i] - shut_px;
    if (gap_px < 0.4) {
      EXPECT_GE(found[i], 0.9) << i;
      ++shut;
    } else if (gap_px > 3) {
      EXPECT_LE(found[i], 0.1) << i;
      ++open;
    }
  }
  std::printf("%d shut, %d open\n", shut, open);
  EXPECT_GE(shut, 5);
  EXPECT_GE(open, 20);
}

// Frames of the clips that were told apart by eye before anything was tuned: P and B, and vowels.
TEST(FindContact, TellsRealBilabialsFromVowels) {
  DATA_FILE(data, "grid");
  struct Seen {
    std::vector<std::size_t> shut, open;
  };
  const std::map<std::string, Seen> seen = {
      {"bbaf2n", {{22, 23, 24, 27, 28, 29, 30, 60}, {12, 13, 16, 18, 26, 33, 36, 44, 49}}},
      {"brbk7n", {{10, 11, 12, 17, 23, 24}, {15, 20, 27, 31, 45, 57}}},
      {"lbax4n", {{18, 19, 60, 70}, {3, 14, 21, 32, 44, 48, 52}}},
      {"lrwp9a", {{1, 31, 32, 60}, {8, 12, 16, 22, 25, 36, 45, 53}}},
      {"pwij3p", {{10, 11, 12, 42, 43, 44, 60}, {2, 7, 14, 20, 22, 32, 40, 48}}},
      {"swwp2s", {{31, 32, 33, 65}, {1, 10, 16, 22, 25, 35, 40, 47}}},
  };
  for (const auto& [clip, frames_of] : seen) {
    const auto frames = test::read_frames(data + "/" + clip + ".mpg");
    const auto start = decode::read_landmarks(engine::File::at(data + "/" + clip + ".landmarks.json")).landmarks;
    std::vector<Landmarks> points;
    for (const auto& result : test::track_frames(frames, start)) points.push_back(result.landmarks);
    const std::vector<double> found = contacts_of(frames, points);
    for (const std::size_t i : frames_of.shut) EXPECT_GE(found[i], 0.5) << clip << " " << i;
    for (const std::size_t i : frames_of.open) EXPECT_LE(found[i], 0.1) << clip << " " << i;
  }
}
