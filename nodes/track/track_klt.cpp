// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/track_klt.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "nodes/base/check.h"
#include "nodes/track/patch.h"
#include "nodes/track/settle.h"

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

bool inside(double x, double y, int width, int height) {
  return x >= -0.5 && y >= -0.5 && x <= width - 0.5 && y <= height - 0.5;
}

std::vector<float> patch_of(const Image& patches, std::size_t index, int side_px) {
  std::vector<float> patch;
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x)
      patch.push_back(
          patches.pixels[static_cast<std::size_t>(y * patches.width + static_cast<int>(index) * side_px + x)]);
  return patch;
}

void keep_patch(const Grey& grey, const Landmark& point, std::size_t index, int side_px, Image& patches) {
  const std::vector<float> patch = cut_patch(grey, point.x_px, point.y_px, side_px);
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x)
      patches.pixels[static_cast<std::size_t>(y * patches.width + static_cast<int>(index) * side_px + x)] =
          static_cast<std::uint8_t>(std::lround(patch[static_cast<std::size_t>(y * side_px + x)]));
}

void check_inputs(const engine::Window<Image>& frames, const Landmarks& start,
                  const engine::Prior<TrackKltResult>& prior, int side_px) {
  const Image& frame = frames.centre();
  check(side_px % 2 == 1, "window_px is ", side_px, ", expected an odd number");
  for (const Landmark& point : start.points)
    if (!inside(point.x_px, point.y_px, frame.width, frame.height))
      fail("start point ", point.name, " is at (", point.x_px, ", ", point.y_px, "), outside the frame of ",
           frame.width, " x ", frame.height, " pixels");
  if (!prior) return;
  check(frames.centre_index() > 0, "frames has no previous frame although there is a previous result");
  const Image& previous = frames[frames.centre_index() - 1];
  check(previous.width == frame.width && previous.height == frame.height, "the frame is ", frame.width, " x ",
        frame.height, " pixels, the previous one ", previous.width, " x ", previous.height);
  check(prior->landmarks.points.size() == start.points.size(), "the previous result has ",
        prior->landmarks.points.size(), " points, start has ", start.points.size());
}

// How surely a place can be told by the picture around it: the mean outer product of its gradients over the variance of
// grey values between frames, as eigenvalues e + e^2. The square makes strong contrast all but decide over the springs,
// and leaves weak contrast to them.
void add_information(const Grey& grey, int side_px, Sighting& place) {
  constexpr double grey_noise = 5;  // 8-bit steps; compressed video
  const double half = (side_px - 1) / 2.0;
  double xx = 0, xy = 0, yy = 0;
  for (int v = 0; v < side_px; ++v)
    for (int u = 0; u < side_px; ++u) {
      const double x = place.x_px + u - half, y = place.y_px + v - half;
      const double gx = static_cast<double>(grey.at(x + 1, y) - grey.at(x - 1, y)) / 2;
      const double gy = static_cast<double>(grey.at(x, y + 1) - grey.at(x, y - 1)) / 2;
      xx += gx * gx;
      xy += gx * gy;
      yy += gy * gy;
    }
  const double scale = 1 / (side_px * side_px * grey_noise * grey_noise);
  xx *= scale, xy *= scale, yy *= scale;
  // M + M M has the eigenvectors of M.
  place.xx = xx + xx * xx + xy * xy;
  place.xy = xy + xy * (xx + yy);
  place.yy = yy + yy * yy + xy * xy;
}

void forget(Sighting& place) { place.xx = place.xy = place.yy = 0; }
bool is_seen(const Sighting& place) { return place.xx + place.yy > 0; }

