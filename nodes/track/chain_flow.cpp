// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/chain_flow.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "nodes/base/check.h"
#include "nodes/base/find_landmark.h"

namespace face::track {
namespace {

struct Place {
  double x, y;  // of the video, px
};

// A flow in the pixels of the video.
class Motion {
 public:
  Motion(const FlowField& flow, bool half_size)
      : flow_(flow), scale_(half_size ? 2 : 1), offset_(half_size ? 0.5 : 0) {}

  // Where a point goes; nothing where the flow is not known.
  std::optional<Place> operator()(const Place& from) const {
    const double x = (from.x - offset_) / scale_, y = (from.y - offset_) / scale_;
    // Half a pixel beyond the last centre is still within the last pixel.
    if (!(x >= -0.5 && y >= -0.5 && x <= flow_.width - 0.5 && y <= flow_.height - 0.5)) return std::nullopt;
    const double cx = std::clamp(x, 0.0, flow_.width - 1.0), cy = std::clamp(y, 0.0, flow_.height - 1.0);
    const int left = static_cast<int>(cx), top = static_cast<int>(cy);
    const int right = std::min(left + 1, flow_.width - 1), bottom = std::min(top + 1, flow_.height - 1);
    const double a = cx - left, b = cy - top;
    double sum[2] = {0, 0}, weight = 0;
    const auto add = [&](int column, int row, double share) {
      const auto i =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(flow_.width) + static_cast<std::size_t>(column);
      if (!flow_.valid[i] || share == 0) return;
      weight += share;
      for (std::size_t axis = 0; axis < 2; ++axis)
        sum[axis] += share * static_cast<double>(flow_.displacement_px[i][axis]);
    };
    add(left, top, (1 - a) * (1 - b));
    add(right, top, a * (1 - b));
    add(left, bottom, (1 - a) * b);
    add(right, bottom, a * b);
    if (!(weight > 0)) return std::nullopt;
    return Place{from.x + scale_ * sum[0] / weight, from.y + scale_ * sum[1] / weight};
  }

  // The point that goes to `to`, by fixed-point steps; nothing where they do not come near.
  std::optional<Place> source(const Place& to) const {
    Place from = to;
    for (int step = 0; step < 50; ++step) {
      const std::optional<Place> reached = (*this)(from);
      if (!reached) return std::nullopt;
      const double miss_x = to.x - reached->x, miss_y = to.y - reached->y;
      if (std::hypot(miss_x, miss_y) < 1e-3) return from;
      from.x += 0.7 * miss_x, from.y += 0.7 * miss_y;
    }
    return std::nullopt;
  }

