// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/track_markers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nodes/base/check.h"

namespace face::align {
namespace {

constexpr double same_dot_px = 3;  // nearer than two painted dots are

// The picture in grey, with one access rule: outside, the nearest pixel's.
struct Grey {
  int width, height;
  std::vector<std::uint8_t> values;
  int at(int x, int y) const {
    x = std::clamp(x, 0, width - 1);
    y = std::clamp(y, 0, height - 1);
    return values[static_cast<std::size_t>(y * width + x)];
  }
  double at(double x, double y) const {
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const double fx = x - x0, fy = y - y0;
    return (at(x0, y0) * (1 - fx) + at(x0 + 1, y0) * fx) * (1 - fy) +
           (at(x0, y0 + 1) * (1 - fx) + at(x0 + 1, y0 + 1) * fx) * fy;
  }
};

Grey grey_of(const Image& picture) {
  const std::size_t count = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  const auto channels = static_cast<std::size_t>(picture.channels);
  check(picture.pixels.size() == count * channels, "scan's picture has ", picture.pixels.size(), " bytes, expected ",
        picture.width, " x ", picture.height, " x ", picture.channels);
  Grey grey{picture.width, picture.height, {}};
  if (channels == 1) {
    grey.values = picture.pixels;
    return grey;
  }
  grey.values.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* p = picture.pixels.data() + i * channels;
    grey.values[i] =
        channels < 3 ? p[0] : static_cast<std::uint8_t>(std::lround(0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2]));
  }
  return grey;
}

bool fits(const Grey& grey, double x, double y, int side) {
  const double half = 0.5 * side;
  return x >= half - 1 && y >= half - 1 && x <= grey.width - half && y <= grey.height - half;
}

// Top left pixel of a square about a point, and what is left over.
int corner_of(double centre, int side) { return static_cast<int>(std::lround(centre - 0.5 * (side - 1))); }

