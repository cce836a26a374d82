// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/mouth_interior.h"

#include <array>
#include <numbers>

namespace face::phantom {
namespace {

constexpr double kPi = std::numbers::pi;

// A row of teeth: the half ellipse on which the crowns' fronts stand, mm, and the line of the biting edges.
struct Arch {
  double half_width, depth, front_z, edge_y;
  int down;  // 1 where the edges point down (upper teeth)
};
constexpr Arch kUpperArch = {26.5, 42, 105.2, -36.0, 1};
constexpr Arch kLowerArch = {24.6, 40, 102.6, -36.9, -1};

// Crowns from the middle to the back: width, height, thickness at the gum, thickness at the edge, roundness of the
// edge, and how far the edge stays behind the line of the front ones: rows curve away from each other towards the back.
struct Tooth {
  double width, height, root_mm, edge_mm, round_mm, behind_mm;
};
constexpr std::array<Tooth, 7> kUpperTeeth = {{{8.8, 10.6, 6.5, 2.2, 0.7, 0},
                                               {6.9, 9.4, 6.0, 2.2, 0.9, 0},
                                               {7.6, 10.2, 6.8, 3.0, 1.8, 0},
                                               {7.0, 8.6, 8.0, 6.0, 1.4, 0.2},
                                               {6.8, 8.0, 8.5, 6.8, 1.2, 0.4},
                                               {9.8, 7.4, 10.0, 8.6, 1.0, 0.8},
                                               {9.4, 7.0, 10.0, 8.6, 1.0, 1.3}}};
constexpr std::array<Tooth, 7> kLowerTeeth = {{{5.6, 8.8, 5.6, 2.0, 0.6, 0},
                                               {6.1, 8.8, 5.8, 2.0, 0.7, 0},
                                               {6.9, 9.8, 6.5, 2.8, 1.5, 0},
                                               {7.0, 8.4, 7.5, 5.6, 1.2, 0.5},
                                               {7.0, 7.8, 8.0, 6.4, 1.1, 1.1},
                                               {10.4, 7.2, 9.6, 8.4, 1.0, 2.0},
                                               {10.0, 7.0, 9.6, 8.4, 1.0, 3.0}}};
constexpr Vector3 kEnamel = {0.96, 0.93, 0.86}, kEnamelRoot = {0.93, 0.84, 0.72}, kEnamelFar = {0.66, 0.50, 0.42};
constexpr Vector3 kGum = {0.80, 0.42, 0.42}, kGumDeep = {0.55, 0.22, 0.23};
constexpr Vector3 kTongue = {0.84, 0.43, 0.43}, kTongueDeep = {0.55, 0.20, 0.22};

struct Place {
  Vector3 front, outward, along;  // on the crowns' front line; unit vectors away from the mouth and towards the back
};

Place arch_place(const Arch& arch, double angle) {
  const double s = std::sin(angle), c = std::cos(angle);
  const Vector3 along = unit({arch.half_width * c, 0, -arch.depth * s});
  return {{arch.half_width * s, arch.edge_y, arch.front_z - arch.depth * (1 - c)}, {-along.z, 0, along.x}, along};
}

// Angle of the arch at an arc length from the middle.
double arch_angle(const Arch& arch, double length_mm) {
  double angle = 0, done = 0;
  constexpr double step = 0.001;
  while (done < length_mm && angle < 0.5 * kPi) {
    done += step * std::hypot(arch.half_width * std::cos(angle), arch.depth * std::sin(angle));
    angle += step;
  }
  return angle;
}

constexpr std::uint32_t kToothColumns = 10;
constexpr std::array<double, 6> kToothRows = {-0.15, 0.1, 0.4, 0.72, 0.91, 0.985};  // gum to edge

void add_tooth(HeadBuilder& head, const Arch& arch, const Tooth& tooth, Place place) {
  place.front.y += arch.down * tooth.behind_mm;
  // Little light reaches the back of the mouth, and the molars are the darker teeth anyway.
  const double shade = smooth_step(98, 66, place.front.z);
  const Vector3 enamel = lerp(kEnamel, kEnamelFar, shade), root = lerp(kEnamelRoot, kEnamelFar, shade);
  const std::uint32_t first = head.vertex_count();
  for (const double t : kToothRows) {
    const double thick = lerp(tooth.root_mm, tooth.edge_mm, std::pow(std::clamp(t, 0.0, 1.0), 0.8));
    const double narrow = 0.80 + 0.20 * std::sin(0.5 * kPi * std::clamp(0.15 + 1.3 * t, 0.0, 1.0));
    const double end = t > 0.9 ? std::sqrt(std::max(0.0, 1 - square((t - 0.9) / 0.1))) : 1;  // the edge is rounded off
    for (std::uint32_t c = 0; c < kToothColumns; ++c) {
      const double a = 2 * kPi * c / kToothColumns * -arch.down;
      const double p = 0.62;  // between an ellipse (1) and a box (0)
      const double u = std::copysign(std::pow(std::abs(std::sin(a)), p), std::sin(a));
      const double w = std::copysign(std::pow(std::abs(std::cos(a)), p), std::cos(a));
      const double x = 0.485 * tooth.width * u * narrow * (0.75 + 0.25 * end);
      const double back = 0.5 * thick * (1 - w * (0.35 + 0.65 * end));
      // Corners of the edge are rounder than its middle.
      const double y =
          tooth.height * (1 - t) + tooth.round_mm * square(x / (0.5 * tooth.width)) * smooth_step(0.5, 1, t);
      const double bulge = 0.5 * std::sin(kPi * std::clamp(t, 0.0, 1.0)) - 0.6 * (1 - t);
      const Vector3 at = place.front + place.along * x + place.outward * (bulge - back) + Vector3{0, arch.down * y, 0};
      head.add_vertex(at, lerp(root, enamel, smooth_step(-0.05, 0.35, t)));
    }
  }
  const std::uint32_t tip = head.add_vertex(
      place.front - place.outward * (0.5 * tooth.edge_mm) + Vector3{0, arch.down * 0.012 * tooth.height, 0}, enamel);
  const auto rows = static_cast<std::uint32_t>(kToothRows.size());
  add_grid(head, first, rows, kToothColumns, true);
  const std::uint32_t last = first + (rows - 1) * kToothColumns;
  for (std::uint32_t c = 0; c < kToothColumns; ++c) head.add_polygon({last + c, last + (c + 1) % kToothColumns, tip});
}

// Both halves of a row of teeth, in the current part.
VertexRange add_teeth(HeadBuilder& head, const Arch& arch, const std::array<Tooth, 7>& teeth) {
  VertexRange range;
  range.first = head.vertex_count();
  const auto first_polygon = static_cast<std::uint32_t>(head.polygon_starts.size() - 1);
  double length_mm = 0;
  for (const Tooth& tooth : teeth) {
    add_tooth(head, arch, tooth, arch_place(arch, arch_angle(arch, length_mm + 0.5 * tooth.width)));
    length_mm += tooth.width;
  }
  const std::uint32_t before = head.parts.back().polygon_count;
  head.add_mirror_image("", range.first, first_polygon);
  const std::uint32_t added = head.parts.back().polygon_count;
  head.parts.pop_back();
  head.parts.back().polygon_count = before + added;
  range.end = head.vertex_count();
  return range;
}

constexpr std::uint32_t kGumColumns = 35, kGumRows = 7;

// A ridge that the teeth stand in, from its outer foot over the crest to its inner foot.
VertexRange add_gums(HeadBuilder& head, const Arch& arch, const std::array<Tooth, 7>& teeth) {
  VertexRange range;
  range.first = head.vertex_count();
  const double end = arch_angle(arch, 56);
  for (std::uint32_t r = 0; r < kGumRows; ++r)
    for (std::uint32_t c = 0; c < kGumColumns; ++c) {
      const std::uint32_t side = std::min(c, kGumColumns - 1 - c);  // equal on both sides
      const double angle = end * (1 - side / (0.5 * (kGumColumns - 1)));
      Place place = arch_place(arch, angle);
      const double height = lerp(teeth[0].height, teeth[6].height, angle / end) - 1.4;
      const double turn = kPi * (r / (kGumRows - 1.0)), half = lerp(4.6, 6.4, angle / end);
      const double out = half * std::cos(turn), up = 9.5 - 9.5 * std::pow(std::sin(turn), 0.6);
      Vector3 at =
          place.front + place.outward * (out - half + 1.0 - 0.05 * up) + Vector3{0, arch.down * (height + up), 0};
      if (c < kGumColumns / 2) at.x = -at.x;
      head.add_vertex(at, lerp(kGum, kGumDeep, smooth_step(1, 9, up)));
    }
  for (std::uint32_t r = 0; r < kGumRows; ++r)
    for (std::uint32_t c = 0; c <= kGumColumns / 2; ++c)
      head.pair(range.first + r * kGumColumns + c, range.first + r * kGumColumns + kGumColumns - 1 - c);
  for (std::uint32_t r = 0; r + 1 < kGumRows; ++r)
    for (std::uint32_t c = 0; c + 1 < kGumColumns; ++c) {
      const std::uint32_t a = range.first + r * kGumColumns + c, b = a + kGumColumns;
      if (arch.down > 0)
        head.add_polygon({a + 1, a, b, b + 1});
      else
        head.add_polygon({a, a + 1, b + 1, b});
    }
  range.end = head.vertex_count();
  return range;
}

constexpr std::uint32_t kTongueRows = 17, kTongueColumns = 20;

VertexRange add_tongue(HeadBuilder& head) {
  VertexRange range;
  range.first = head.vertex_count();
  for (std::uint32_t r = 0; r + 1 < kTongueRows; ++r) {
    const double t = r / (kTongueRows - 1.0);
    const double end = std::sqrt(std::max(0.0, 1 - std::pow(t, 6.0)));
    const double half_width = lerp(19.0, 13.5, t) * end, half_height = lerp(9.0, 3.4, t) * std::sqrt(end);
    const Vector3 middle = {0, lerp(-48.0, -43.5, smooth_step(0, 0.7, t)) + 1.2 * t * t, lerp(54.0, 97.5, t)};
    for (std::uint32_t c = 0; c < kTongueColumns; ++c) {
      const double a = 2 * kPi * c / kTongueColumns;  // column 0 is the middle of the top
      const double x = -half_width * std::sin(a), y = half_height * std::cos(a);
      const double groove = -1.1 * bell(x, 2.6) * end * smooth_step(0, 1, std::cos(a));
      head.add_vertex(middle + Vector3{x, y + groove, 0}, lerp(kTongueDeep, kTongue, smooth_step(0.15, 0.75, t)));
    }
  }
  const std::uint32_t tip = head.add_vertex({0, -42.2, 97.6}, kTongue);
  for (std::uint32_t r = 0; r + 1 < kTongueRows; ++r)
    for (std::uint32_t c = 1; c < kTongueColumns / 2; ++c)
      head.pair(range.first + r * kTongueColumns + c, range.first + r * kTongueColumns + kTongueColumns - c);
  add_grid(head, range.first, kTongueRows - 1, kTongueColumns, true);
  const std::uint32_t last = range.first + (kTongueRows - 2) * kTongueColumns;
  for (std::uint32_t c = 0; c < kTongueColumns; ++c) head.add_polygon({last + c, last + (c + 1) % kTongueColumns, tip});
  range.end = head.vertex_count();
  return range;
}

}  // namespace

MouthInterior add_mouth_interior(HeadBuilder& head) {
  MouthInterior mouth;
  head.begin_part("gums", {1, 1, 1}, 0.7);
  mouth.upper_gums = add_gums(head, kUpperArch, kUpperTeeth);
  mouth.lower_gums = add_gums(head, kLowerArch, kLowerTeeth);
  head.begin_part("teeth", {1, 1, 1}, 0.75);
  mouth.upper_teeth = add_teeth(head, kUpperArch, kUpperTeeth);
  mouth.lower_teeth = add_teeth(head, kLowerArch, kLowerTeeth);
  head.begin_part("tongue", {1, 1, 1}, 0.6);
  mouth.tongue = add_tongue(head);
  const std::uint32_t per_tooth = static_cast<std::uint32_t>(kToothRows.size()) * kToothColumns + 1;
  for (const std::uint32_t first : {0u, 7 * per_tooth})
    for (std::uint32_t k = 0; k < 3 * per_tooth; ++k)
      mouth.upper_front_teeth.push_back(mouth.upper_teeth.first + first + k);
  return mouth;
}

double tongue_position(std::uint32_t index_in_tongue) {
  return std::min(1.0, (index_in_tongue / kTongueColumns) / (kTongueRows - 1.0));
}

}  // namespace face::phantom
