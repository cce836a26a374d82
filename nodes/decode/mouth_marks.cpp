// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/mouth_marks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "nodes/decode/mesh_tools.h"
#include "nodes/types/arkit.h"

namespace face::decode {
namespace {

// What the searches share.
struct Mouth {
  const Mesh& mesh;
  std::vector<float> jaw;  // motion of every vertex under jawOpen, as a share of the largest of its piece
  std::vector<Vec3f> normals;
  std::vector<std::uint32_t> piece;
  std::uint32_t face = 0;  // the piece that lips are on
};

Mouth examine(const Rig& rig) {
  Mouth mouth{rig.neutral, {}, vertex_normals(rig.neutral), connected_pieces(rig.neutral), 0};
  const std::size_t count = rig.neutral.points_mm.size();
  mouth.jaw.assign(count, 0);
  const Shape& jaw_open = rig.shapes[arkit_index("jawOpen")];
  std::vector<std::size_t> moved(count, 0);
  float largest = 0;
  for (std::size_t i = 0; i < jaw_open.vertices.size(); ++i) {
    const std::uint32_t v = jaw_open.vertices[i];
    mouth.jaw[v] = length(jaw_open.offsets_mm[i]);
    largest = std::max(largest, mouth.jaw[v]);
    ++moved[mouth.piece[v]];
  }
  if (largest > 0)
    for (float& x : mouth.jaw) x /= largest;
  // Lips are on the piece with the most vertices that the jaw moves (skin, not teeth or tongue).
  mouth.face = static_cast<std::uint32_t>(std::max_element(moved.begin(), moved.end()) - moved.begin());
  return mouth;
}

// Where the lips meet: among pairs of one piece of which jawOpen moves one vertex and leaves the other, that face each
// other and are close at rest, those in front. The first pair is the one nearest to the middle, then its neighbours at
// a quarter of the mouth's width on either side.
std::vector<LipPair> find_inner_lips(const Mouth& mouth) {
  const std::vector<Vec3f>& points = mouth.mesh.points_mm;
  std::vector<std::uint32_t> still, moving;
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    if (mouth.piece[v] != mouth.face) continue;
    if (mouth.jaw[v] < 0.3f && mouth.normals[v][1] < 0.3f) still.push_back(v);
    if (mouth.jaw[v] > 0.5f && mouth.normals[v][1] > -0.3f) moving.push_back(v);
  }
  std::sort(still.begin(), still.end(), [&](std::uint32_t a, std::uint32_t b) {
    return points[a][0] != points[b][0] ? points[a][0] < points[b][0] : a < b;
  });
  constexpr float reach_mm = 12;
  struct Candidate {
    LipPair pair;
    float distance_mm;
  };
  std::vector<Candidate> candidates;
  for (const std::uint32_t lower : moving) {
    const Vec3f& p = points[lower];
    auto it = std::lower_bound(still.begin(), still.end(), p[0] - 3.0f,
                               [&](std::uint32_t v, float x) { return points[v][0] < x; });
    std::optional<Candidate> best;
    for (; it != still.end() && points[*it][0] < p[0] + 3.0f; ++it) {
      const Vec3f gap = minus(points[*it], p);
      const float size = length(gap);
      if (size > reach_mm || (best && size >= best->distance_mm)) continue;
      if (size > 0.1f && (dot(mouth.normals[lower], gap) < 0.3f * size || dot(mouth.normals[*it], gap) > -0.3f * size))
        continue;
      best = Candidate{{*it, lower}, size};
    }
    if (best) candidates.push_back(*best);
  }
  if (candidates.empty()) return {};
  const auto nearest =
      std::min_element(candidates.begin(), candidates.end(),
                       [](const Candidate& a, const Candidate& b) { return a.distance_mm < b.distance_mm; });
  const float limit = nearest->distance_mm + 2.0f;
  std::erase_if(candidates, [&](const Candidate& c) { return c.distance_mm > limit; });