void take_template(const Grey& grey, const Landmark& point, int side, std::size_t index, Image& templates) {
  const int left = corner_of(point.x_px, side), top = corner_of(point.y_px, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      templates.pixels[static_cast<std::size_t>(y * templates.width) + index * static_cast<std::size_t>(side) +
                       static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(grey.at(left + x, top + y));
}

struct Match {
  double x = 0, y = 0;  // top left of the square
  double likeness = -1;
};

struct Place {
  double x = 0, y = 0;
};

bool is_near(const Place& a, const Place& b, double reach_px) {
  return std::fabs(a.x - b.x) < reach_px && std::fabs(a.y - b.y) < reach_px;
}

class Template {
 public:
  Template(const Image& templates, std::size_t index, int side) : side_(side) {
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        values_.push_back(templates.pixels[static_cast<std::size_t>(y * templates.width) +
                                           index * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)]);
  }

  // Whole pixel of the least sum of squared differences, corners from low to high on both axes about (left, top).
  // Left out are corners within half a side of one in `taken`.
  Match search(const Grey& grey, int left, int top, int reach, const std::vector<Place>& taken = {}) const {
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    Match match{static_cast<double>(left), static_cast<double>(top), -1};
    // The neighbourhood once, so that the sums run over contiguous memory.
    const int stride = side_ + 2 * reach;
    std::vector<std::int16_t> about(static_cast<std::size_t>(stride * stride));
    for (int y = 0; y < stride; ++y)
      for (int x = 0; x < stride; ++x)
        about[static_cast<std::size_t>(y * stride + x)] =
            static_cast<std::int16_t>(grey.at(left - reach + x, top - reach + y));
    for (int dy = 0; dy <= 2 * reach; ++dy)
      for (int dx = 0; dx <= 2 * reach; ++dx) {
        std::int32_t sum = 0;
        for (int y = 0; y < side_; ++y) {
          const std::int16_t* row = about.data() + static_cast<std::size_t>((dy + y) * stride + dx);
          const std::int16_t* own = values_.data() + static_cast<std::size_t>(y * side_);
          for (int x = 0; x < side_; ++x) {
            const std::int32_t d = row[x] - own[x];
            sum += d * d;
          }
        }
        if (sum >= least) continue;
        const Place corner{static_cast<double>(left - reach + dx), static_cast<double>(top - reach + dy)};
        if (std::any_of(taken.begin(), taken.end(),
                        [&](const Place& other) { return is_near(corner, other, 0.5 * side_); }))
          continue;
        least = sum;
        match.x = corner.x;
        match.y = corner.y;
      }
    return match;
  }

  // Between pixels: Gauss-Newton on shift, gain and offset eliminated by normalising both squares.
  void refine(const Grey& grey, Match& match) const {
    const std::size_t count = values_.size();
    const double start_x = match.x, start_y = match.y;
    double own_mean = 0, own_square = 0;
    for (const std::int16_t v : values_) own_mean += v;
    own_mean /= static_cast<double>(count);
    for (const std::int16_t v : values_) own_square += (v - own_mean) * (v - own_mean);
    const int w = side_ + 2;
    std::vector<double> seen(static_cast<std::size_t>(w * w));
    for (int step = 0; step < 8; ++step) {
      for (int y = 0; y < w; ++y)
        for (int x = 0; x < w; ++x)
          seen[static_cast<std::size_t>(y * w + x)] = grey.at(match.x + x - 1, match.y + y - 1);
      const auto at = [&](int x, int y) { return seen[static_cast<std::size_t>((y + 1) * w + x + 1)]; };
      double mean = 0, product = 0, square = 0;
      for (int y = 0; y < side_; ++y)
        for (int x = 0; x < side_; ++x) mean += at(x, y);
      mean /= static_cast<double>(count);
      for (int y = 0; y < side_; ++y)
        for (int x = 0; x < side_; ++x) {
          const double s = at(x, y) - mean, o = values_[static_cast<std::size_t>(y * side_ + x)] - own_mean;
          product += s * o;
          square += s * s;
        }
      if (own_square <= 0 || square <= 0) return;
      match.likeness = product / std::sqrt(own_square * square);
      const double gain = product / own_square;
      double xx = 0, xy = 0, yy = 0, bx = 0, by = 0;
      for (int y = 0; y < side_; ++y)
        for (int x = 0; x < side_; ++x) {
          const double gx = 0.5 * (at(x + 1, y) - at(x - 1, y)), gy = 0.5 * (at(x, y + 1) - at(x, y - 1));
          const double d = at(x, y) - mean - gain * (values_[static_cast<std::size_t>(y * side_ + x)] - own_mean);
          xx += gx * gx, xy += gx * gy, yy += gy * gy, bx += gx * d, by += gy * d;
        }
      const double det = xx * yy - xy * xy;
      if (det <= 1e-9 * (xx + yy) * (xx + yy)) return;
      const double dx = -(yy * bx - xy * by) / det, dy = -(xx * by - xy * bx) / det;
      if (std::hypot(match.x + dx - start_x, match.y + dy - start_y) > 1.5) return;  // no nearer minimum
      match.x += dx;
      match.y += dy;
      if (std::hypot(dx, dy) < 0.003) return;
    }
  }

 private:
  int side_;
  std::vector<std::int16_t> values_;
};

}  // namespace

