// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/leave_openings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "nodes/base/scan_points.h"
#include "nodes/model/sample_scan.h"
#include "tests/support/expect_throw_text.h"

namespace face::model {
namespace {

constexpr int size = 64;

// A wall of 1 mm per pixel with a slit from column 20 to 43: rows from top to bottom are not measured.
DepthScan wall(int top, int bottom) {
  DepthScan scan;
  scan.camera.focal_px = 200;
  scan.camera.position_mm = {0, 0, 200};
  scan.camera.centre_x_px = scan.camera.centre_y_px = 31.5f;
  scan.depth_mm.assign(size * size, 200);
  scan.picture = {size, size, 1, std::vector<std::uint8_t>(size * size, 90)};
  for (int y = top; y <= bottom; ++y)
    for (int x = 20; x < 44; ++x) scan.depth_mm[static_cast<std::size_t>(size * y + x)] = 0;
  return scan;
}

int row_of(const DepthScan& scan, const Vec3f& point) {
  return static_cast<int>(std::lround(pixel_of(scan.camera, point).y_px));
}

}  // namespace

TEST(LeaveOpenings, PutsLipsThatLieInTheOpeningAtItsEdge) {
  const DepthScan reference = wall(24, 39), frame = wall(20, 43);
  const Mesh mesh = scan_mesh(reference);
  const MeshPoints result = leave_openings(mesh, {mesh.points_mm}, frame);
  int moved = 0;
  for (std::size_t v = 0; v < mesh.points_mm.size(); ++v) {
    const ScanPixel at = pixel_of(frame.camera, result.points_mm[v]);
    const auto x = static_cast<int>(std::lround(at.x_px)), y = static_cast<int>(std::lround(at.y_px));
    EXPECT_GT(frame.depth_mm[static_cast<std::size_t>(size * y + x)], 0) << x << ", " << y;
    if (result.points_mm[v] == mesh.points_mm[v] || x < 26 || x > 37) continue;  // in the corners they go aside
    ++moved;
    const int before = row_of(frame, mesh.points_mm[v]);
    EXPECT_TRUE(before < 32 ? y == 19 : y == 44) << before << " to " << y;
  }
  EXPECT_EQ(moved, 24);
}

TEST(LeaveOpenings, BringsBackALipThatLiesOnTheOther) {
  const DepthScan reference = wall(24, 39), frame = wall(30, 33);
  const Mesh mesh = scan_mesh(reference);
  MeshPoints shape{mesh.points_mm};  // the upper lip is where the frame has it, the lower lip's edge on the upper lip
  for (std::size_t v = 0; v < shape.points_mm.size(); ++v) {
    const int row = row_of(reference, mesh.points_mm[v]);
    shape.points_mm[v][1] += row < 32 ? (row > 20 ? -6.0f : 0.0f) : row < 42 ? 14.0f : row < 46 ? 6.0f : 0.0f;
  }
  const MeshPoints result = leave_openings(mesh, shape, frame);
  int brought = 0;
  for (std::size_t v = 0; v < shape.points_mm.size(); ++v) {
    const ScanPixel at = pixel_of(frame.camera, result.points_mm[v]);
    if (row_of(reference, mesh.points_mm[v]) < 40 || at.x_px < 24 || at.x_px > 39) continue;
    brought += result.points_mm[v] != shape.points_mm[v] ? 1 : 0;
    EXPECT_GE(row_of(frame, result.points_mm[v]), 34);
  }
  EXPECT_GE(brought, 6);
}

// A jaw that fell faster than the scanner follows: the flow has left its lip, 10 pixels of it, in the opening.
TEST(LeaveOpenings, TakesOutALipThatWasLostAsAWhole) {
  const DepthScan reference = wall(20, 27), frame = wall(20, 43);
  const Mesh mesh = scan_mesh(reference);
  MeshPoints shape{mesh.points_mm};
  for (std::size_t v = 0; v < shape.points_mm.size(); ++v) {
    const int row = row_of(reference, mesh.points_mm[v]);
    if (row > 38 && row < 57) shape.points_mm[v][1] -= 6;
  }
  const MeshPoints result = leave_openings(mesh, shape, frame);
  int lost = 0;
  for (std::size_t v = 0; v < shape.points_mm.size(); ++v) {
    const ScanPixel at = pixel_of(frame.camera, result.points_mm[v]);
    const auto x = static_cast<int>(std::lround(at.x_px)), y = static_cast<int>(std::lround(at.y_px));
    EXPECT_GT(frame.depth_mm[static_cast<std::size_t>(size * y + x)], 0) << x << ", " << y;
    if (row_of(frame, shape.points_mm[v]) > 43 || row_of(frame, shape.points_mm[v]) < 28 || x < 26 || x > 37) continue;
    ++lost;
    EXPECT_EQ(y, 44);
  }
  EXPECT_GE(lost, 24);
}

TEST(LeaveOpenings, LeavesAShutMouthAndWhatIsBesideTheFaceAlone) {
  const DepthScan reference = wall(24, 39);
  const Mesh mesh = scan_mesh(reference);
  EXPECT_EQ(leave_openings(mesh, {mesh.points_mm}, wall(1, 0)).points_mm, mesh.points_mm);
  EXPECT_EQ(leave_openings(mesh, {mesh.points_mm}, reference).points_mm, mesh.points_mm);
  DepthScan cut = wall(1, 0);  // a face that ends higher than the reference's
  for (std::size_t i = size * 54; i < cut.depth_mm.size(); ++i) cut.depth_mm[i] = 0;
  EXPECT_EQ(leave_openings(mesh, {mesh.points_mm}, cut).points_mm, mesh.points_mm);
}

TEST(LeaveOpenings, RejectsAShapeOfAnotherMesh) {
  const DepthScan scan = wall(24, 39);
  EXPECT_THROW_TEXT(leave_openings(scan_mesh(scan), {}, scan),
                    "shape has 0 points, the mesh " + std::to_string(scan_mesh(scan).points_mm.size()));
}

}  // namespace face::model
