// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/ict_look.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

#include "nodes/decode/ict_layout.h"
#include "nodes/decode/ict_nostrils.h"
#include "nodes/decode/mesh_tools.h"

namespace face::decode {
namespace {

constexpr Vec3f skin = {0.87f, 0.68f, 0.59f};
constexpr Vec3f lip = {0.74f, 0.45f, 0.43f};
constexpr Vec3f brow = {0.36f, 0.25f, 0.19f};
constexpr Vec3f white = {1, 1, 1};

struct Look {
  std::string_view material, part;
  Vec3f albedo_srgb;
  float gloss;
  bool visible;
};

// The sclera is a closed shell with the cornea bulging from it: it is what shows, and the ball with the iris inside is
// hidden by it. Occlusion, blend and fluid shells are for renderers with transparency, and so are lash cards: solid,
// they look like tape. Only the row of the upper cards at the lid stays, as a thin dark line.
constexpr Look looks[] = {
    {"M_Face", "face", skin, 0.25f, true},
    {"M_BackHead", "head", skin, 0.2f, true},
    {"", "mouth_socket", {0.42f, 0.16f, 0.15f}, 0.4f, true},
    {"", "eye_sockets", {0.62f, 0.36f, 0.32f}, 0.3f, true},
    {"M_GumsTongue", "gums_tongue", {0.76f, 0.40f, 0.39f}, 0.6f, true},
    {"M_Teeth", "teeth", {0.93f, 0.90f, 0.83f}, 0.7f, true},
    {"M_ScleraLeft", "sclera_left", white, 0.9f, true},
    {"M_IrisLeft", "iris_left", white, 0.5f, false},
    {"M_ScleraRight", "sclera_right", white, 0.9f, true},
    {"M_IrisRight", "iris_right", white, 0.5f, false},
    {"M_LacrimalFluid", "eye_fluid", white, 1.0f, false},
    {"M_EyeBlend", "eye_blend", white, 0.5f, false},
    {"M_EyeOcclusion", "eye_occlusion", {0.2f, 0.12f, 0.1f}, 0.0f, false},
    {"", "lashes", {0.12f, 0.08f, 0.07f}, 0.1f, true},
    {"M_EyeLashes", "lash_cards", {0.12f, 0.08f, 0.07f}, 0.1f, false},
};
constexpr std::size_t mouth_socket_look = 2, eye_sockets_look = 3, lashes_look = 13, other_look = 1;

Vec3f mix(const Vec3f& a, const Vec3f& b, float share) {
  Vec3f out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = a[k] + (b[k] - a[k]) * share;
  return out;
}

Vec3f over(const Vec3f& a, const Vec3f& b) { return {a[0] / b[0], a[1] / b[1], a[2] / b[2]}; }

// 0 below low, 1 above high, smooth between.
float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

// Whether a vertex of the lashes is at their root or one row from it.
bool is_lash_root(const Mesh& mesh, std::uint32_t v) {
  constexpr float root_row_mm = 2.05f;
  bool upper = false;
  for (const VertexRange card : ict_upper_lashes) upper = upper || card.contains(v);
  if (!upper) return false;
  for (std::uint32_t f = ict_face.first; f <= ict_face.last; ++f)
    if (distance(mesh.points_mm[f], mesh.points_mm[v]) <= root_row_mm) return true;
  return false;
}

std::size_t look_of(const std::string& material, const Mesh& mesh, std::size_t polygon) {
  if (material == "M_BackHead")
    for (std::uint32_t i = mesh.polygon_starts[polygon]; i < mesh.polygon_starts[polygon + 1]; ++i) {
      if (ict_mouth_socket.contains(mesh.corners[i])) return mouth_socket_look;
      if (ict_eye_sockets.contains(mesh.corners[i])) return eye_sockets_look;
    }
  if (material == "M_EyeLashes") {
    bool at_root = true;
    for (std::uint32_t i = mesh.polygon_starts[polygon]; i < mesh.polygon_starts[polygon + 1] && at_root; ++i)
      at_root = is_lash_root(mesh, mesh.corners[i]);
    if (at_root) return lashes_look;
  }
  for (std::size_t i = 0; i < std::size(looks); ++i)
    if (!material.empty() && looks[i].material == material) return i;
  return other_look;
}

void sort_polygons_into_parts(const Obj& obj, Mesh& mesh) {
  const std::size_t count = mesh.polygon_count();
  std::vector<std::size_t> look(count);
  for (std::size_t f = 0, m = 0; f < count; ++f) {
    while (m < obj.materials.size() && obj.materials[m].first_polygon <= f) ++m;
    look[f] = look_of(m > 0 ? obj.materials[m - 1].name : std::string(), mesh, f);
  }
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return look[a] < look[b]; });