  float left = std::numeric_limits<float>::lowest(), right = std::numeric_limits<float>::max();
  for (const Candidate& c : candidates) {
    left = std::max(left, points[c.pair.lower][0]);
    right = std::min(right, points[c.pair.lower][0]);
  }
  std::vector<LipPair> pairs;
  for (const float share : {0.25f, 0.5f, 0.75f}) {
    const float x = right + (left - right) * share;
    const Candidate* best = nullptr;
    float best_score = std::numeric_limits<float>::lowest();
    for (const Candidate& c : candidates) {
      // The contact line is the frontmost of the touching surfaces; being off the column costs more than depth gains.
      const float score = points[c.pair.lower][2] - 4 * std::abs(points[c.pair.lower][0] - x) - 2 * c.distance_mm;
      if (score > best_score) best = &c, best_score = score;
    }
    const bool known = std::any_of(pairs.begin(), pairs.end(), [&](LipPair p) { return p.lower == best->pair.lower; });
    if (!known) pairs.push_back(best->pair);
  }
  return pairs;
}

// The rim of the lower lip: vertices that move with the jaw within 4 mm of the line through the lower inner lip points,
// lengthened by a quarter of its width at either end.
std::vector<std::uint32_t> find_lower_lip(const Mouth& mouth, const std::vector<LipPair>& pairs) {
  if (pairs.empty()) return {};
  constexpr float rim_mm = 4;
  const std::vector<Vec3f>& points = mouth.mesh.points_mm;
  std::vector<Vec3f> line;
  for (const LipPair& pair : pairs) line.push_back(points[pair.lower]);
  std::sort(line.begin(), line.end());
  std::vector<std::uint32_t> rim;
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    if (mouth.piece[v] != mouth.face || mouth.jaw[v] < 0.3f) continue;
    float off = distance(points[v], line.front());
    for (std::size_t i = 1; i < line.size(); ++i)
      off = std::min(off, distance_to_segment(points[v], line[i - 1], line[i]));
    if (off <= rim_mm) rim.push_back(v);
  }
  return rim;
}

// The upper incisors as the lower lip may meet them: vertices of parts named after teeth that jawOpen leaves in place,
// that look forward or down, within 16 mm of the midline and 10 mm of their edges (above are gums and roots).
std::vector<std::uint32_t> find_upper_teeth(const Mouth& mouth, const std::vector<LipPair>& pairs) {
  constexpr float half_width_mm = 16, crown_mm = 10;
  const std::vector<bool> teeth = vertices_of_parts(mouth.mesh, "teeth"),
                          tooth = vertices_of_parts(mouth.mesh, "tooth");
  const std::vector<Vec3f>& points = mouth.mesh.points_mm;
  float middle = 0;
  for (const LipPair& pair : pairs) middle += points[pair.upper][0] / static_cast<float>(pairs.size());
  std::vector<std::uint32_t> front;
  float edge = std::numeric_limits<float>::max();
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    if (!(teeth[v] || tooth[v]) || mouth.jaw[v] > 0.05f || std::abs(points[v][0] - middle) > half_width_mm) continue;
    edge = std::min(edge, points[v][1]);
    if (mouth.normals[v][2] > 0.2f || mouth.normals[v][1] < -0.5f) front.push_back(v);
  }
  std::erase_if(front, [&](std::uint32_t v) { return points[v][1] > edge + crown_mm; });
  return front;
}

}  // namespace

void find_mouth_marks(Rig& rig) {
  if (!rig.inner_lips.empty() && !rig.lower_lip.empty() && !rig.upper_teeth.empty()) return;
  const Mouth mouth = examine(rig);
  if (rig.inner_lips.empty()) rig.inner_lips = find_inner_lips(mouth);
  if (rig.lower_lip.empty()) rig.lower_lip = find_lower_lip(mouth, rig.inner_lips);
  if (rig.upper_teeth.empty()) rig.upper_teeth = find_upper_teeth(mouth, rig.inner_lips);
}

}  // namespace face::decode