 private:
  const FlowField& flow_;
  double scale_, offset_;
};

void check_flow(const FlowField& flow, const std::string& name) {
  const auto count = static_cast<std::size_t>(flow.width) * static_cast<std::size_t>(flow.height);
  check(flow.width > 0 && flow.height > 0 && flow.displacement_px.size() == count && flow.valid.size() == count, name,
        " has ", flow.displacement_px.size(), " displacements, expected ", flow.width, " x ", flow.height);
}

Landmarks followed(const Landmarks& start, const std::vector<std::string>& names) {
  if (names.empty()) return start;
  Landmarks chosen;
  for (const std::string& name : names) {
    const Landmark* point = find_landmark(start, name);
    check(point != nullptr, "names has the point ", name, ", which start does not have; it has ",
          landmark_names(start));
    chosen.points.push_back(*point);
  }
  return chosen;
}

// From a point's place to where it is followed; as many as `points`.
std::vector<Place> leans(const Landmarks& points, const Landmarks& start, double lean_px) {
  // A point, and one from which (to which, where `towards`) it leans.
  struct Lean {
    const char *name, *other;
    bool towards;
  };
  constexpr Lean all[] = {{"60", "48", true},  {"61", "50", true},  {"62", "51", true},  {"63", "52", true},
                          {"64", "54", true},  {"65", "56", true},  {"66", "57", true},  {"67", "58", true},
                          {"37", "41", false}, {"38", "40", false}, {"40", "38", false}, {"41", "37", false},
                          {"43", "47", false}, {"44", "46", false}, {"46", "44", false}, {"47", "43", false}};
  std::vector<Place> made;
  for (const Landmark& point : points.points) {
    made.push_back({0, 0});
    for (const Lean& lean : all) {
      if (point.name != lean.name) continue;
      const auto other = std::find_if(start.points.begin(), start.points.end(),
                                      [&](const Landmark& p) { return p.name == lean.other; });
      if (other == start.points.end()) continue;
      const double x = other->x_px - point.x_px, y = other->y_px - point.y_px, length = std::hypot(x, y);
      if (!(length > 0)) continue;
      // Towards another point no more than half the way.
      const double by = lean.towards ? std::min(lean_px, length / 2) / length : -lean_px / length;
      made.back() = {by * x, by * y};
    }
  }
  return made;
}

void put_right(const Landmarks& correction, const Motion* first, const std::vector<Place>& lean,
               ChainFlowResult& result) {
  for (const Landmark& fixed : correction.points) {
    const std::size_t index = landmark_index(result.landmarks, fixed.name);
    check(index < result.landmarks.points.size(), "a correction names the point ", fixed.name,
          ", which is not followed; these are ", landmark_names(result.landmarks));
    check(std::isfinite(fixed.x_px) && std::isfinite(fixed.y_px), "the correction of ", fixed.name, " is at (",
          fixed.x_px, ", ", fixed.y_px, "), expected finite numbers");
    result.landmarks.points[index] = {fixed.name, fixed.x_px, fixed.y_px, true};
    Landmark& home = result.home.points[index];
    const Place& by = lean[index];
    const std::optional<Place> from = first ? first->source({fixed.x_px + by.x, fixed.y_px + by.y}) : std::nullopt;
    home = from ? Landmark{fixed.name, from->x - by.x, from->y - by.y, true}
                : Landmark{fixed.name, fixed.x_px, fixed.y_px, false};
  }
}

}  // namespace

ChainFlowResult chain_flow(const FlowField& flow, const FlowField* from_first, const Landmarks& start,
                           const Landmarks* correction, const engine::Prior<ChainFlowResult>& prior,
                           const ChainFlowOptions& options) {
  check_flow(flow, "flow");
  const Motion step(flow, options.half_size);
  std::optional<Motion> first;
  if (from_first) {
    check_flow(*from_first, "from_first");
    check(from_first->width == flow.width && from_first->height == flow.height, "from_first is ", from_first->width,
          " x ", from_first->height, " pixels, flow is ", flow.width, " x ", flow.height);
    first.emplace(*from_first, options.half_size);
  }
  ChainFlowResult result;
  const Landmarks beginning = followed(start, options.names);
  const std::vector<Place> lean = leans(beginning, start, options.lean_px);
  if (!prior) {
    result.landmarks = result.home = beginning;
  } else {
    check(prior->landmarks.points.size() == lean.size() && prior->home.points.size() == lean.size(),
          "the previous result has ", prior->landmarks.points.size(), " points, expected ", lean.size());
    result.landmarks = prior->landmarks;
    result.home = prior->home;
    for (std::size_t i = 0; i < result.landmarks.points.size(); ++i) {
      Landmark& point = result.landmarks.points[i];
      const Landmark& home = result.home.points[i];
      const Place& by = lean[i];
      std::optional<Place> chained, direct;
      if (point.valid) chained = step({point.x_px + by.x, point.y_px + by.y});
      if (first && home.valid) direct = (*first)({home.x_px + by.x, home.y_px + by.y});
      if (!chained && !direct) {
        point.valid = false;
        continue;
      }
      Place place = chained ? *chained : *direct;
      if (chained && direct) {
        const double apart_px = std::hypot(direct->x - chained->x, direct->y - chained->y);
        if (apart_px <= options.max_pull_px) {
          place.x += options.pull * (direct->x - chained->x);
          place.y += options.pull * (direct->y - chained->y);
          result.pulled_px = std::max(result.pulled_px, apart_px);
        }
      }
      point = {point.name, place.x - by.x, place.y - by.y, true};
    }
  }
  if (correction) put_right(*correction, first ? &*first : nullptr, lean, result);
  return result;
}

}  // namespace face::track