  Mesh sorted;
  sorted.polygon_starts.push_back(0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t f = order[i];
    if (i == 0 || look[f] != look[order[i - 1]]) {
      const Look& l = looks[look[f]];
      sorted.parts.push_back(
          {std::string(l.part), static_cast<std::uint32_t>(i), 0, l.albedo_srgb, l.gloss, l.visible});
    }
    ++sorted.parts.back().polygon_count;
    for (std::uint32_t c = mesh.polygon_starts[f]; c < mesh.polygon_starts[f + 1]; ++c) {
      sorted.corners.push_back(mesh.corners[c]);
      if (!mesh.corner_uvs.empty()) sorted.corner_uvs.push_back(mesh.corner_uvs[c]);
    }
    sorted.polygon_starts.push_back(static_cast<std::uint32_t>(sorted.corners.size()));
  }
  mesh.corners = std::move(sorted.corners);
  mesh.corner_uvs = std::move(sorted.corner_uvs);
  mesh.polygon_starts = std::move(sorted.polygon_starts);
  mesh.parts = std::move(sorted.parts);
}

// A smooth line through landmarks first..last (uniform Catmull-Rom), 8 points per segment.
std::vector<Vec3f> line_through(const Mesh& mesh, int first, int last, bool closed) {
  const int count = last - first + 1;
  const auto at = [&](int i) -> const Vec3f& {
    i = closed ? ((i % count) + count) % count : std::clamp(i, 0, count - 1);
    return mesh.points_mm[ict_landmarks68[static_cast<std::size_t>(first + i)]];
  };
  std::vector<Vec3f> line;
  for (int i = 0; i < (closed ? count : count - 1); ++i)
    for (int step = 0; step < 8; ++step) {
      const float t = static_cast<float>(step) / 8, t2 = t * t, t3 = t2 * t;
      Vec3f p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = 0.5f * (2 * at(i)[k] + (at(i + 1)[k] - at(i - 1)[k]) * t +
                       (2 * at(i - 1)[k] - 5 * at(i)[k] + 4 * at(i + 1)[k] - at(i + 2)[k]) * t2 +
                       (3 * at(i)[k] - at(i - 1)[k] - 3 * at(i + 1)[k] + at(i + 2)[k]) * t3);
      line.push_back(p);
    }
  line.push_back(at(closed ? 0 : count - 1));
  return line;
}

struct OnLine {
  float distance_mm = 1e9f;
  float share = 0;  // of the line, to the nearest segment
};

OnLine nearest_on_line(const Vec3f& p, const std::vector<Vec3f>& line) {
  OnLine best;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const float off = distance_to_segment(p, line[i - 1], line[i]);
    if (off < best.distance_mm) best = {off, static_cast<float>(i) / static_cast<float>(line.size() - 1)};
  }
  return best;
}

float distance_to_line(const Vec3f& p, const std::vector<Vec3f>& line) { return nearest_on_line(p, line).distance_mm; }

// Even-odd rule in the frontal projection.
bool inside_outline(const Vec3f& p, const std::vector<Vec3f>& outline) {
  bool inside = false;
  for (std::size_t i = 1; i < outline.size(); ++i) {
    const Vec3f &a = outline[i - 1], &b = outline[i];
    if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1])) inside = !inside;
  }
  return inside;
}

