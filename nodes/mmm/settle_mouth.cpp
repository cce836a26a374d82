// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/settle_mouth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/base/check_image.h"
#include "nodes/base/find_landmark.h"
#include "nodes/track/flow_pair.h"
#include "nodes/track/inner_lips.h"
#include "nodes/track/jaw_line.h"
#include "nodes/track/lip_colours.h"
#include "nodes/track/mouth_shape.h"
#include "nodes/track/outline.h"
#include "nodes/track/settle.h"

namespace face::mmm {
namespace {

using track::Sighting;

constexpr int first_outer = 48, outer_count = 12, first_inner = 60, first_chin = 5, last_chin = 11;
constexpr int side_px = 11;             // of what is looked at about a point
constexpr double skin_error_px = 2;     // of what flow says of a chin
constexpr double rigid_error_px = 0.5;  // of what flow says of nose and eyes
constexpr double reach_px = 6;          // how far from where it is expected the edge of the lips is looked for
constexpr double near_px = 4;           // what a guess of how far the lower lip has fallen has to come near to
constexpr double least_drop = -0.1, most_drop = 0.6;  // guesses, shares of the mouth's width
constexpr double mode_drop = 0.25;                    // that of mouth_modes' lower lip
constexpr double better_by = 0.15;                    // mean likeness of a lower lip that flow has not found
constexpr double usual_stray = 0.1;  // of an inner point, from where the outer lips take it, of the mouth's width
constexpr double most_off_px = 4;    // of an inner point on the reference, from where its lips are found to part
constexpr double slack_px = 1;       // usual distance of a point from what the shapes of a mouth give

void check_finite(const Landmarks& landmarks, const std::string& name) {
  for (const Landmark& point : landmarks.points)
    check(!point.valid || (std::isfinite(point.x_px) && std::isfinite(point.y_px)), name, " has the point ", point.name,
          " at (", point.x_px, ", ", point.y_px, "), expected finite numbers");
}

std::string name_of(int number) { return (number < 10 ? "0" : "") + std::to_string(number); }

// An inner point and the outer one that it moves with.
constexpr std::array<std::pair<int, int>, 8> beside = {
    {{60, 48}, {61, 50}, {62, 51}, {63, 52}, {64, 54}, {65, 56}, {66, 57}, {67, 58}}};

// What takes part in the settlement, in this order: outer lips, chin, inner lips, rigid points.
struct Points {
  Landmarks start, now;
  std::vector<std::size_t> place;  // in the followed points
  std::vector<std::size_t> outline, chin, rigid;
  std::vector<std::pair<std::size_t, std::size_t>> inner;  // an inner point and its outer one, places in `start`
  std::vector<double> depths_px;
};

Points choose(const Landmarks& start, const Landmarks& landmarks, const Matrix* depths_px,
              const std::vector<std::string>& rigid) {
  Points points;
  // False where it cannot be used.
  const auto add = [&](const std::string& name) {
    const std::size_t before = landmark_index(start, name), now = landmark_index(landmarks, name);
    if (before == start.points.size() || now == landmarks.points.size()) return false;
    if (!start.points[before].valid || !landmarks.points[now].valid) return false;
    points.start.points.push_back(start.points[before]);
    points.now.points.push_back(landmarks.points[now]);
    points.place.push_back(now);
    if (depths_px) points.depths_px.push_back(depths_px->values[before]);
    return true;
  };
  for (int i = 0; i < outer_count; ++i)
    if (add(name_of(first_outer + i))) points.outline.push_back(points.start.points.size() - 1);
  if (points.outline.size() < outer_count) return points;
  for (int i = first_chin; i <= last_chin; ++i)
    if (add(name_of(i))) points.chin.push_back(points.start.points.size() - 1);
  for (const auto& [inner, outer] : beside)
    if (add(name_of(inner)))
      points.inner.emplace_back(points.start.points.size() - 1, points.outline[static_cast<std::size_t>(outer - 48)]);
  for (const std::string& name : rigid)
    if (add(name)) points.rigid.push_back(points.start.points.size() - 1);
  return points;
}

// The ways in which outer lips and chin move, inner lips with them; and the lips' own height.
std::vector<std::vector<double>> modes_of(const Points& points) {
  std::vector<std::vector<double>> modes = track::mouth_modes(points.start, points.outline, points.chin);
  for (std::vector<double>& mode : modes)
    for (const auto& [inner, outer] : points.inner)
      for (std::size_t axis = 0; axis < 2; ++axis) mode[2 * inner + axis] = mode[2 * outer + axis];
  const double width = track::mouth_width_px(points.start, points.outline);
  const Landmark &right = points.start.points[points.outline[0]], &left = points.start.points[points.outline[6]];
  const double down_x = -(left.y_px - right.y_px) / width, down_y = (left.x_px - right.x_px) / width;
  for (const bool upper : {true, false}) {
    std::vector<double> mode(2 * points.start.points.size(), 0.0);
    for (const auto& [inner, outer] : points.inner) {
      if (outer % 6 == 0 || (outer < 6) != upper) continue;  // corners; the other lip
      const double size = 0.06 * width;
      mode[2 * inner] = size * down_x, mode[2 * inner + 1] = size * down_y;
    }
    modes.push_back(std::move(mode));
  }
  return modes;
}

// Where the lips part, "61" to "63" and "65" to "67".
Landmarks parting(const Image& image, const Points& points, const Landmarks& places) {
  Landmarks lips;
  for (int i = 0; i < outer_count; ++i) {
    lips.points.push_back(places.points[points.outline[static_cast<std::size_t>(i)]]);
    lips.points.back().name = "lip_" + std::to_string(i);
  }
  const track::LipColoursResult seen = track::lip_colours(image, lips);
  Landmarks found = track::inner_lips(seen.colours, seen.contrast, lips);
  found.points.erase(found.points.begin(), found.points.begin() + outer_count);
  for (Landmark& point : found.points) point.name = name_of(first_inner + (point.name.back() - '0'));
  return found;
}

// What is known of a mouth before a frame is looked at.
struct Mouth {
  const Image& reference;
  Points points;
  track::Bonds bonds;
  double width_px;
  Matrix look, chin_look;  // the latter empty where there is no chin

