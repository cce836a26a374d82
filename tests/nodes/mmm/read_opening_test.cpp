// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/read_opening.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/nodes/mmm/mouths.h"
#include "tests/support/expect_throw_text.h"

namespace face::mmm {
namespace {

Landmarks open_by(double px) { return {{{"62", 48, 30, true}, {"66", 48, 30 + px, true}}}; }

// How far a mouth is open at time t, 0 to 0.7.
double open_at(double t) { return 0.35 + 0.35 * std::sin(t); }

struct Film {
  std::vector<Image> images;
  std::vector<Landmarks> truth;
};

// share: of the truth that pictures show.
Film film(std::size_t frames, double step, double share = 1) {
  Film made;
  for (std::size_t i = 0; i < frames; ++i) {
    const double open = open_at(step * static_cast<double>(i));
    made.images.push_back(test::painted_mouth(share * open, 1));
    made.truth.push_back(open_by(30 * open));
  }
  return made;
}

double value(const Table& table, const std::string& column) {
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    if (table.columns[k] == column) return table.rows.at(0).values[k];
  return NAN;
}

TEST(ReadOpening, ReadsPicturesThatItHasNotSeen) {
  const Film known = film(60, 0.37), fresh = film(20, 0.91);
  const ReadOpeningResult result = read_opening(known.images, known.truth, fresh.images, fresh.truth);
  EXPECT_GT(value(result.table, "reader_r"), 0.99);
  EXPECT_GT(value(result.table, "r"), 0.99);
  EXPECT_NEAR(value(result.table, "amplitude"), 1, 0.05);
  EXPECT_LT(value(result.table, "error_px"), 0.7);
  ASSERT_EQ(result.frames.rows.size(), 20u);
  EXPECT_NEAR(result.frames.rows[0].values[1], 30 * open_at(0), 1e-9);
}

TEST(ReadOpening, AMouthThatMumblesHasASmallAmplitude) {
  const Film known = film(60, 0.37), fresh = film(20, 0.91, 0.5);
  const ReadOpeningResult result = read_opening(known.images, known.truth, fresh.images, fresh.truth);
  EXPECT_GT(value(result.table, "r"), 0.95);
  EXPECT_NEAR(value(result.table, "amplitude"), 0.5, 0.1);
}

TEST(ReadOpening, OneThatIsLateCorrelatesLess) {
  const Film known = film(60, 0.37);
  Film fresh = film(30, 0.4);
  fresh.images.insert(fresh.images.begin(), 2, fresh.images[0]);
  fresh.images.resize(30);
  EXPECT_LT(value(read_opening(known.images, known.truth, fresh.images, fresh.truth).table, "r"), 0.85);
}

TEST(ReadOpening, WithoutMotionThereIsNoCorrelation) {
  const Film known = film(60, 0.37), still = film(5, 0);
  const Table table = read_opening(known.images, known.truth, still.images, still.truth).table;
  EXPECT_TRUE(std::isnan(value(table, "r")));
  EXPECT_TRUE(std::isnan(value(table, "amplitude")));
}

TEST(ReadOpening, RejectsWhatDoesNotFit) {
  const Film known = film(6, 0.37);
  std::vector<Landmarks> few(known.truth.begin(), known.truth.end() - 1);
  EXPECT_THROW_TEXT(read_opening(known.images, few, known.images, known.truth),
                    "there are 6 known pictures and 5 landmarks of them, expected as many");
  EXPECT_THROW_TEXT(read_opening(known.images, known.truth, known.images, few),
                    "there are 6 pictures and 5 true landmarks, expected as many");
  EXPECT_THROW_TEXT(read_opening(known.images, known.truth, known.images, known.truth, {.upper = "lip"}),
                    "frame 0 has no landmark lip");
  EXPECT_THROW_TEXT(read_opening(std::vector<Image>{}, std::vector<Landmarks>{}, known.images, known.truth),
                    "there are 0 known pictures, expected at least 4");
}

}  // namespace
}  // namespace face::mmm
