// SPDX-License-Identifier: Apache-2.0
// What export.depth and export.scan_camera write, decode.depth_take reads.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "nodes/decode/depth_take.h"
#include "nodes/export/export_depth.h"

namespace {

using namespace face;
namespace fs = std::filesystem;

DepthScan ball(int seed) {
  DepthScan scan;
  scan.camera.focal_px = 200;
  scan.camera.position_mm = {3, -4, 900};
  scan.camera.centre_x_px = 31.5f;
  scan.camera.centre_y_px = 23.5f;
  scan.picture = {64, 48, 1, {}};
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const double dx = (x - 31.5) * 4.5, dy = (y - 23.5) * 4.5, left = 80 * 80 - dx * dx - dy * dy;
      scan.depth_mm.push_back(left > 0 ? static_cast<float>(900.0 - std::sqrt(left)) : 0.0f);
      scan.picture.pixels.push_back(static_cast<std::uint8_t>((x + 3 * y + seed) % 256));
    }
  return scan;
}

}  // namespace

TEST(DepthRoundTrip, ComesBackToHalfAUnit) {
  const fs::path folder = fs::temp_directory_path() / ("depth_round_trip_" + std::to_string(getpid()));
  const auto write = [&](const fs::path& name, const engine::File& file) {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << file.bytes();
  };
  for (int t = 0; t < 3; ++t) {
    const exports::ExportDepthResult files = exports::export_depth(ball(t));
    write(fs::path("depth/a") / (std::to_string(t) + ".png"), files.depth);
    write(fs::path("picture/a") / (std::to_string(t) + ".png"), files.picture);
  }
  write("camera.json", exports::export_scan_camera(ball(0).camera, {.width_px = 64, .height_px = 48, .rate_hz = 25}));
  std::vector<engine::File::Entry> entries;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      entries.push_back({fs::relative(entry.path(), folder).string(), entry.path().string()});
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  std::vector<DepthScan> scans;
  engine::SeqWriter<DepthScan> writer([&](std::string, DepthScan scan) { scans.push_back(std::move(scan)); });
  engine::Progress quiet;
  const auto result = decode::depth_take(engine::File::folder(folder.string(), entries), "a", writer, {}, quiet);
  fs::remove_all(folder);
  EXPECT_EQ(result.report, "");
  EXPECT_EQ(result.timeline.time_s, (std::vector<double>{0, 0.04, 0.08}));
  ASSERT_EQ(scans.size(), 3u);
  for (int t = 0; t < 3; ++t) {
    const DepthScan truth = ball(t), &scan = scans[static_cast<std::size_t>(t)];
    EXPECT_EQ(scan.picture.pixels, truth.picture.pixels);
    EXPECT_EQ(scan.camera.position_mm, truth.camera.position_mm);
    EXPECT_EQ(scan.camera.cam_from_world, truth.camera.cam_from_world);
    for (std::size_t i = 0; i < truth.depth_mm.size(); ++i) ASSERT_NEAR(scan.depth_mm[i], truth.depth_mm[i], 0.0251);
  }
}
