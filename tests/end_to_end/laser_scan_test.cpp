// SPDX-License-Identifier: Apache-2.0
// The graphs of graphs/laser_scan, as a person runs them.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/command.h"

namespace {

using test::operator+;
using test::Ended;
using test::Words;
namespace fs = std::filesystem;

class LaserScan : public test::CommandTest {};

TEST_F(LaserScan, AModelIsBuiltFromScansWithoutAHand) {
  const Ended ended = wait(start(
      Words{"--store", path("store"), "run", graph("laser_scan/build_tiny.json"), "--quiet", "--out", path("out")}));
  ASSERT_EQ(ended.code, 0) << ended.output;
  for (const char* name : {"mean.png", "scanned.png", "spaces.csv", "expression_errors.csv", "person_errors.csv"})
    EXPECT_TRUE(fs::exists(fs::path(path("out")) / name)) << name;
  // A third of the scans' points of build.json, and six faces in place of 37: 0.97, 0.37 and 1.12 mm.
  EXPECT_LT(test::row_of(read("out/expression_errors.csv"), "mean.lips").at("median_mm"), 1.3);
  EXPECT_LT(test::row_of(read("out/expression_errors.csv"), "mean.all").at("median_mm"), 0.5);
  EXPECT_LT(test::row_of(read("out/person_errors.csv"), "mean.all").at("median_mm"), 1.5);
  const std::map<std::string, double> space = test::row_of(read("out/spaces.csv"), "expression");
  EXPECT_NEAR(space.at("angle_deg"), test::row_of(read("out/planted_spaces.csv"), "expression").at("angle_deg"), 5);
}

// The tiny graph's scans as files, and the points that were marked on two of them, then scans.json as for scans of
// one's own.
TEST_F(LaserScan, AModelIsBuiltFromFilesOfScans) {
  write("files.json", R"({
    "facegraph": 1, "extends": ")" +
                          graph("laser_scan/build_tiny.json") + R"(",
    "nodes": {
      "e": {"node": "export.cylinder", "inputs": {"scan": "expressions.scan"}},
      "p": {"node": "export.cylinder", "inputs": {"scan": "neutrals.scan"}}
    },
    "outputs": {"e_header.json": "e.header", "e_radius.png": "e.radius", "e_colour.png": "e.colour",
                "p_radius.png": "p.radius", "p_colour.png": "p.colour", "scanned.png": null, "mean.png": null,
                "spaces.csv": null, "planted_spaces.csv": null, "expression_errors.csv": null,
                "person_errors.csv": null, "resampled_errors.csv": null}
  })");
  const Ended exported = command({"run", "files.json", "--quiet", "--out", "scans"});
  ASSERT_EQ(exported.code, 0) << exported.output;
  for (const std::string name : {"landmarks", "person_landmarks"}) {
    const Ended got = command({"get", "files.json", name});
    ASSERT_EQ(got.code, 0) << got.output;
    const nlohmann::json found = nlohmann::json::parse(got.output);
    nlohmann::json points = {{"image_size", {192, 192}}};
    for (const nlohmann::json& point : found.at("points"))
      if (point.at("valid").get<bool>())
        points["points"][point.at("name").get<std::string>()] = {point.at("x_px"), point.at("y_px")};
    write(name + ".json", points.dump());
  }
  const Words files = {"--set", "header=scans/e_header/open_2.json",
                       "--set", "expression_radii=scans/e_radius",
                       "--set", "expression_colours=scans/e_colour",
                       "--set", "person_radii=scans/p_radius",
                       "--set", "person_colours=scans/p_colour",
                       "--set", "reference_radius=scans/e_radius/open_2.png",
                       "--set", "reference_colour=scans/e_colour/open_2.png",
                       "--set", "reference_points=landmarks.json",
                       "--set", "person_radius=scans/p_radius/1.png",
                       "--set", "person_colour=scans/p_colour/1.png",
                       "--set", "person_points=person_landmarks.json",
                       "--set", "neutral=viseme_01_rest",
                       "--set", "upper_teeth=teeth_2_open",
                       "--set", "lower_teeth=teeth_2_open",
                       "--set", "lamp_shading=0.35",
                       "--set", "row_step_px=2",
                       "--set", "column_step_px=1"};
  const Ended built = command(Words{"run", graph("laser_scan/scans.json"), "--quiet", "--out", "out"} + files);
  ASSERT_EQ(built.code, 0) << built.output;
  EXPECT_TRUE(exists("out/scanned.png"));
  EXPECT_TRUE(exists("out/spaces.csv"));
}

}  // namespace
