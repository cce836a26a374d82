// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/scale_motion.h"

#include <algorithm>
#include <array>
#include <complex>
#include <map>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/meshik/landmark_vertices.h"

namespace face::mmm {
namespace {

enum Part { left_eye, right_eye, mouth, whole, part_count };

struct Pair {
  meshik::LandmarkVertex place;
  Part part;
  std::complex<double> before, now;  // px, y down
};

struct Box {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  int points = 0;
  void add(double x, double y) {
    left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
    ++points;
  }
  double width() const { return right - left; }
  double height() const { return bottom - top; }
};

Part part_of(int number) {
  if (number >= 36 && number <= 41) return right_eye;
  if (number >= 42 && number <= 47) return left_eye;
  return number >= 48 ? mouth : whole;
}

std::vector<Pair> match(const Rig& rig, const Landmarks& reference, const Landmarks& landmarks) {
  std::map<std::string, const Landmark*> now;
  for (const Landmark& point : landmarks.points) now[point.name] = &point;
  std::vector<Pair> pairs;
  for (const meshik::LandmarkVertex& place : meshik::landmark_vertices(rig, reference)) {
    const Landmark& before = reference.points[place.landmark];
    const auto found = now.find(before.name);
    if (!before.valid || found == now.end() || !found->second->valid) continue;
    check(place.vertex < rig.neutral.points_mm.size(), "landmark ", before.name, " is vertex ", place.vertex,
          ", the rig has ", rig.neutral.points_mm.size());
    pairs.push_back(
        {place, part_of(place.number), {before.x_px, before.y_px}, {found->second->x_px, found->second->y_px}});
  }
  return pairs;
}

// now <- the similarity that takes the rigid points of now to before (least squares), applied to all.
void hold(std::vector<Pair>& pairs) {
  std::complex<double> mean_now = 0, mean_before = 0, product = 0;
  double count = 0, square = 0;
  for (const Pair& p : pairs)
    if (p.place.rigid) mean_now += p.now, mean_before += p.before, ++count;
  if (count < 2) return;
  mean_now /= count, mean_before /= count;
  for (const Pair& p : pairs)
    if (p.place.rigid)
      product += std::conj(p.now - mean_now) * (p.before - mean_before), square += std::norm(p.now - mean_now);
  if (!(square > 0)) return;
  for (Pair& p : pairs) p.now = product / square * (p.now - mean_now) + mean_before;
}

}  // namespace

VertexTargets scale_motion(const Rig& rig, const Landmarks& reference, const Landmarks& landmarks,
                           const VertexTargets* still, const ScaleMotionOptions& options) {
  std::vector<Pair> pairs = match(rig, reference, landmarks);
  if (options.hold_head) hold(pairs);
  std::array<Box, part_count> seen, built;
  for (const Pair& p : pairs) {
    const Vec3f& v = rig.neutral.points_mm[p.place.vertex];
    for (const Part part : {p.part, whole}) {
      seen[part].add(p.before.real(), p.before.imag());
      built[part].add(static_cast<double>(v[0]), static_cast<double>(v[1]));
      if (p.part == whole) break;
    }
  }
  const Box& face = seen[whole];
  VertexTargets result;
  // A face that is a point or a line says nothing of its scale.
  if (!(face.width() > 0 && face.height() > 0)) return result;
  std::map<std::uint32_t, VertexTarget> targets;
  if (still) {
    for (const VertexTarget& target : still->targets) {
      check(target.vertex < rig.neutral.points_mm.size(), "a still vertex is ", target.vertex, ", the rig has ",
            rig.neutral.points_mm.size());
      targets[target.vertex] = target;
    }
  }
  for (const Pair& p : pairs) {
    const bool own = seen[p.part].points >= 3 && seen[p.part].width() >= 0.1 * face.width() &&
                     seen[p.part].height() >= 0.1 * face.height();
    const Part part = own ? p.part : whole;
    const double scale_x = built[part].width() / seen[part].width();
    const double scale_y = built[part].height() / seen[part].height();
    const Vec3f& v = rig.neutral.points_mm[p.place.vertex];
    const std::complex<double> d = p.now - p.before;
    targets[p.place.vertex] = {p.place.vertex, static_cast<double>(v[0]) + scale_x * d.real(),
                               static_cast<double>(v[1]) - scale_y * d.imag(), 0, false};
  }
  for (const auto& [vertex, target] : targets) result.targets.push_back(target);
  return result;
}

}  // namespace face::mmm