// Pyramidal KLT of all points from their guesses. Points of which it makes nothing are forgotten.
std::vector<Sighting> flow(const cv::Mat& from, const cv::Mat& to, const std::vector<Sighting>& points,
                           const std::vector<Sighting>& guesses, const TrackKltOptions& options) {
  if (points.empty()) return {};
  std::vector<cv::Point2f> a, b;
  for (const Sighting& p : points) a.emplace_back(static_cast<float>(p.x_px), static_cast<float>(p.y_px));
  for (const Sighting& p : guesses) b.emplace_back(static_cast<float>(p.x_px), static_cast<float>(p.y_px));
  std::vector<std::uint8_t> found;
  std::vector<float> error;
  const cv::Size window(static_cast<int>(options.window_px), static_cast<int>(options.window_px));
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 0.001);
  cv::calcOpticalFlowPyrLK(from, to, a, b, found, error, window, static_cast<int>(options.levels), until,
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  std::vector<Sighting> out = points;
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].x_px = static_cast<double>(b[i].x);
    out[i].y_px = static_cast<double>(b[i].y);
    if (!found[i] || !inside(out[i].x_px, out[i].y_px, to.cols, to.rows)) forget(out[i]);
  }
  return out;
}

// Takes the valid points of the previous frame to this one. Lost and implausible points come back forgotten.
std::vector<Sighting> follow(const Grey& previous, const Grey& current, const Landmarks& layout,
                             const TrackKltOptions& options, TrackKltResult& result) {
  const auto& points = result.landmarks.points;
  std::vector<Sighting> from;
  for (const Landmark& point : points) {
    from.push_back({point.x_px, point.y_px});
    if (point.valid) add_information(previous, static_cast<int>(options.window_px), from.back());
  }
  const cv::Mat a = eight_bit(previous), b = eight_bit(current);
  std::vector<Sighting> to = flow(a, b, from, from, options);
  // Points that went elsewhere than their neighbours get another try from where these say that they are.
  constexpr int tries = 3;
  for (int i = 0; i < tries; ++i) {
    const std::vector<Sighting> guess = settle(layout, to, options.stiffness);
    const std::vector<Sighting> again = flow(a, b, from, guess, options);
    for (std::size_t k = 0; k < to.size(); ++k) {
      const double off = std::hypot(to[k].x_px - guess[k].x_px, to[k].y_px - guess[k].y_px);
      if (is_seen(from[k]) && (!is_seen(to[k]) || off > 1)) to[k] = again[k];
    }
  }
  const std::vector<Sighting> home = flow(b, a, to, to, options), settled = settle(layout, to, options.stiffness);
  for (std::size_t k = 0; k < to.size(); ++k) {
    if (!is_seen(to[k])) continue;
    const double dx = home[k].x_px - from[k].x_px, dy = home[k].y_px - from[k].y_px;
    const double return_error = sure_length_px(from[k], dx, dy);
    const double off = sure_length_px(from[k], to[k].x_px - settled[k].x_px, to[k].y_px - settled[k].y_px);
    const bool kept = is_seen(home[k]) && return_error <= options.max_return_error_px && off <= options.max_offset_px;
    if (kept)
      result.return_error_px = std::max(result.return_error_px, return_error);
    else
      forget(to[k]);
  }
  return to;
}

// Moves points onto their own patches where these are seen again. Fades in, so that a patch that comes and goes does
// not make the point jump. Rigid points of which the patch is not seen are forgotten.
void anchor(const Grey& current, const TrackKltResult& before, const TrackKltOptions& options,
            std::vector<Sighting>& sightings) {
  const int side = static_cast<int>(options.window_px);
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    Sighting& seen = sightings[i];
    if (!is_seen(seen)) continue;
    const PatchMatch match = align_patch(patch_of(before.patches, i, side), side, current, seen.x_px, seen.y_px);
    const bool near =
        match.converged && std::hypot(match.x_px - seen.x_px, match.y_px - seen.y_px) <= options.max_anchor_px;
    const auto& name = before.landmarks.points[i].name;
    const bool rigid = std::find(options.rigid.begin(), options.rigid.end(), name) != options.rigid.end();
    if (rigid && !(near && match.likeness >= options.min_likeness)) forget(seen);
    if (!near) continue;
    const double share = std::clamp((match.likeness - options.min_likeness) / (1 - options.min_likeness) * 2, 0.0, 1.0);
    seen.x_px += share * (match.x_px - seen.x_px);
    seen.y_px += share * (match.y_px - seen.y_px);
  }
}

