// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/depth_frame.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/quantile.h"
#include "nodes/decode/depth_cloud.h"
#include "nodes/decode/depth_image.h"
#include "nodes/decode/input_file.h"

namespace face::decode {
namespace {

constexpr double most_shift_px = 2;  // of a cloud's points, beside their pixels

std::string leaf(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

// As the recording's owner knows it: depth/TAKE/17.png, or pattern/TAKE/17/0.png, which has four parts.
std::string place(const std::string& path, int count = 3) {
  std::size_t start = path.size();
  for (int parts = 0; parts < count && start != std::string::npos && start > 0; ++parts)
    start = path.find_last_of('/', start - 1);
  return start == std::string::npos ? path : path.substr(start + (start < path.size() && path[start] == '/' ? 1 : 0));
}

void check_size(const std::string& what, int width, int height, int expected_width, int expected_height) {
  check(width == expected_width && height == expected_height, what, " is ", width, " x ", height, " pixels, expected ",
        expected_width, " x ", expected_height);
}

// Depth, size and, where they have them, colours of a frame's cloud.
void take_cloud(const FramePaths& paths, const ScanCameraFile& camera, DepthScan& scan) {
  const std::string title = place(paths.cloud);
  const Cloud cloud = read_cloud(read_bytes_at(paths.cloud, title), title);
  int width = cloud.width > 0 ? cloud.width : camera.width_px,
      height = cloud.height > 0 ? cloud.height : camera.height_px;
  check(width > 0 && height > 0, title, " does not say its width and height, and neither does camera.json");
  const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  check(cloud.points.size() == count, title, " has ", cloud.points.size(), " points, expected ", width, " x ", height,
        ", one per pixel in reading order");
  scan.picture = {width, height, 3, {}};
  scan.depth_mm.assign(count, 0);
  std::vector<double> depths;
  for (const auto& p : cloud.points)
    if (std::isfinite(p[2]) && p[2] != 0) depths.push_back(p[2]);
  const double forward = median(depths) < 0 ? -1 : 1;  // z negative: y is up
  std::vector<double> shifts;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& p = cloud.points[i];
    const double z = forward * p[2];
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !(z > 0)) continue;
    scan.depth_mm[i] = static_cast<float>(z * camera.length_unit_mm);
    const double x =
        static_cast<double>(camera.camera.centre_x_px) + static_cast<double>(camera.camera.focal_px) * p[0] / z;
    const double y = static_cast<double>(camera.camera.centre_y_px) +
                     camera.aspect * static_cast<double>(camera.camera.focal_px) * forward * p[1] / z;
    shifts.push_back(std::hypot(x - static_cast<double>(i % static_cast<std::size_t>(width)),
                                y - static_cast<double>(i / static_cast<std::size_t>(width))));
  }
  const double shift = median(shifts);
  check(shift <= most_shift_px, "the intrinsics bring the points of ", title, " ", std::round(10 * shift) / 10,
        " px beside their pixels (median), expected at most ", most_shift_px,
        ": fx, fy, cx and cy are not those of this camera");
  if (cloud.colors.empty()) return;
  for (const auto& c : cloud.colors) scan.picture.pixels.insert(scan.picture.pixels.end(), c.begin(), c.end());
}

// Whether it is in whole numbers.
bool take_depth(const FramePaths& paths, const ScanCameraFile& camera, DepthScan& scan) {
  const DepthImage depth = read_depth_image(paths.depth, place(paths.depth));
  check(!depth.whole_numbers || depth.bits == 16, place(paths.depth), " has ", depth.bits,
        " bits per pixel, expected 16 bits or an EXR: 256 steps are too few for depth");
  scan.picture = {depth.width, depth.height, 1, {}};
  const double unit_mm = depth.whole_numbers ? camera.depth_unit_mm : camera.length_unit_mm;
  for (const float value : depth.values)
    scan.depth_mm.push_back(std::isfinite(value) && value > 0 ? static_cast<float>(unit_mm * static_cast<double>(value))
                                                              : 0.0f);
  return depth.whole_numbers;
}

void take_patterns(const FramePaths& paths, const ScanCameraFile& camera, const ScanProjectorFile* projector,
                   DepthScan& scan) {
  check(projector != nullptr, "it has fringe pictures, but there is no projector.json beside camera.json");
  check(std::fabs(camera.aspect - 1) < 1e-4, "it has fringe pictures, for which pixels must be as high as wide, fy is ",
        camera.aspect, " times fx");
  std::vector<Image> images;
  for (std::size_t k = 0; k < paths.patterns.size(); ++k) {
    check(!paths.patterns[k].empty(), "it has no fringe picture ", k, ", expected 0 to 4");
    images.push_back(read_levels(paths.patterns[k], place(paths.patterns[k], 4)));
    if (k > 0)
      check_size("its fringe picture " + leaf(paths.patterns[k]), images[k].width, images[k].height, images[0].width,
                 images[0].height);
  }
  scan =
      structured_light(engine::Seq<Image>(std::move(images)), camera.camera, projector->projector, projector->options);
}

// Rows resampled so that pixels are as high as wide; the place of the centre stays.
void make_square(double aspect, double centre_y_px, DepthScan& scan) {
  if (std::fabs(aspect - 1) < 1e-4) return;
  const DepthScan before = scan;
  const int width = scan.picture.width, height = scan.picture.height;
  const auto channels = static_cast<std::size_t>(scan.picture.channels);
  const std::size_t row = static_cast<std::size_t>(width) * channels;
  for (int y = 0; y < height; ++y) {
    const double from = centre_y_px + (y - centre_y_px) * aspect;
    const int nearest = static_cast<int>(std::lround(from));
    const bool inside = nearest >= 0 && nearest < height;
    const int y0 = std::clamp(static_cast<int>(std::floor(from)), 0, height - 1), y1 = std::min(y0 + 1, height - 1);
    const double share = std::clamp(from - y0, 0.0, 1.0);
    for (int x = 0; x < width; ++x)
      scan.depth_mm[static_cast<std::size_t>(y * width + x)] =
          inside ? before.depth_mm[static_cast<std::size_t>(nearest * width + x)] : 0.0f;
    for (std::size_t x = 0; x < row; ++x) {
      const double value = (1 - share) * before.picture.pixels[static_cast<std::size_t>(y0) * row + x] +
                           share * before.picture.pixels[static_cast<std::size_t>(y1) * row + x];
      scan.picture.pixels[static_cast<std::size_t>(y) * row + x] = static_cast<std::uint8_t>(std::lround(value));
    }
  }
}

}  // namespace

