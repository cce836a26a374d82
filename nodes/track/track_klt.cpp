// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/track_klt.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "nodes/base/check.h"
#include "nodes/track/patch.h"

namespace face::track {
namespace {

cv::Mat eight_bit(const Grey& grey) {
  cv::Mat out(grey.height, grey.width, CV_8U);
  for (int y = 0; y < grey.height; ++y)
    for (int x = 0; x < grey.width; ++x)
      out.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>(std::lround(grey.values[static_cast<std::size_t>(y * grey.width + x)]));
  return out;
}

cv::Point2f at(const Landmark& point) { return {static_cast<float>(point.x_px), static_cast<float>(point.y_px)}; }

bool inside(double x, double y, int width, int height) {
  return x >= -0.5 && y >= -0.5 && x <= width - 0.5 && y <= height - 0.5;
}

std::vector<float> patch_of(const Image& patches, std::size_t index, int side_px) {
  std::vector<float> patch;
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x)
      patch.push_back(patches.pixels[static_cast<std::size_t>(y * patches.width + static_cast<int>(index) * side_px + x)]);
  return patch;
}

void keep_patch(const Grey& grey, const Landmark& point, std::size_t index, int side_px, Image& patches) {
  const std::vector<float> patch = cut_patch(grey, point.x_px, point.y_px, side_px);
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x)
      patches.pixels[static_cast<std::size_t>(y * patches.width + static_cast<int>(index) * side_px + x)] =
          static_cast<std::uint8_t>(std::lround(patch[static_cast<std::size_t>(y * side_px + x)]));
}

void check_inputs(const engine::Window<Image>& frames, const Landmarks& start, const engine::Prior<TrackKltResult>& prior,
                  int side_px) {
  const Image& frame = frames.centre();
  check(side_px % 2 == 1, "window_px is ", side_px, ", expected an odd number");
  for (const Landmark& point : start.points)
    if (!inside(point.x_px, point.y_px, frame.width, frame.height))
      fail("start point ", point.name, " is at (", point.x_px, ", ", point.y_px, "), outside the frame of ", frame.width, " x ",
           frame.height, " pixels");
  if (!prior) return;
  check(frames.centre_index() > 0, "frames has no previous frame although there is a previous result");
  const Image& previous = frames[frames.centre_index() - 1];
  check(previous.width == frame.width && previous.height == frame.height, "the frame is ", frame.width, " x ", frame.height,
        " pixels, the previous one ", previous.width, " x ", previous.height);
  check(prior->landmarks.points.size() == start.points.size(), "the previous result has ", prior->landmarks.points.size(),
        " points, start has ", start.points.size());
}

// The similarity that carries the start points to where the valid ones are now (least squares; Umeyama, PAMI 1991, in two
// dimensions as complex numbers), applied to a point. Falls back to the translation with fewer than two points.
struct Layout {
  double scale_re = 1, scale_im = 0;
  double start_x = 0, start_y = 0, now_x = 0, now_y = 0;

  Layout(const Landmarks& start, const Landmarks& now) {
    double count = 0;
    for (std::size_t i = 0; i < now.points.size(); ++i) {
      if (!now.points[i].valid) continue;
      start_x += start.points[i].x_px, start_y += start.points[i].y_px;
      now_x += now.points[i].x_px, now_y += now.points[i].y_px;
      ++count;
    }
    if (count == 0) return;
    start_x /= count, start_y /= count, now_x /= count, now_y /= count;
    double re = 0, im = 0, square = 0;
    for (std::size_t i = 0; i < now.points.size(); ++i) {
      if (!now.points[i].valid) continue;
      const double ax = start.points[i].x_px - start_x, ay = start.points[i].y_px - start_y;
      const double bx = now.points[i].x_px - now_x, by = now.points[i].y_px - now_y;
      re += ax * bx + ay * by;
      im += ax * by - ay * bx;
      square += ax * ax + ay * ay;
    }
    if (count > 1 && square > 0) scale_re = re / square, scale_im = im / square;
  }
  cv::Point2d place(const Landmark& point) const {
    const double ax = point.x_px - start_x, ay = point.y_px - start_y;
    return {now_x + scale_re * ax - scale_im * ay, now_y + scale_im * ax + scale_re * ay};
  }
};