void tint_lips_and_brows(Mesh& mesh) {
  const std::vector<Vec3f> lips = line_through(mesh, 48, 59, true);
  const std::vector<Vec3f> brows[] = {line_through(mesh, 17, 21, false), line_through(mesh, 22, 26, false)};
  const float corner_z = mesh.points_mm[ict_landmarks68[48]][2];
  for (std::uint32_t v = ict_face.first; v <= ict_mouth_socket.last; ++v) {
    const Vec3f& p = mesh.points_mm[v];
    const bool in_front = p[2] > corner_z - 12;  // not the back of the head behind the mouth
    if (!in_front) continue;
    const float edge = distance_to_line(p, lips) * (inside_outline(p, lips) ? 1.0f : -1.0f);
    if (edge > -2) mesh.colors_srgb[v] = mix(white, over(lip, skin), smooth_step(-0.8f, 0.8f, edge));
    if (!ict_face.contains(v)) continue;
    for (const auto& line : brows) {
      const OnLine near = nearest_on_line({p[0], p[1] + 1.0f, p[2]}, line);
      if (near.distance_mm >= 5) continue;
      // They thin out to both ends: the mesh is coarse there, and a hard end would be as jagged as it.
      const float from_temple = &line == &brows[0] ? near.share : 1 - near.share;
      const float thick = smooth_step(-0.05f, 0.45f, from_temple) * smooth_step(-0.08f, 0.16f, 1 - from_temple);
      const float share = 0.75f * thick * (1 - smooth_step(1.5f, 5, near.distance_mm));
      mesh.colors_srgb[v] = mix(mesh.colors_srgb[v], over(brow, skin), share);
    }
  }
}

void darken_nostrils(Mesh& mesh) {
  constexpr Vec3f inside = {0.30f, 0.12f, 0.10f};
  const std::vector<float> enclosed = enclosed_by_nose(mesh);
  for (std::uint32_t v = ict_face.first; v <= ict_face.last; ++v)
    mesh.colors_srgb[v] = mix(mesh.colors_srgb[v], over(inside, skin), smooth_step(0.8f, 0.97f, enclosed[v]));
}

// Paints pupil, iris and limbal ring around the point of the cornea that stands out most from the eyeball.
void paint_eye(std::string_view part, Mesh& mesh) {
  const std::vector<bool> inside = vertices_of_parts(mesh, part);
  Vec3f low = {1e9f, 1e9f, 1e9f}, high = {-1e9f, -1e9f, -1e9f};
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < inside.size(); ++v) {
    if (!inside[v]) continue;
    vertices.push_back(v);
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], mesh.points_mm[v][k]);
      high[k] = std::max(high[k], mesh.points_mm[v][k]);
    }
  }
  if (vertices.empty()) return;
  const float radius = (high[0] - low[0]) / 2;
  const Vec3f centre = {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2] + radius};
  std::vector<std::uint32_t> farthest = vertices;
  const std::size_t apex_count = std::min<std::size_t>(24, farthest.size());
  std::sort(farthest.begin(), farthest.end(), [&](std::uint32_t a, std::uint32_t b) {
    const float da = distance(mesh.points_mm[a], centre), db = distance(mesh.points_mm[b], centre);
    return da != db ? da > db : a < b;
  });
  Vec3f apex{};
  for (std::size_t i = 0; i < apex_count; ++i)
    for (std::size_t k = 0; k < 3; ++k) apex[k] += mesh.points_mm[farthest[i]][k] / static_cast<float>(apex_count);

  // Human proportions: iris 11.7 mm, pupil 4 mm across on a ball of 24 mm.
  const float iris_mm = radius * 11.7f / 24, pupil_mm = radius * 4.2f / 24;
  constexpr Vec3f sclera = {0.93f, 0.91f, 0.89f}, limbus = {0.13f, 0.17f, 0.20f}, outer = {0.27f, 0.42f, 0.50f},
                  inner = {0.46f, 0.52f, 0.44f}, pupil = {0.02f, 0.02f, 0.02f};
  for (const std::uint32_t v : vertices) {
    const float r = distance(mesh.points_mm[v], apex);
    Vec3f colour = mix(pupil, inner, smooth_step(pupil_mm * 0.9f, pupil_mm * 1.15f, r));
    colour = mix(colour, outer, smooth_step(pupil_mm * 1.2f, iris_mm * 0.75f, r));
    colour = mix(colour, limbus, smooth_step(iris_mm * 0.75f, iris_mm * 0.95f, r));
    mesh.colors_srgb[v] = mix(colour, sclera, smooth_step(iris_mm * 0.95f, iris_mm * 1.12f, r));
  }
}

}  // namespace

void dress_ict_mesh(const Obj& obj, Mesh& mesh) {
  sort_polygons_into_parts(obj, mesh);
  mesh.colors_srgb.assign(mesh.points_mm.size(), white);
  tint_lips_and_brows(mesh);
  darken_nostrils(mesh);
  for (const std::string_view part : {"sclera_left", "sclera_right"}) paint_eye(part, mesh);
}

}  // namespace face::decode
