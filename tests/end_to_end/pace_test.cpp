// SPDX-License-Identifier: Apache-2.0
#include "cli/pace.h"

#include <gtest/gtest.h>

namespace {

using Kind = engine::RunEvent::Kind;

engine::RunEvent event(Kind kind, double time_s, const char* node, std::size_t done, std::size_t known,
                       double fraction = 0) {
  engine::RunEvent event;
  event.kind = kind;
  event.time_s = time_s;
  event.node = node;
  event.done = done;
  event.known = known;
  event.fraction = fraction;
  return event;
}

TEST(Pace, ALongLastTaskIsForetoldByWhatItSaysOfItself) {
  cli::Pace pace;
  pace.see(event(Kind::started, 10, "film", 999, 1000));
  const auto later = event(Kind::progress, 40, "film", 999, 1000, 0.25);
  pace.see(later);
  EXPECT_EQ(pace.left(later), "2 min left");  // 30 s were a quarter
  EXPECT_EQ(pace.task(later), "film 25 %");
}

TEST(Pace, TasksThatWaitAreTakenToLastAsLongAsThoseDone) {
  cli::Pace pace;
  EXPECT_EQ(pace.left(event(Kind::finished, 20, "frame", 50, 100)), "20 s left");
}

TEST(Pace, WhatTheStoreHadTookNoTime) {
  cli::Pace pace;
  for (std::size_t i = 1; i <= 80; ++i) pace.see(event(Kind::reused, 0, "frame", i, 100));
  EXPECT_EQ(pace.left(event(Kind::finished, 30, "frame", 90, 100)), "30 s left");
}

TEST(Pace, ALastTaskThatSaysNothingHasNoTimeLeft) {
  cli::Pace pace;
  const auto begun = event(Kind::started, 30, "film", 999, 1000);
  pace.see(begun);
  EXPECT_EQ(pace.left(begun), "");
  EXPECT_EQ(pace.task(begun), "film");
}

TEST(Pace, AnElementIsNamedWithItsId) {
  engine::RunEvent one = event(Kind::started, 1, "frame", 0, 2);
  one.element = "17";
  EXPECT_EQ(cli::task_name(one), "frame[17]");
}

}  // namespace