// Looks for the lost points by their own patches, about where the others say that they are.
void recover(const Grey& current, const Landmarks& layout, const Image& patches, const TrackKltOptions& options,
             std::vector<Sighting>& sightings) {
  const int side = static_cast<int>(options.window_px);
  const std::vector<Sighting> expected = settle(layout, sightings, options.stiffness);
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (is_seen(sightings[i])) continue;
    const PatchMatch match =
        search_patch(patch_of(patches, i, side), side, current, expected[i].x_px, expected[i].y_px, options.search_px);
    const bool found = match.converged && match.likeness >= options.min_likeness &&
                       inside(match.x_px, match.y_px, current.width, current.height) &&
                       std::hypot(match.x_px - expected[i].x_px, match.y_px - expected[i].y_px) <= options.search_px;
    if (!found) continue;
    sightings[i].x_px = match.x_px;
    sightings[i].y_px = match.y_px;
    add_information(current, side, sightings[i]);
  }
}

void track(const Grey& previous, const Grey& current, const Landmarks& layout, const TrackKltOptions& options,
           TrackKltResult& result) {
  std::vector<Sighting> sightings = follow(previous, current, layout, options, result);
  anchor(current, result, options, sightings);
  recover(current, layout, result.patches, options, sightings);
  const std::vector<Sighting> settled = settle(layout, sightings, options.stiffness);
  for (std::size_t i = 0; i < settled.size(); ++i) {
    Landmark& point = result.landmarks.points[i];
    point.valid = is_seen(settled[i]) && inside(settled[i].x_px, settled[i].y_px, current.width, current.height);
    if (point.valid) point = {point.name, settled[i].x_px, settled[i].y_px, true};
  }
}

// Puts points where somebody says that they are. The layout learns by how much that differs from where the neighbours
// would have put the point, so that the springs do not pull it back afterwards.
void correct(const Landmarks& correction, const Grey& current, const TrackKltOptions& options, TrackKltResult& result) {
  const int side_px = static_cast<int>(options.window_px);
  std::vector<Sighting> others;
  for (const Landmark& p : result.landmarks.points)
    others.push_back(p.valid ? Sighting{p.x_px, p.y_px, 1, 0, 1} : Sighting{});
  for (const Landmark& fixed : correction.points)
    for (std::size_t i = 0; i < others.size(); ++i)
      if (result.landmarks.points[i].name == fixed.name) forget(others[i]);
  const std::vector<Sighting> expected = settle(result.layout, others, options.stiffness);
  for (const Landmark& fixed : correction.points) {
    auto& points = result.landmarks.points;
    const auto point =
        std::find_if(points.begin(), points.end(), [&](const Landmark& p) { return p.name == fixed.name; });
    if (point == points.end()) fail("a correction names the point ", fixed.name, ", which start does not have");
    if (!inside(fixed.x_px, fixed.y_px, current.width, current.height))
      fail("the correction of ", fixed.name, " is at (", fixed.x_px, ", ", fixed.y_px, "), outside the frame of ",
           current.width, " x ", current.height, " pixels");
    *point = {fixed.name, fixed.x_px, fixed.y_px, true};
    const auto index = static_cast<std::size_t>(point - points.begin());
    keep_patch(current, *point, index, side_px, result.patches);
    result.layout.points[index].x_px += fixed.x_px - expected[index].x_px;
    result.layout.points[index].y_px += fixed.y_px - expected[index].y_px;
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
    track(grey_of(frames[frames.centre_index() - 1]), current, prior->layout, options, result);
  } else {
    result.landmarks = result.layout = start;
    result.patches = {side * static_cast<int>(start.points.size()), side, 1, {}};
    result.patches.pixels.assign(static_cast<std::size_t>(result.patches.width * side), 0);
    for (std::size_t i = 0; i < start.points.size(); ++i) keep_patch(current, start.points[i], i, side, result.patches);
  }
  if (correction) correct(*correction, current, options, result);
  result.lost = static_cast<double>(std::count_if(result.landmarks.points.begin(), result.landmarks.points.end(),
                                                  [](const Landmark& p) { return !p.valid; }));
  return result;
}

}  // namespace face::track