  Mouth(const Image& first, Points chosen) : reference(first), points(std::move(chosen)) {
    bonds.modes = modes_of(points);
    bonds.slack_px = slack_px;
    bonds.rigid = points.rigid;
    bonds.depths_px = points.depths_px;
    width_px = track::mouth_width_px(points.start, points.outline);
    look = track::learn_outline(reference, points.start, points.outline);
    if (points.chin.size() >= 2)
      chin_look = track::learn_jaw_line(track::grey_of(reference), points.start, points.chin, points.outline, width_px);
  }

  bool is_rigid(std::size_t point) const {
    return std::find(points.rigid.begin(), points.rigid.end(), point) != points.rigid.end();
  }
  // The outer points of the lower lip.
  std::vector<std::size_t> lower_lip() const { return {points.outline.begin() + 7, points.outline.end()}; }
  std::vector<Sighting> settle(const std::vector<Sighting>& sightings) const {
    return track::settle(points.start, sightings, bonds);
  }
  Landmarks at(const std::vector<Sighting>& places) const { return track::places_of(points.start, places); }
  // Where the head alone would put the points.
  Landmarks rest(std::vector<Sighting> sightings) const {
    for (std::size_t i = 0; i < sightings.size(); ++i)
      if (!is_rigid(i)) track::forget(sightings[i]);
    return at(settle(sightings));
  }
};

// Where flow took the points, as surely as the picture tells their places. Of inner lips it says nothing.
std::vector<Sighting> follow(const Mouth& mouth, const track::Grey& grey, double flow_error_px) {
  std::vector<Sighting> followed;
  for (const Landmark& point : mouth.points.now.points) followed.push_back({point.x_px, point.y_px, 0, 0, 0});
  for (const std::size_t i : mouth.points.outline)
    track::add_information(grey, side_px, followed[i]), limit(flow_error_px, followed[i]);
  for (const std::size_t i : mouth.points.chin)
    track::add_information(grey, side_px, followed[i]), limit(skin_error_px, followed[i]);
  for (const std::size_t i : mouth.points.rigid)
    followed[i] = track::sighted(followed[i].x_px, followed[i].y_px, rigid_error_px);
  return followed;
}

// Flow that takes the hollow of a mouth for the lower lip is as sure as any other. Where no lip is to be seen at the
// place it names, and one farther up or down, the flow of the lower lip is forgotten. Gives where the points are then.
std::vector<Sighting> find_lower_lip(const Mouth& mouth, const Image& image, std::vector<Sighting>& followed) {
  const Landmarks rest = mouth.rest(followed);
  const std::vector<std::size_t> lower_lip = mouth.lower_lip();
  const auto likeness = [&](const std::vector<Sighting>& places) {
    const track::EdgeSight edge =
        track::see_outline(image, mouth.at(places), rest, mouth.points.outline, mouth.look, near_px);
    double sum = 0;
    for (std::size_t k = outer_count - lower_lip.size(); k < outer_count; ++k) sum += edge.likeness[k];
    return sum / static_cast<double>(lower_lip.size());
  };
  std::vector<Sighting> unknown = followed, settled = mouth.settle(followed);
  for (const std::size_t i : lower_lip) track::forget(unknown[i]);
  for (const std::size_t i : mouth.points.chin) track::forget(unknown[i]);
  const std::vector<Sighting> raised = mouth.settle(unknown);
  const std::vector<double>& fall = mouth.bonds.modes[track::lower_lip_mode];
  double best = likeness(settled) + better_by;
  const int guesses = static_cast<int>(std::ceil((most_drop - least_drop) * mouth.width_px / near_px));
  for (int guess = 0; guess < guesses; ++guess) {
    const double drop = least_drop + guess * near_px / mouth.width_px;
    std::vector<Sighting> fallen = raised;
    for (const std::size_t i : lower_lip) {
      fallen[i].x_px += drop / mode_drop * fall[2 * i];
      fallen[i].y_px += drop / mode_drop * fall[2 * i + 1];
    }
    const double here = likeness(fallen);
    if (here <= best) continue;
    best = here;
    settled = fallen;
    for (const std::size_t i : lower_lip) track::forget(followed[i]);
  }
  return settled;
}

// What is known of the points once the edges of lips and chin were looked for about `settled`.
std::vector<Sighting> fit_edges(const Mouth& mouth, const Image& image, const track::Grey& grey,
                                const std::vector<Sighting>& followed, std::vector<Sighting>& settled) {
  const Points& points = mouth.points;
  const Landmarks rest = mouth.rest(followed);
  std::vector<Sighting> all;
  constexpr int rounds = 2;  // the normals of the first are of the expected shape
  for (int round = 0; round < rounds; ++round) {
    const Landmarks expected = mouth.at(settled);
    all = followed;
    const track::EdgeSight lips = track::see_outline(image, expected, rest, points.outline, mouth.look, reach_px);
    for (std::size_t k = 0; k < points.outline.size(); ++k) add(lips.sightings[k], all[points.outline[k]]);
    if (!mouth.chin_look.values.empty()) {
      const track::EdgeSight chin =
          track::see_jaw_line(grey, expected, points.chin, points.outline, mouth.width_px, mouth.chin_look);
      for (std::size_t k = 0; k < points.chin.size(); ++k) add(chin.sightings[k], all[points.chin[k]]);
    }
    settled = mouth.settle(all);
  }
  return all;
}

// Inner lips are seen where the lips part, across them only. What is far from where the outer lips take them is the
// less believed: a tongue or gums can look like a lip. outer: all points, settled by the outer lips.
void see_parting(const Mouth& mouth, const Image& image, const Landmarks& outer, double error_px,
                 std::vector<Sighting>& sightings) {
  const Points& points = mouth.points;
  const Landmarks at_start = parting(mouth.reference, points, points.start), now = parting(image, points, outer);
  const Landmark &right = outer.points[points.outline[0]], &left = outer.points[points.outline[6]];
  const double dx = left.x_px - right.x_px, dy = left.y_px - right.y_px;
  const double sure = 1 / (error_px * error_px) / std::max(dx * dx + dy * dy, 1e-9);
  for (const auto& [inner, beside_it] : points.inner) {
    const Landmark& start = points.start.points[inner];
    const Landmark *found = find_landmark(now, start.name), *was = find_landmark(at_start, start.name);
    if (!found || !was) continue;
    double off_x = start.x_px - was->x_px, off_y = start.y_px - was->y_px;
    if (std::hypot(off_x, off_y) > most_off_px) off_x = off_y = 0;
    const double x = found->x_px + off_x, y = found->y_px + off_y;
    const double stray =
        ((y - outer.points[inner].y_px) * dx - (x - outer.points[inner].x_px) * dy) / (dx * dx + dy * dy);
    const double belief = sure / std::pow(1 + std::pow(stray / usual_stray, 2), 2);
    sightings[inner] = {x, y, belief * dy * dy, -belief * dx * dy, belief * dx * dx};
  }
}

}  // namespace

Landmarks settle_mouth(const Image& reference, const Landmarks& start, const Image& image, const Landmarks& landmarks,
                       const Matrix* depths_px, const SettleMouthOptions& options) {
  check_image(reference, "reference");
  check_image(image, "the image");
  check(image.width == reference.width && image.height == reference.height, "the image is ", image.width, " x ",
        image.height, " pixels, reference is ", reference.width, " x ", reference.height);
  check_finite(start, "start");
  check_finite(landmarks, "landmarks");
  if (depths_px) {
    check(depths_px->values.size() == start.points.size(), "depths_px has ", depths_px->values.size(),
          " numbers, start has ", start.points.size(), " points");
    for (const double depth : depths_px->values) check(std::isfinite(depth), "a depth is ", depth, " px");
  }
  Points points = choose(start, landmarks, depths_px, options.rigid);
  if (points.outline.size() < outer_count) return landmarks;
  const Mouth mouth(reference, std::move(points));
  const track::Grey grey = track::grey_of(image);
  std::vector<Sighting> followed = follow(mouth, grey, options.flow_error_px);
  std::vector<Sighting> settled = find_lower_lip(mouth, image, followed);
  std::vector<Sighting> all = fit_edges(mouth, image, grey, followed, settled);
  see_parting(mouth, image, mouth.at(settled), options.lips_part_px, all);
  settled = mouth.settle(all);

  Landmarks out = landmarks;
  for (std::size_t i = 0; i < settled.size(); ++i) {
    if (mouth.is_rigid(i)) continue;
    Landmark& point = out.points[mouth.points.place[i]];
    point.x_px = settled[i].x_px, point.y_px = settled[i].y_px;
  }
  return out;
}

}  // namespace face::mmm
