// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/track_markers.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "nodes/align/marker_square.h"
#include "nodes/base/check.h"

namespace face::align {
namespace {

constexpr double same_dot_px = 3;  // nearer than two painted dots are
// Likeness from which a marker tells where those about it are: what is followed well has 0.9 and more.
constexpr double sure_likeness = 0.8;
// A marker that is farther from where those about it say, in shares of the search's reach, is looked for again.
constexpr double odd_share = 0.6;
// What the far end of the search costs in likeness: dots are alike within 0.1, so that of two the nearer is taken.
constexpr double first_cost = 0.15, second_cost = 0.3;
constexpr double forecast_stands_px = 0.5;  // a forecast that changes by less needs no other search

bool fits(const GreyPicture& grey, double x, double y, int side) {
  const double half = 0.5 * side;
  return x >= half - 1 && y >= half - 1 && x <= grey.width - half && y <= grey.height - half;
}

// Top left pixel of a square about a point, and what is left over.
int corner_of(double centre, int side) { return static_cast<int>(std::lround(centre - 0.5 * (side - 1))); }

void take_template(const GreyPicture& grey, const Landmark& point, int side, std::size_t index, Image& templates) {
  const int left = corner_of(point.x_px, side), top = corner_of(point.y_px, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      templates.pixels[static_cast<std::size_t>(y * templates.width) + index * static_cast<std::size_t>(side) +
                       static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(grey.at(left + x, top + y));
}

double distance(const Place& a, const Place& b) { return std::hypot(a.x - b.x, a.y - b.y); }

// Finds all markers of a frame from those of the frame before.
class Constellation {
 public:
  Constellation(const GreyPicture& grey, const Landmarks& start, const TrackMarkersResult& before,
                const TrackMarkersOptions& options)
      : grey_(grey),
        start_(start),
        before_(before),
        options_(options),
        side_(static_cast<int>(options.template_px)),
        reach_px_(static_cast<int>(options.search_px / 2)),
        matches_(start.points.size()),
        sure_(start.points.size(), false) {
    for (std::size_t i = 0; i < count(); ++i) {
      const Landmark &from = start.points[i], &last = before.markers.points[i];
      squares_.emplace_back(before.templates, i, side_,
                            Place{from.x_px - corner_of(from.x_px, side_), from.y_px - corner_of(from.y_px, side_)});
      start_places_.push_back({from.x_px, from.y_px});
      last_.push_back({last.x_px, last.y_px});
      own_forecast_.push_back({last.x_px + before.moved_px.at(i, 0), last.y_px + before.moved_px.at(i, 1)});
    }
    follow();
    look_again();
    settle();
  }

  const MarkerMatch& match(std::size_t i) const { return matches_[i]; }
  // One that was lost is believed only where it is sure: a square that is bent far is a little like any edge.
  bool is_found(std::size_t i) const {
    const double least = was_followed(i) ? options_.least_likeness : std::max(options_.least_likeness, sure_likeness);
    return matches_[i].likeness >= least && is_inside(i);
  }
  bool is_inside(std::size_t i) const { return fits(grey_, matches_[i].at.x, matches_[i].at.y, side_); }
  // Where a marker is that is not seen: as far from its start as those about it; its last place where none is followed.
  Place guess(std::size_t i) const {
    const std::optional<Place> went = neighbours_beside(i, start_places_);
    return went ? Place{start_places_[i].x + went->x, start_places_[i].y + went->y} : last_[i];
  }

 private:
  std::size_t count() const { return start_.points.size(); }
  bool was_followed(std::size_t i) const { return before_.markers.points[i].valid; }

  // How far those about a marker are beside `from`: the mean by the fourth power of their nearness on the first frame.
  std::optional<Place> neighbours_beside(std::size_t i, const std::vector<Place>& from) const {
    double x = 0, y = 0, sum = 0;
    for (std::size_t k = 0; k < count(); ++k) {
      if (k == i || !sure_[k]) continue;
      const double dx = start_places_[k].x - start_places_[i].x, dy = start_places_[k].y - start_places_[i].y;
      const double square = dx * dx + dy * dy + 1, weight = 1 / (square * square);
      x += weight * (matches_[k].at.x - from[k].x);
      y += weight * (matches_[k].at.y - from[k].y);
      sum += weight;
    }
    if (sum == 0) return std::nullopt;
    return Place{x / sum, y / sum};
  }

  void look(std::size_t i, const Place& forecast, int times, double cost, const std::vector<Place>* taken) {
    const auto bend = before_.bends.values.begin() + static_cast<std::ptrdiff_t>(4 * i);
    MarkerSearch search{forecast, {}, reach_px_ * times, cost, taken};
    std::copy(bend, bend + 4, search.bend.begin());
    matches_[i] = squares_[i].find(grey_, search);
  }

  // Each by itself, where it should be if it moves on. Of two on one dot the more alike has it; and one that is not
  // where those about it are is not sure.
  void follow() {
    for (std::size_t i = 0; i < count(); ++i) {
      if (!was_followed(i)) continue;
      look(i, own_forecast_[i], 1, first_cost, nullptr);
      sure_[i] = matches_[i].likeness >= sure_likeness && is_inside(i);
    }
    for (std::size_t i = 0; i < count(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (sure_[i] && sure_[k] && is_near(matches_[i].at, matches_[k].at, same_dot_px))
          sure_[matches_[i].likeness > matches_[k].likeness ? k : i] = false;
    std::vector<bool> odd(count(), false);
    for (std::size_t i = 0; i < count(); ++i)
      odd[i] = sure_[i] && distance(forecast(i), matches_[i].at) > odd_share * reach_px_;
    for (std::size_t i = 0; i < count(); ++i)
      if (odd[i]) sure_[i] = false;
  }

  Place forecast(std::size_t i) const {
    if (!was_followed(i)) return guess(i);
    const Place more = neighbours_beside(i, own_forecast_).value_or(Place{});
    return {own_forecast_[i].x + more.x, own_forecast_[i].y + more.y};
  }

  // The others in twice the neighbourhood about where those about them say, beside the dots that are taken; the surest
  // first, since it tells more about the rest.
  void look_again() {
    std::vector<Place> taken;
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < count(); ++i)
      if (sure_[i])
        taken.push_back(matches_[i].at);
      else
        open.push_back(i);
    std::vector<bool> looked(count(), false);
    std::vector<Place> forecasts(count());
    while (!open.empty()) {
      auto best = open.begin();
      for (auto i = open.begin(); i != open.end(); ++i) {
        const Place now = forecast(*i);
        const bool lies_on_taken =
            !taken.empty() && is_near(matches_[*i].at, taken.back(), 0.5 * static_cast<double>(side_));
        if (!looked[*i] || lies_on_taken || distance(now, forecasts[*i]) > forecast_stands_px) {
          look(*i, now, 2, second_cost, &taken);
          looked[*i] = true;
          forecasts[*i] = now;
        }
        if (matches_[*i].score > matches_[*best].score) best = i;
      }
      const std::size_t i = *best;
      open.erase(best);
      if (is_found(i)) taken.push_back(matches_[i].at);
      sure_[i] = is_found(i) && matches_[i].likeness >= sure_likeness;
    }
  }

  // A marker without a dot is looked for about the guess, also on dots that are taken. It takes another one's if that
  // lies where those about it say and not where those about the other say; the other is looked for once more.
  void settle() {
    for (std::size_t k = 0; k < count(); ++k) {
      if (is_found(k)) continue;
      const MarkerMatch before = matches_[k];
      const Place here = guess(k);
      look(k, here, 2, second_cost, nullptr);
      std::size_t owner = k;
      for (std::size_t i = 0; i < count(); ++i)
        if (i != k && is_found(i) && is_near(matches_[k].at, matches_[i].at, same_dot_px)) owner = i;
      const bool is_its_own =
          owner == k || distance(here, matches_[k].at) < 0.5 * distance(guess(owner), matches_[k].at);
      if (matches_[k].likeness < sure_likeness || !is_its_own) {
        matches_[k] = before;
        continue;
      }
      sure_[k] = true;
      if (owner == k) continue;
      sure_[owner] = false;
      std::vector<Place> taken;
      for (std::size_t i = 0; i < count(); ++i)
        if (i != owner && is_found(i)) taken.push_back(matches_[i].at);
      look(owner, guess(owner), 2, second_cost, &taken);
      sure_[owner] = is_found(owner) && matches_[owner].likeness >= sure_likeness;
    }
  }

  const GreyPicture& grey_;
  const Landmarks& start_;
  const TrackMarkersResult& before_;
  const TrackMarkersOptions& options_;
  int side_, reach_px_;
  std::vector<MarkerSquare> squares_;
  std::vector<Place> start_places_, last_, own_forecast_;  // own: on moving as it did
  std::vector<MarkerMatch> matches_;
  std::vector<bool> sure_;
};

void straighten(Matrix& bends, std::size_t i) {
  std::copy(straight.begin(), straight.end(), bends.values.begin() + static_cast<std::ptrdiff_t>(4 * i));
}

}  // namespace

TrackMarkersResult track_markers(const DepthScan& scan, const Landmarks& start, const Landmarks* correction,
                                 const engine::Prior<TrackMarkersResult>& before, const TrackMarkersOptions& options,
                                 engine::Progress& progress) {
  const GreyPicture grey = grey_of(scan.picture);
  const int side = static_cast<int>(options.template_px);
  const std::size_t count = start.points.size();
  TrackMarkersResult result;
  result.moved_px = {count, 2, std::vector<double>(2 * count, 0.0)};
  if (!before) {
    result.markers = start;
    result.bends = {count, 4, std::vector<double>(4 * count, 0.0)};
    result.templates = {std::max(side * static_cast<int>(count), 1), side, 1, {}};
    result.templates.pixels.assign(static_cast<std::size_t>(result.templates.width) * static_cast<std::size_t>(side),
                                   0);
    for (std::size_t i = 0; i < count; ++i) {
      const Landmark& point = start.points[i];
      check(fits(grey, point.x_px, point.y_px, 1), "start marker ", point.name, " is at (", point.x_px, ", ",
            point.y_px, "), outside the scan of ", grey.width, " x ", grey.height, " pixels");
      take_template(grey, point, side, i, result.templates);
      straighten(result.bends, i);
    }
  } else {
    check(before->markers.points.size() == count, "the frame before has ", before->markers.points.size(),
          " markers, start has ", count);
    result.templates = before->templates;
    result.markers = before->markers;
    result.bends = before->bends;
    const Constellation found(grey, start, *before, options);
    for (std::size_t i = 0; i < count; ++i) {
      Landmark& point = result.markers.points[i];
      const MarkerMatch& match = found.match(i);
      if (point.valid && !found.is_inside(i))
        progress.warn(message("marker ", point.name, " leaves the picture of ", grey.width, " x ", grey.height,
                              " pixels at (", std::lround(match.at.x), ", ", std::lround(match.at.y), ")"));
      const bool was_followed = point.valid;
      point.valid = found.is_found(i);
      if (!point.valid) {
        const Place guess = found.guess(i);
        point.x_px = guess.x;
        point.y_px = guess.y;
        continue;
      }
      if (was_followed) {
        result.moved_px.at(i, 0) = match.at.x - point.x_px;
        result.moved_px.at(i, 1) = match.at.y - point.y_px;
      }
      point.x_px = match.at.x;
      point.y_px = match.at.y;
      std::copy(match.bend.begin(), match.bend.end(), result.bends.values.begin() + static_cast<std::ptrdiff_t>(4 * i));
    }
  }
  if (correction)
    for (const Landmark& right : correction->points) {
      std::size_t i = 0;
      while (i < count && start.points[i].name != right.name) ++i;
      check(i < count, "a correction names the marker ", right.name, ", which start does not have");
      check(fits(grey, right.x_px, right.y_px, 1), "the correction of ", right.name, " is at (", right.x_px, ", ",
            right.y_px, "), outside the scan of ", grey.width, " x ", grey.height, " pixels");
      // The square is moved by whole pixels, so that the point keeps its place in it.
      Landmark whole = start.points[i];
      whole.x_px += std::round(right.x_px - whole.x_px);
      whole.y_px += std::round(right.y_px - whole.y_px);
      take_template(grey, whole, side, i, result.templates);
      result.markers.points[i] = {right.name, right.x_px, right.y_px, true};
      result.moved_px.at(i, 0) = result.moved_px.at(i, 1) = 0;
      straighten(result.bends, i);
    }
  for (const Landmark& point : result.markers.points)
    if (!point.valid) result.report += (result.report.empty() ? "" : " ") + point.name;
  return result;
}

}  // namespace face::align