DepthFrame read_depth_frame(const FramePaths& paths, const ScanCameraFile& camera, const ScanProjectorFile* projector) {
  DepthFrame frame;
  DepthScan& scan = frame.scan;
  if (!paths.cloud.empty())
    take_cloud(paths, camera, scan);
  else if (!paths.depth.empty())
    frame.whole_numbers = take_depth(paths, camera, scan);
  else
    take_patterns(paths, camera, projector, scan);
  const int width = scan.picture.width, height = scan.picture.height;
  if (camera.width_px > 0 && camera.height_px > 0)
    check_size(!paths.cloud.empty()   ? "its cloud " + leaf(paths.cloud)
               : !paths.depth.empty() ? "its depth " + leaf(paths.depth)
                                      : "its fringe picture " + leaf(paths.patterns[0]),
               width, height, camera.width_px, camera.height_px);
  if (!paths.picture.empty()) {
    Image picture = read_picture(paths.picture, place(paths.picture));
    check_size("its picture " + leaf(paths.picture), picture.width, picture.height, width, height);
    scan.picture = std::move(picture);
  }
  check(!scan.picture.pixels.empty(), "it has no picture");
  if (!paths.mask.empty()) {
    const DepthImage mask = read_mask(paths.mask, place(paths.mask));
    check_size("its mask " + leaf(paths.mask), mask.width, mask.height, width, height);
    bool any = false;
    for (std::size_t i = 0; i < mask.values.size(); ++i) {
      const bool on = mask.values[i] >= static_cast<float>(camera.mask_from);
      any = any || on;
      if (!on) scan.depth_mm[i] = 0;
    }
    check(any, "its mask is empty");
  }
  scan.camera = camera.camera;
  make_square(camera.aspect, static_cast<double>(camera.camera.centre_y_px), scan);
  std::vector<double> depths, places;
  for (std::size_t i = 0; i < scan.depth_mm.size(); ++i) {
    const auto depth = static_cast<double>(scan.depth_mm[i]);
    if (!(depth > 0)) continue;
    depths.push_back(depth);
    places.push_back(
        (static_cast<double>(i % static_cast<std::size_t>(width)) - static_cast<double>(scan.camera.centre_x_px)) *
        depth / static_cast<double>(scan.camera.focal_px));
  }
  check(!depths.empty(), "nothing is measured in it");
  frame.measured_px = static_cast<double>(depths.size());
  frame.median_depth_mm = median(std::move(depths));
  std::sort(places.begin(), places.end());
  const double last = static_cast<double>(places.size() - 1);
  frame.width_mm = places[static_cast<std::size_t>(0.95 * last)] - places[static_cast<std::size_t>(0.05 * last)];
  return frame;
}

}  // namespace face::decode
