// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <complex>

#include "nodes/base/find_landmark.h"
#include "nodes/track/head_raster.h"
#include "nodes/track/jaw_line.h"
#include "nodes/track/mouth_shape.h"
#include "nodes/track/steps.h"

namespace face::track {
namespace {

std::size_t patch_offset(const Image& patches, std::size_t index, int row, int side_px, int y) {
  return static_cast<std::size_t>((row * side_px + y) * patches.width + static_cast<int>(index) * side_px);
}

double eye_distance_px(const Landmarks& start) {
  const Landmark *right = find_landmark(start, "eye_inner_r"), *left = find_landmark(start, "eye_inner_l");
  return right && left ? distance_px(*right, *left) : 0;
}

}  // namespace

Image empty_patches(std::size_t count, int side_px) {
  Image patches{side_px * static_cast<int>(count), 2 * side_px, 1, {}};
  patches.pixels.assign(static_cast<std::size_t>(patches.width) * static_cast<std::size_t>(patches.height), 0);
  return patches;
}

std::vector<float> patch_of(const Image& patches, std::size_t index, int row, int side_px) {
  std::vector<float> patch;
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x)
      patch.push_back(patches.pixels[patch_offset(patches, index, row, side_px, y) + static_cast<std::size_t>(x)]);
  return patch;
}

int side_of(const Image& patches, std::size_t index, int row, int side_px) {
  constexpr int least_px = 9;
  return telling_side_px(patch_of(patches, index, row, side_px), side_px, least_px);
}

void keep_patch(const Grey& grey, double x_px, double y_px, std::size_t index, int row, int side_px, Image& patches) {
  const std::vector<float> patch = cut_patch(grey, x_px, y_px, side_px);
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x)
      patches.pixels[patch_offset(patches, index, row, side_px, y) + static_cast<std::size_t>(x)] =
          static_cast<std::uint8_t>(std::lround(patch[static_cast<std::size_t>(y * side_px + x)]));
}

std::vector<float> own_patch(const Knowledge& known, const Image& patches, std::size_t index) {
  return middle_of(patch_of(patches, index, 0, known.side_px), known.side_px, known.sides_px[index]);
}

Knowledge::Knowledge(const Landmarks& start_points, const TrackKltOptions& given)
    : start(start_points),
      options(given),
      side_px(static_cast<int>(given.window_px)),
      sides_px(start_points.points.size(), side_px),
      outline(find_outline(start_points, given.outline)) {
  bonds.stiffness = options.stiffness;
  if (!outline.empty()) {
    jaw_line = find_jaw_line(start, options.jaw_line);
    mouth_px = mouth_width_px(start, outline);
  }
  bonds.modes = mouth_modes(start, outline, jaw_line);
  for (std::size_t i = 0; i < start.points.size(); ++i)
    if (std::find(options.rigid.begin(), options.rigid.end(), start.points[i].name) != options.rigid.end())
      bonds.rigid.push_back(i);
  eyes_px = eye_distance_px(start);
  bonds.depths_px = usual_depths_px(start);
}

void Knowledge::learn_sides(const Image& patches) {
  for (std::size_t i = 0; i < sides_px.size(); ++i) sides_px[i] = side_of(patches, i, 0, side_px);
}

bool Knowledge::is_dot(std::size_t point) const {
  const auto marks = std::count_if(outline.begin(), outline.end(), [&](std::size_t i) { return is_mark(i); });
  return is_mark(point) && 2 * marks >= static_cast<std::ptrdiff_t>(outline.size());
}

std::complex<double> Knowledge::on_head(const SolidHead& head, std::size_t point) const {
  return head.seen({start.points[point].x_px, start.points[point].y_px}, bonds.depths_px[point]);
}

std::vector<Sighting> go_along(const Knowledge& known, const SolidHead& before, const SolidHead& now,
                               std::vector<Sighting> places) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::complex<double> move = known.on_head(now, i) - known.on_head(before, i);
    places[i].x_px += move.real(), places[i].y_px += move.imag();
  }
  return places;
}

double seen_again_from(const TrackKltOptions& options, bool is_dot) {
  constexpr double of_dots = 0.5;
  return is_dot ? std::min(of_dots, options.min_likeness) : options.min_likeness;
}

double anchor_share(const TrackKltOptions& options, bool is_dot, double likeness) {
  const double least = seen_again_from(options, is_dot);
  return std::clamp((likeness - least) / (1 - least) * 2, 0.0, 1.0);
}

}  // namespace face::track
