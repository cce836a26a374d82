// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nodes/evaluate/curve_plot.h"
#include "nodes/evaluate/draw_heat_map.h"
#include "nodes/evaluate/draw_text.h"
#include "nodes/evaluate/join_tables.h"
#include "nodes/evaluate/stack_tables.h"
#include "tests/nodes/evaluate/small_face.h"
#include "tests/nodes/evaluate/table_of.h"
#include "tests/support/expect_throw_text.h"

namespace face::evaluate {
namespace {

using test::cell;
using test::every;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

const Table one{{"a_mm", "b_ms"}, {{"all", {1, 2}}}};
const Table two{{"a_mm"}, {{"own", {3}}, {"truth", {4}}}};

TEST(JoinTables, NamesEveryNumberByItsColumnAndRow) {
  const Table joined = join_tables(one, nullptr, &two, &one, nullptr, nullptr, nullptr, nullptr);
  std::vector<std::string> names;
  for (const TableRow& row : joined.rows) names.push_back(row.name);
  EXPECT_EQ(names, (std::vector<std::string>{"a_mm", "b_ms", "own.a_mm", "truth.a_mm", "4.a_mm", "4.b_ms"}));
  EXPECT_EQ(cell(joined, "truth.a_mm", "value"), 4);
}

TEST(JoinTables, RejectsAHalfFilledRow) {
  const Table bad{{"a", "b"}, {{"x", {1}}}};
  EXPECT_THROW_TEXT(join_tables(bad, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr),
                    "table 1: row x has 1 values, expected 2");
}

TEST(StackTables, MeansWhatWasMeasured) {
  const Table other{{"a_mm", "b_ms"}, {{"all", {3, nothing}}}};
  const Table stacked = stack_tables(engine::Seq<Table>({one, other}, {"take1", "take2"}));
  EXPECT_EQ(cell(stacked, "take2", "a_mm"), 3);
  EXPECT_EQ(cell(stacked, "mean", "a_mm"), 2);
  EXPECT_EQ(cell(stacked, "mean", "b_ms"), 2);
  const Table rows = stack_tables(engine::Seq<Table>({two, two}));
  EXPECT_EQ(cell(rows, "mean.truth", "a_mm"), 4);
  EXPECT_THROW_TEXT(stack_tables(engine::Seq<Table>({one, two})), "table 1 has other columns than table 0");
  EXPECT_THROW_TEXT(stack_tables({}), "there are no tables to stack");
}

TEST(Ticks, AreRoundNumbersWithinTheRange) {
  EXPECT_EQ(ticks_between(0, 5), (std::vector<double>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(ticks_between(-0.5, 10.5).size(), 3u);  // 0, 5, 10
  EXPECT_EQ(ticks_between(2, 2), std::vector<double>{2});
  EXPECT_EQ(short_number(0.5), "0.5");
  EXPECT_EQ(short_number(-0.0), "0");
}

// Pixels that have this colour.
int count_of(const Image& image, const Colour& colour) {
  int count = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 3)
    count += image.pixels[i] == colour[0] && image.pixels[i + 1] == colour[1] && image.pixels[i + 2] == colour[2];
  return count;
}

TEST(CurvePlot, DrawsEveryCurveAndALabelStrip) {
  Table curves{{"own_mm", "truth_mm", "error_ms"}, {}};
  for (int i = 0; i < 50; ++i) curves.rows.push_back({"", {std::sin(0.2 * i), std::cos(0.2 * i), 5.0 * i}});
  const Timeline timeline = every(0.02, 50);
  const Phones phones = test::spoken({{"SIL", 0.3}, {"M", 0.6}, {"SIL", 1}});
  const Image plain = curve_plot(curves, nullptr, timeline, nullptr);
  const Image image = curve_plot(curves, nullptr, timeline, &phones);
  EXPECT_EQ(image.width, 1600);
  EXPECT_GT(image.height, plain.height);
  EXPECT_GT(count_of(image, {255, 176, 64}), 500);  // the first curve of both panels
  EXPECT_GT(count_of(image, {96, 176, 255}), 200);
  EXPECT_GT(count_of(image, {150, 60, 60}), 1000);  // the bar of M
  EXPECT_EQ(count_of(plain, {150, 60, 60}), 0);
  EXPECT_EQ(image.pixels, curve_plot(curves, nullptr, timeline, &phones).pixels);
}

TEST(CurvePlot, LeavesAGapWhereNothingWasMeasured) {
  Table whole{{"a"}, {}}, holed{{"a"}, {}};
  for (int i = 0; i < 50; ++i) {
    whole.rows.push_back({"", {1}});
    holed.rows.push_back({"", {i > 20 && i < 40 ? nothing : 1}});
  }
  const auto drawn = [](const Table& t) {
    return count_of(curve_plot(t, nullptr, every(0.02, 50), nullptr), {255, 176, 64});
  };
  EXPECT_LT(drawn(holed), 0.7 * drawn(whole));
}

TEST(CurvePlot, RejectsWhatIsNotOfTheTimeline) {
  const Table curves{{"a"}, {{"0", {1}}, {"1", {2}}}};
  EXPECT_THROW_TEXT(curve_plot(curves, nullptr, every(0.1, 3), nullptr), "curves has 2 rows, timeline has 3 frames");
  EXPECT_THROW_TEXT(curve_plot(curves, nullptr, Timeline{}, nullptr), "timeline has no frames to draw");
  CurvePlotOptions options;
  options.start_s = 9;
  EXPECT_THROW_TEXT(curve_plot(curves, nullptr, every(0.1, 2), nullptr, options),
                    "the plot ends at 0.2 s, expected more than its start, 9 s");
}

TEST(DrawHeatMap, ShowsMoreRedWhereErrorsGrow) {
  const Rig rig = test::small_face();
  const auto reddish = [&](double error_mm) {
    const Image image = draw_heat_map(rig, std::vector<double>(35, error_mm), 5);
    double red = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) red += double(image.pixels[i]) - image.pixels[i + 2];
    return red;
  };
  EXPECT_LT(reddish(0), reddish(4));
  EXPECT_THROW_TEXT(draw_heat_map(rig, {1}, 5), "there are 1 errors, the rig has 35 vertices");
}

}  // namespace
}  // namespace face::evaluate