// Takes the valid points of the previous frame to this one; those that do not come home are lost.
void follow(const Grey& previous, const Grey& current, const TrackKltOptions& options, TrackKltResult& result) {
  std::vector<std::size_t> index;
  std::vector<cv::Point2f> from;
  for (std::size_t i = 0; i < result.landmarks.points.size(); ++i) {
    if (!result.landmarks.points[i].valid) continue;
    index.push_back(i);
    from.push_back(at(result.landmarks.points[i]));
  }
  if (from.empty()) return;
  const cv::Size window(static_cast<int>(options.window_px), static_cast<int>(options.window_px));
  const int levels = static_cast<int>(options.levels);
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 0.001);
  const cv::Mat a = eight_bit(previous), b = eight_bit(current);
  std::vector<cv::Point2f> to, home = from;
  std::vector<std::uint8_t> found, found_home;
  std::vector<float> error;
  cv::calcOpticalFlowPyrLK(a, b, from, to, found, error, window, levels, until);
  cv::calcOpticalFlowPyrLK(b, a, to, home, found_home, error, window, levels, until);
  for (std::size_t k = 0; k < index.size(); ++k) {
    Landmark& point = result.landmarks.points[index[k]];
    const double return_error = cv::norm(home[k] - from[k]);
    const bool kept = found[k] && found_home[k] && return_error <= options.max_return_error_px &&
                      inside(static_cast<double>(to[k].x), static_cast<double>(to[k].y), current.width, current.height);
    point.valid = kept;
    if (!kept) continue;
    point.x_px = static_cast<double>(to[k].x);
    point.y_px = static_cast<double>(to[k].y);
    result.return_error_px = std::max(result.return_error_px, return_error);
  }
}

// Sets points onto their own patches where these are seen again, and looks for lost ones.
void anchor(const Grey& current, const Landmarks& start, const TrackKltOptions& options, TrackKltResult& result) {
  const int side = static_cast<int>(options.window_px);
  const Layout layout(start, result.landmarks);
  for (std::size_t i = 0; i < result.landmarks.points.size(); ++i) {
    Landmark& point = result.landmarks.points[i];
    const std::vector<float> patch = patch_of(result.patches, i, side);
    if (point.valid) {
      const PatchMatch match = align_patch(patch, side, current, point.x_px, point.y_px);
      const double moved = std::hypot(match.x_px - point.x_px, match.y_px - point.y_px);
      if (!match.converged || moved > 1) continue;
      // Fades in, so that a patch that comes and goes does not make the point jump.
      const double share = std::clamp((match.likeness - options.min_likeness) / (1 - options.min_likeness) * 2, 0.0, 1.0);
      point.x_px += share * (match.x_px - point.x_px);
      point.y_px += share * (match.y_px - point.y_px);
    } else {
      const cv::Point2d expected = layout.place(start.points[i]);
      const PatchMatch match = search_patch(patch, side, current, expected.x, expected.y, options.search_px);
      if (match.likeness < options.min_likeness || !match.converged) continue;
      if (!inside(match.x_px, match.y_px, current.width, current.height)) continue;
      point = {point.name, match.x_px, match.y_px, true};
    }
  }
}

void correct(const Landmarks& correction, const Grey& current, int side_px, TrackKltResult& result) {
  for (const Landmark& fixed : correction.points) {
    auto& points = result.landmarks.points;
    const auto point = std::find_if(points.begin(), points.end(), [&](const Landmark& p) { return p.name == fixed.name; });
    if (point == points.end()) fail("a correction names the point ", fixed.name, ", which start does not have");
    if (!inside(fixed.x_px, fixed.y_px, current.width, current.height))
      fail("the correction of ", fixed.name, " is at (", fixed.x_px, ", ", fixed.y_px, "), outside the frame of ", current.width,
           " x ", current.height, " pixels");
    *point = {fixed.name, fixed.x_px, fixed.y_px, true};
    keep_patch(current, *point, static_cast<std::size_t>(point - points.begin()), side_px, result.patches);
  }
}

}  // namespace

TrackKltResult track_klt(const engine::Window<Image>& frames, const Landmarks& start, const Landmarks* correction,
                         const engine::Prior<TrackKltResult>& prior, const TrackKltOptions& options) {
  const int side = static_cast<int>(options.window_px);
  check_inputs(frames, start, prior, side);
  const Grey current = grey_of(frames.centre());
  TrackKltResult result;
  if (prior) {
    result = *prior;
    result.return_error_px = 0;
    follow(grey_of(frames[frames.centre_index() - 1]), current, options, result);
    anchor(current, start, options, result);
  } else {
    result.landmarks = start;
    result.patches = {side * static_cast<int>(start.points.size()), side, 1, {}};
    result.patches.pixels.assign(static_cast<std::size_t>(result.patches.width * side), 0);
    for (std::size_t i = 0; i < start.points.size(); ++i) keep_patch(current, start.points[i], i, side, result.patches);
  }
  if (correction) correct(*correction, current, side, result);
  result.lost = static_cast<double>(std::count_if(result.landmarks.points.begin(), result.landmarks.points.end(),
                                                  [](const Landmark& p) { return !p.valid; }));
  return result;
}

}  // namespace face::track
