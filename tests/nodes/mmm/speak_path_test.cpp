// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/speak_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/mmm/spoken_steps.h"
#include "tests/support/expect_throw_text.h"

namespace face::mmm {
namespace {

Phones phones_of(const std::vector<std::pair<const char*, double>>& lengths_s) {
  Phones phones;
  for (const auto& [label, length_s] : lengths_s) {
    Phone phone;
    phone.label = label, phone.start_s = phones.duration_s, phone.end_s = phones.duration_s += length_s;
    phones.phones.push_back(phone);
  }
  return phones;
}

PhoneStatistics open_and_shut() {
  PhoneStatistics statistics;
  statistics.all = {"", 100, {0.5}, {1}};
  statistics.phones = {{"AA", 50, {1}, {0.1}}, {"M", 50, {0}, {0.1}}, {"SIL", 20, {0.3}, {0.1}}};
  return statistics;
}

std::vector<double> spoken(const Phones& phones, const PhoneStatistics& statistics, const SpeakPathOptions& options) {
  std::vector<double> path;
  engine::SeqWriter<Weights> writer(
      [&](std::string, const Weights& frame) { path.push_back(static_cast<double>(frame.values.at(0))); });
  const Timeline timeline = speak_path(phones, statistics, writer, options);
  EXPECT_EQ(timeline.time_s.size(), path.size());
  return path;
}

TEST(SpokenSteps, LipsAreShutAllThroughAClosure) {
  const Phones phones = phones_of({{"AA", 0.1}, {"P.c", 0.06}, {"P.r", 0.04}, {"AA", 0.1}});
  std::vector<double> time_s;
  for (int i = 0; i < 30; ++i) time_s.push_back(0.01 * i + 0.005);
  const SpokenSteps steps = spoken_steps(phones, time_s, true);
  for (std::size_t i = 0; i < 30; ++i) EXPECT_EQ(steps.held[i], i >= 10 && i < 16) << i;
  EXPECT_EQ(steps.phone[12], 1u);
  EXPECT_EQ(steps.phone[17], 2u);
  for (const bool held : spoken_steps(phones, time_s, false).held) EXPECT_FALSE(held);
}

TEST(SpokenSteps, AStopThatIsNotSplitIsShutForThreeFifths) {
  const SpokenSteps steps = spoken_steps(phones_of({{"B", 0.1}, {"AA", 0.1}}), {0.01, 0.05, 0.07, 0.09, 0.15}, true);
  EXPECT_EQ(steps.held, (std::vector<bool>{true, true, false, false, false}));
}

TEST(SpokenSteps, AClosureShorterThanAFrameIsOnOne) {
  const std::vector<double> frame_s{0, 0.1, 0.2};
  const SpokenSteps steps = spoken_steps(phones_of({{"AA", 0.13}, {"P.c", 0.01}, {"AA", 0.16}}), frame_s, true);
  EXPECT_EQ(steps.held, (std::vector<bool>{false, true, false}));
  EXPECT_EQ(steps.phone[1], 1u);
}

TEST(SpokenSteps, SilenceAtTheEndsHasALabelOfItsOwn) {
  EXPECT_EQ(spoken_labels(phones_of({{"SIL", 0.1}, {"AA", 0.1}, {"SIL", 0.1}, {"AA", 0.1}, {"SIL", 0.1}})),
            (std::vector<std::string>{"SIL.edge", "AA", "SIL", "AA", "SIL.edge"}));
}

TEST(SpokenSteps, AFramesStepsReachUpToTheNext) {
  EXPECT_EQ(step_times({0, 1, 3}, 4, 2), (std::vector<double>{0, 0.5, 1, 2, 3, 3.5}));
}

TEST(SpeakPath, ShutsTheLipsWhereverThereIsAClosureBetweenFrames) {
  // Closures of 50 ms at any place among frames of 33 ms: some frame of each is shut.
  for (double start_s = 0.2; start_s < 0.24; start_s += 0.005) {
    const std::vector<double> path =
        spoken(phones_of({{"AA", start_s}, {"M", 0.05}, {"AA", 0.3}}), open_and_shut(), {});
    EXPECT_LT(*std::min_element(path.begin(), path.end()), 0.02) << start_s;
    EXPECT_GT(path.back(), 0.9);
  }
}

TEST(SpeakPath, AShiftByAPartOfAFrameShiftsThePath) {
  const auto at = [&](double start_s) {
    return spoken(phones_of({{"AA", start_s}, {"M", 0.1}, {"AA", 0.3}}), open_and_shut(), {.steps = 32});
  };
  const std::vector<double> early = at(0.2), late = at(0.2 + 1 / 30.0);
  for (std::size_t t = 1; t + 4 < early.size(); ++t) EXPECT_NEAR(early[t], late[t + 1], 0.01);
  const std::vector<double> between = at(0.2 + 0.5 / 30.0);
  EXPECT_GT(between[5], early[5]);
  EXPECT_LT(between[5], late[5]);
}

TEST(SpeakPath, IsTheSameCurveAtAnotherRate) {
  const Phones phones = phones_of({{"SIL", 0.2}, {"AA", 0.15}, {"M", 0.08}, {"AA", 0.2}, {"SIL", 0.2}});
  const std::vector<double> slow = spoken(phones, open_and_shut(), {.rate_hz = 30, .steps = 16}),
                            fast = spoken(phones, open_and_shut(), {.rate_hz = 60, .steps = 8});
  for (std::size_t t = 0; t < slow.size(); ++t) EXPECT_NEAR(slow[t], fast[2 * t], 0.02) << t;
}

TEST(SpeakPath, SilenceAtTheEndsIsAsInPausesWhereNothingElseIsKnown) {
  PhoneStatistics statistics = open_and_shut();
  const Phones phones = phones_of({{"SIL", 0.3}, {"AA", 0.2}, {"SIL", 0.3}});
  EXPECT_NEAR(spoken(phones, statistics, {}).front(), 0.3, 0.05);
  statistics.phones.push_back({"SIL.edge", 10, {0}, {0.1}});
  EXPECT_NEAR(spoken(phones, statistics, {}).front(), 0, 0.05);
}

TEST(SpeakPath, RejectsStatisticsThatDoNotFit) {
  EXPECT_THROW_TEXT(spoken(Phones{}, open_and_shut(), {}), "there are no phones to speak");
  EXPECT_THROW_TEXT(spoken(phones_of({{"AA", 0.1}}), PhoneStatistics{}, {}),
                    "the statistics are of no animation parameters");
  PhoneStatistics flat = open_and_shut();
  flat.phones[0].covariance = {0};
  EXPECT_THROW_TEXT(spoken(phones_of({{"AA", 0.1}}), flat, {}),
                    "the statistic of \"AA\" has a variance of 0, expected more than 0");
  flat.phones[0].covariance = {1, 2};
  EXPECT_THROW_TEXT(spoken(phones_of({{"AA", 0.1}}), flat, {}),
                    "the statistic of \"AA\" has 1 means and 2 covariances, expected 1 and 1");
}

}  // namespace
}  // namespace face::mmm
