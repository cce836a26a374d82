// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/arpabet.h"

#include <gtest/gtest.h>

using face::speech::arpabet_label;

TEST(Arpabet, DropsStressAndCase) {
  EXPECT_EQ(arpabet_label("AA1"), "AA");
  EXPECT_EQ(arpabet_label("iy0"), "IY");
  EXPECT_EQ(arpabet_label("hh"), "HH");
}

TEST(Arpabet, KnowsTheManyNamesOfSilence) {
  for (const char* name : {"", "sil", "SIL", "sp", "spn", "pau", "<sil>", "h#", "_"})
    EXPECT_EQ(arpabet_label(name), "SIL");
}

TEST(Arpabet, MapsThePhonesOfOtherSets) {
  EXPECT_EQ(arpabet_label("ax"), "AH");
  EXPECT_EQ(arpabet_label("axr"), "ER");
  EXPECT_EQ(arpabet_label("dx"), "T");
}

TEST(Arpabet, KeepsClosureAndRelease) {
  EXPECT_EQ(arpabet_label("p.C"), "P.c");
  EXPECT_EQ(arpabet_label("G.r"), "G.r");
  EXPECT_EQ(arpabet_label("AA.c"), "");
}

TEST(Arpabet, RefusesWhatIsNoPhone) {
  for (const char* name : {"QQ", "A", "AA3", "hello", "P.x"}) EXPECT_EQ(arpabet_label(name), "");
}
