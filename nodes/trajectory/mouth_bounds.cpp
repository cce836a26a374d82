// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/mouth_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "nodes/base/check.h"
#include "nodes/types/arkit.h"

namespace face::trajectory {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr std::string_view corrector_names[] = {"jawOpen",          "mouthClose",         "mouthFunnel",
                                                "mouthPucker",      "mouthRollLower",     "mouthRollUpper",
                                                "mouthShrugLower",  "mouthShrugUpper",    "mouthPressLeft",
                                                "mouthPressRight",  "mouthLowerDownLeft", "mouthLowerDownRight",
                                                "mouthUpperUpLeft", "mouthUpperUpRight"};

double product(const std::vector<double>& row, const std::vector<double>& weights) {
  double sum = 0;
  for (std::size_t s = 0; s < row.size(); ++s) sum += row[s] * weights[s];
  return sum;
}

// The nearest point is on one side, but a lip that comes to the teeth comes with both: sides share what either would
// do. For weights that are alike on both sides the row says the same as before.
void share_sides(std::vector<double>& row) {
  for (const std::string_view left_name : corrector_names) {
    if (!left_name.ends_with("Left")) continue;
    const std::size_t left = arkit_index(left_name);
    const std::size_t right = arkit_index(std::string(left_name.substr(0, left_name.size() - 4)) + "Right");
    row[left] = row[right] = 0.5 * (row[left] + row[right]);
  }
}

std::vector<float> as_floats(const std::vector<double>& weights) { return {weights.begin(), weights.end()}; }

}  // namespace

MouthBounds::MouthBounds(const Rig& rig, const MouthLimits& limits)
    : limits_(limits), pair_rows_(lip_gap_rows(rig)), teeth_(rig) {
  check(rig.shapes.size() >= arkit_count, "the rig has ", rig.shapes.size(), " shapes, expected the ", arkit_count,
        " of ARKit first");
  mean_row_.assign(arkit_count, 0.0);
  for (std::vector<double>& row : pair_rows_) {
    row.resize(arkit_count);
    for (std::size_t s = 0; s < arkit_count; ++s) mean_row_[s] += row[s] / static_cast<double>(pair_rows_.size());
  }
  for (const std::string_view name : corrector_names)
    if (!rig.shapes[arkit_index(name)].vertices.empty()) correctors_.push_back(arkit_index(name));
  std::sort(correctors_.begin(), correctors_.end());
}

LipGap MouthBounds::gap(const std::vector<double>& weights) const {
  LipGap gap;
  if (!has_lips()) return gap;
  gap.min_mm = infinity;
  gap.max_mm = -infinity;
  gap.mean_mm = product(mean_row_, weights);
  for (const std::vector<double>& row : pair_rows_) {
    const double pair = product(row, weights);
    gap.min_mm = std::min(gap.min_mm, pair);
    gap.max_mm = std::max(gap.max_mm, pair);
  }
  return gap;
}

double MouthBounds::teeth_mm(const std::vector<double>& weights) const {
  return teeth_.nearest(as_floats(weights)).distance_mm;
}

void MouthBounds::append(std::size_t frame, const std::vector<double>& row, double value,
                         const std::vector<double>& weights, double low, double high, std::vector<FrameBound>& bounds,
                         double price) const {
  FrameBound bound;
  bound.price = price;
  bound.frame = frame;
  double constant = value;
  bool acts = false;
  for (const std::size_t s : correctors_) {
    bound.row.push_back(row[s]);
    constant -= row[s] * weights[s];
    acts = acts || row[s] != 0;
  }
  if (!acts) return;
  bound.low = low - constant;
  bound.high = high - constant;
  bounds.push_back(std::move(bound));
}

void MouthBounds::keep_apart(std::size_t frame, const std::vector<double>& weights,
                             std::vector<FrameBound>& bounds) const {
  for (const std::vector<double>& row : pair_rows_)
    append(frame, row, product(row, weights), weights, -limits_.overlap_mm, infinity, bounds);
}

void MouthBounds::close(std::size_t frame, const std::vector<double>& weights, std::vector<FrameBound>& bounds) const {
  for (const std::vector<double>& row : pair_rows_)
    append(frame, row, product(row, weights), weights, -infinity, limits_.closed_pair_mm, bounds);
  append(frame, mean_row_, product(mean_row_, weights), weights, -infinity, limits_.closed_mm, bounds);
}

void MouthBounds::open(std::size_t frame, const std::vector<double>& weights, double open_mm,
                       std::vector<FrameBound>& bounds) const {
  append(frame, mean_row_, product(mean_row_, weights), weights, open_mm, infinity, bounds);
}

void MouthBounds::bound_teeth(std::size_t frame, const std::vector<double>& weights, bool touch,
                              std::vector<FrameBound>& bounds) const {
  constexpr std::size_t most_bite_bounds = 12;
  constexpr double near_mm = 3;
  std::vector<LipTeethContact> contacts = teeth_.contacts(as_floats(weights));
  std::sort(contacts.begin(), contacts.end(), [](const LipTeethContact& a, const LipTeethContact& b) {
    return a.distance_mm != b.distance_mm ? a.distance_mm < b.distance_mm : a.lip < b.lip;
  });
  const auto bound_along = [&](LipTeethContact contact, const Vec3f& direction, double value, double low, double high) {
    contact.normal = direction;
    std::vector<double> row = teeth_.row(contact);
    row.resize(arkit_count);
    share_sides(row);
    append(frame, row, value, weights, low, high, bounds, limits_.teeth_price);
  };
  for (std::size_t i = 0; i < std::min(most_bite_bounds, contacts.size()); ++i) {
    if (i > 0 && contacts[i].distance_mm > near_mm) break;
    bound_along(contacts[i], contacts[i].normal, contacts[i].distance_mm, -limits_.bite_mm,
                touch && i == 0 ? limits_.teeth_mm : infinity);
  }
  if (!touch) return;
  // The distance to an edge is convex: going along its gradient alone the lip slips past the edge and the next
  // linearisation sends it back. So the nearest point goes straight: it may slide by no more than slide_mm in the plane
  // that divides left from right.
  const Vec3f& normal = contacts.front().normal;
  const float length = std::hypot(normal[1], normal[2]);
  if (length > 0)
    bound_along(contacts.front(), {0, -normal[2] / length, normal[1] / length}, 0, -limits_.slide_mm, limits_.slide_mm);
}

bool MouthBounds::teeth_hold(const std::vector<double>& weights, bool touch) const {
  const double deepest_mm = limits_.bite_mm + limits_.tolerance_mm;
  if (!touch) return teeth_.depth_mm(as_floats(weights)) <= deepest_mm;
  const double distance_mm = teeth_mm(weights);
  return distance_mm >= -deepest_mm && distance_mm <= limits_.teeth_mm + limits_.tolerance_mm;
}

}  // namespace face::trajectory