TrackMarkersResult track_markers(const DepthScan& scan, const Landmarks& start, const Landmarks* correction,
                                 const engine::Prior<TrackMarkersResult>& before, const TrackMarkersOptions& options,
                                 engine::Progress& progress) {
  const Grey grey = grey_of(scan.picture);
  const int side = static_cast<int>(options.template_px);
  TrackMarkersResult result;
  result.moved_px = {start.points.size(), 2, std::vector<double>(2 * start.points.size(), 0.0)};
  if (!before) {
    result.markers = start;
    result.templates = {std::max(side * static_cast<int>(start.points.size()), 1), side, 1, {}};
    result.templates.pixels.assign(static_cast<std::size_t>(result.templates.width) * static_cast<std::size_t>(side),
                                   0);
    for (std::size_t i = 0; i < start.points.size(); ++i) {
      const Landmark& point = start.points[i];
      check(fits(grey, point.x_px, point.y_px, 1), "start marker ", point.name, " is at (", point.x_px, ", ",
            point.y_px, "), outside the scan of ", grey.width, " x ", grey.height, " pixels");
      take_template(grey, point, side, i, result.templates);
    }
  } else {
    check(before->markers.points.size() == start.points.size(), "the frame before has ", before->markers.points.size(),
          " markers, start has ", start.points.size());
    result.templates = before->templates;
    result.markers = before->markers;
    const std::size_t count = start.points.size();
    std::vector<Match> matches(count);
    // The point keeps its place in the square that was taken about it.
    const auto place_of = [&](std::size_t i) {
      const Landmark& point = start.points[i];
      return Place{matches[i].x + point.x_px - corner_of(point.x_px, side),
                   matches[i].y + point.y_px - corner_of(point.y_px, side)};
    };
    const auto look = [&](std::size_t i, int neighbourhoods, const std::vector<Place>& taken) {
      const Landmark &from = start.points[i], &last = before->markers.points[i];
      std::vector<Place> corners;
      for (const Place& at : taken)
        corners.push_back(
            {at.x - from.x_px + corner_of(from.x_px, side), at.y - from.y_px + corner_of(from.y_px, side)});
      const Template square(result.templates, i, side);
      matches[i] = square.search(grey, corner_of(last.x_px + before->moved_px.at(i, 0), side),
                                 corner_of(last.y_px + before->moved_px.at(i, 1), side),
                                 static_cast<int>(options.search_px / 2) * neighbourhoods, corners);
      square.refine(grey, matches[i]);
    };
    // First those that were followed until here. Of two on one dot the more alike has it.
    std::vector<bool> again(count);
    for (std::size_t i = 0; i < count; ++i) {
      again[i] = !before->markers.points[i].valid;
      if (!again[i]) look(i, 1, {});
    }
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (!again[i] && !again[k] && is_near(place_of(i), place_of(k), same_dot_px))
          again[matches[i].likeness > matches[k].likeness ? k : i] = true;
    std::vector<Place> taken;
    for (std::size_t i = 0; i < count; ++i)
      if (!again[i] && matches[i].likeness >= options.least_likeness) taken.push_back(place_of(i));
    for (std::size_t i = 0; i < count; ++i) {
      Landmark& point = result.markers.points[i];
      if (again[i]) look(i, 2, taken);
      const Place at = place_of(i);
      const bool inside = fits(grey, at.x, at.y, side);
      if (point.valid && !inside)
        progress.warn(message("marker ", point.name, " leaves the picture of ", grey.width, " x ", grey.height,
                              " pixels at (", std::lround(at.x), ", ", std::lround(at.y), ")"));
      point.valid = matches[i].likeness >= options.least_likeness && inside;
      if (!point.valid) continue;
      if (before->markers.points[i].valid) {
        result.moved_px.at(i, 0) = at.x - point.x_px;
        result.moved_px.at(i, 1) = at.y - point.y_px;
      }
      point.x_px = at.x;
      point.y_px = at.y;
      if (again[i]) taken.push_back(at);
    }
  }
  if (correction)
    for (const Landmark& right : correction->points) {
      std::size_t i = 0;
      while (i < start.points.size() && start.points[i].name != right.name) ++i;
      check(i < start.points.size(), "a correction names the marker ", right.name, ", which start does not have");
      check(fits(grey, right.x_px, right.y_px, 1), "the correction of ", right.name, " is at (", right.x_px, ", ",
            right.y_px, "), outside the scan of ", grey.width, " x ", grey.height, " pixels");
      // The square is moved by whole pixels, so that the point keeps its place in it.
      Landmark whole = start.points[i];
      whole.x_px += std::round(right.x_px - whole.x_px);
      whole.y_px += std::round(right.y_px - whole.y_px);
      take_template(grey, whole, side, i, result.templates);
      result.markers.points[i] = {right.name, right.x_px, right.y_px, true};
      result.moved_px.at(i, 0) = result.moved_px.at(i, 1) = 0;
    }
  for (const Landmark& point : result.markers.points)
    if (!point.valid) result.report += (result.report.empty() ? "" : " ") + point.name;
  return result;
}

}  // namespace face::align
