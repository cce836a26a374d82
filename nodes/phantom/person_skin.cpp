// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/person_skin.h"

#include <array>
#include <numbers>
#include <vector>

#include "nodes/phantom/person_random.h"

namespace face::phantom {
namespace {

// Tones from dark to light, sRGB: chosen by eye along the six types of Fitzpatrick (The Validity and Practicality of
// Sun-Reactive Skin Types I Through VI, Archives of Dermatology, 1988).
constexpr std::array<Vector3, 6> kTones = {{{0.39, 0.255, 0.20},
                                            {0.51, 0.345, 0.265},
                                            {0.66, 0.465, 0.355},
                                            {0.80, 0.605, 0.485},
                                            {0.89, 0.695, 0.585},
                                            {0.945, 0.775, 0.690}}};
struct Hair {
  Vector3 color;
  double darkest, lightest;  // skin, on the scale of SkinTone::lightness
  int share;
};
constexpr std::array<Hair, 7> kHair = {{{{0.075, 0.06, 0.055}, 0, 1, 4},
                                        {{0.14, 0.09, 0.065}, 0, 1, 4},
                                        {{0.27, 0.17, 0.11}, 0.3, 1, 3},
                                        {{0.40, 0.265, 0.165}, 0.5, 1, 3},
                                        {{0.62, 0.47, 0.29}, 0.65, 1, 3},
                                        {{0.41, 0.21, 0.115}, 0.7, 1, 1},
                                        {{0.55, 0.53, 0.51}, 0, 1, 2}}};
constexpr std::array<Vector3, 5> kIris = {
    {{0.20, 0.105, 0.05}, {0.33, 0.20, 0.09}, {0.36, 0.34, 0.16}, {0.30, 0.42, 0.46}, {0.25, 0.38, 0.55}}};

Vector3 product(Vector3 a, Vector3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Vector3 ratio(Vector3 a, Vector3 b) {
  return {a.x / std::max(b.x, 0.02), a.y / std::max(b.y, 0.02), a.z / std::max(b.z, 0.02)};
}
Vector3 clamped(Vector3 c) { return {std::clamp(c.x, 0.0, 1.0), std::clamp(c.y, 0.0, 1.0), std::clamp(c.z, 0.0, 1.0)}; }
double brightness(Vector3 c) { return 0.3 * c.x + 0.59 * c.y + 0.11 * c.z; }

// Smooth noise, about 0 with standard deviation 1: waves of lengths between two in random directions.
class Noise {
 public:
  Noise(Random random, double shortest_mm, double longest_mm) {
    for (Wave& wave : waves_) {
      const Vector3 direction = unit({random.normal(), random.normal(), random.normal()});
      wave.per_mm = direction * (2 * std::numbers::pi / random.uniform(shortest_mm, longest_mm));
      wave.phase = random.uniform(0, 2 * std::numbers::pi);
    }
  }
  double at(Vector3 p) const {
    double sum = 0;
    for (const Wave& wave : waves_) sum += std::sin(dot(wave.per_mm, p) + wave.phase);
    return sum * std::sqrt(2.0 / static_cast<double>(waves_.size()));
  }

 private:
  struct Wave {
    Vector3 per_mm;
    double phase = 0;
  };
  std::array<Wave, 24> waves_;
};

Vector3 mean_skin(const Mesh& mesh, const std::vector<std::size_t>& parts, const FacePlaces& places) {
  Vector3 sum;
  double count = 0;
  for (std::size_t v = 0; v < parts.size(); ++v) {
    if (parts[v] >= mesh.parts.size() || mesh.parts[parts[v]].name != "face") continue;
    const Vector3 p = to_vector(mesh.points_mm[v]);
    if (places.from_lips_mm(p) < 4 || places.from_eyes_mm(p) < 8 || places.from_brows_mm(p) < 6) continue;
    sum += product(to_vector(mesh.colors_srgb[v]), to_vector(mesh.parts[parts[v]].albedo_srgb));
    ++count;
  }
  return count > 0 ? sum * (1 / count) : Vector3{0.9, 0.7, 0.6};
}

void ensure_colors(Mesh& mesh) {
  if (mesh.colors_srgb.empty()) mesh.colors_srgb.assign(mesh.points_mm.size(), {1, 1, 1});
}

// What one person's skin has.
struct Complexion {
  Vector3 tint, lip_tint, hair, iris;
  double blush, shade_under_eyes, beard, mottle;
  SkinTone tone;
};

Complexion random_complexion(const PersonSkinOptions& options, Vector3 rig_skin) {
  Complexion look;
  look.tone = skin_tone(options.seed, options.lightest);
  look.tint = ratio(look.tone.color_srgb, rig_skin);
  Random random = series(options.seed, 4);
  const double red = random.uniform(0.96, 1.2);
  look.lip_tint = {std::pow(look.tint.x, 0.75), std::pow(look.tint.y, 0.9) / red, std::pow(look.tint.z, 0.8) / red};
  look.blush = random.uniform(-0.25, 0.9);
  look.shade_under_eyes = random.uniform(0, 0.30);
  look.mottle = random.uniform(0.004, 0.012);
  std::vector<Vector3> hair;
  for (const Hair& h : kHair)
    if (look.tone.lightness >= h.darkest && look.tone.lightness <= h.lightest)
      hair.insert(hair.end(), static_cast<std::size_t>(h.share), h.color);
  look.hair = hair[static_cast<std::size_t>(random.uniform() * static_cast<double>(hair.size()))];
  const double iris = std::clamp(random.uniform(0, 5.4 * look.tone.lightness), 0.0, 4.99);
  look.iris = kIris[static_cast<std::size_t>(iris)];
  const bool has_beard = random.uniform() < options.beard;
  look.beard = has_beard ? random.uniform(0.25, 0.6) : 0;
  return look;
}

Vector3 skin_color(const Complexion& look, const FacePlaces& places, const Noise& fine, const Noise& wide, Vector3 p,
                   Vector3 color) {
  const double front = places.front(p);
  const double lips = smooth_step(0.8, -0.8, places.from_lips_mm(p)) * front;
  color = product(color, lerp(look.tint, look.lip_tint, lips));
  const double cheek_y = 0.55 * places.mark(30).y + 0.45 * places.mark(33).y;
  const double half = 0.5 * (places.mark(45).x - places.mark(36).x), middle = places.mark(33).x;
  const double cheek = bell(std::abs(p.x - middle) - 0.95 * half, 0.38 * half) * bell(p.y - cheek_y, 15) * front;
  color = product(color, lerp({1, 1, 1}, {0.99, 0.91, 0.90}, look.blush * cheek));
  for (const auto& [low, inner] : {std::pair{40, 41}, std::pair{46, 47}}) {
    const Vector3 under =
        0.5 * (places.mark(static_cast<std::size_t>(low)) + places.mark(static_cast<std::size_t>(inner)));
    const double shade = bell(p.x - under.x, 12) * bell(p.y - under.y + 6, 5) * front;
    color = product(color, lerp({1, 1, 1}, {0.78, 0.70, 0.74}, look.shade_under_eyes * shade));
  }
  const double beard = look.beard * places.beard(p) * (0.9 + 0.1 * fine.at(p));
  color = lerp(color, 0.45 * color + 0.35 * look.hair + Vector3{0.03, 0.04, 0.05}, std::max(beard, 0.0));
  const double uneven = look.mottle * (fine.at(p) + 0.8 * wide.at(p)), red = 0.6 * look.mottle * wide.at(p);
  return product(color, {1 + uneven, 1 + uneven - red, 1 + uneven - red});
}

// A rig without hair of its own on the brows has them painted: they are the dark places along the brows' lines.
double painted_brow(const FacePlaces& places, Vector3 p, Vector3 color, Vector3 skin) {
  return smooth_step(9, 5, places.from_brows_mm(p)) * smooth_step(0.85, 0.6, brightness(color) / brightness(skin)) *
         places.front(p);
}

}  // namespace

SkinTone skin_tone(std::int64_t seed, double lightest) {
  Random random = series(seed, 3);
  SkinTone tone;
  tone.lightness = lightest * std::pow(random.uniform(), 0.8);  // more light ones than dark ones
  const double place = tone.lightness * (kTones.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(place), kTones.size() - 2);
  tone.color_srgb = lerp(kTones[k], kTones[k + 1], place - static_cast<double>(k));
  const double warm = random.uniform(-0.02, 0.02);
  tone.color_srgb = product(tone.color_srgb, {1 + warm, 1, 1 - 1.5 * warm});
  return tone;
}

void color_person(const Mesh& rig_neutral, const FacePlaces& places, const PersonSkinOptions& options, Mesh& person) {
  ensure_colors(person);
  Mesh before = rig_neutral;
  ensure_colors(before);
  const std::vector<std::size_t> parts = vertex_parts(before);
  const Vector3 rig_skin = mean_skin(before, parts, places);
  const Complexion look = random_complexion(options, rig_skin);
  const Noise fine(series(options.seed, 5), 7, 16), wide(series(options.seed, 6), 25, 60);
  bool has_brows = false;
  for (const Part& part : before.parts) has_brows = has_brows || part.name == "brows";
  Vector3 hair_mean;
  double hair_count = 0;
  for (std::size_t v = 0; v < parts.size(); ++v)
    if (parts[v] < before.parts.size() && before.parts[parts[v]].name == "hair") {
      hair_mean += to_vector(before.colors_srgb[v]);
      ++hair_count;
    }
  const Vector3 hair_tint = hair_count > 0 ? ratio(look.hair, hair_mean * (1 / hair_count)) : Vector3{1, 1, 1};
  for (std::size_t v = 0; v < parts.size(); ++v) {
    if (parts[v] >= before.parts.size()) continue;
    const std::string& part = before.parts[parts[v]].name;
    const Vector3 p = to_vector(before.points_mm[v]), color = to_vector(before.colors_srgb[v]);
    Vector3 changed = color;
    if (is_skin(part)) {
      changed = skin_color(look, places, fine, wide, p, color);
      if (!has_brows)
        changed =
            lerp(changed, lerp(changed, look.hair, 0.6),
                 painted_brow(places, p, product(color, to_vector(before.parts[parts[v]].albedo_srgb)), rig_skin));
    } else if (part == "hair") {
      changed = product(color, hair_tint);
    } else if ((part.starts_with("iris_") || part.starts_with("sclera_")) && brightness(color) > 0.1 &&
               brightness(color) < 0.6) {
      changed = look.iris * (brightness(color) / 0.30);  // streaks and the dark rim stay
    }
    person.colors_srgb[v] = to_float(clamped(changed));
  }
  for (Part& part : person.parts)
    if (part.name == "brows") part.albedo_srgb = to_float(lerp(look.hair, 0.5 * look.tone.color_srgb, 0.2));
}

void put_lipstick(const Mesh& rig_neutral, const FacePlaces& places, std::int64_t seed, Mesh& person) {
  ensure_colors(person);
  constexpr std::array<Vector3, 4> kColors = {
      {{0.66, 0.07, 0.12}, {0.55, 0.05, 0.16}, {0.75, 0.16, 0.18}, {0.48, 0.10, 0.14}}};
  Random random = series(seed, 7);
  const Vector3 color = kColors[static_cast<std::size_t>(random.uniform() * kColors.size())];
  const std::vector<std::size_t> parts = vertex_parts(rig_neutral);
  for (std::size_t v = 0; v < parts.size(); ++v) {
    if (parts[v] >= rig_neutral.parts.size() || rig_neutral.parts[parts[v]].name != "face") continue;
    const Vector3 p = to_vector(rig_neutral.points_mm[v]);
    const double on = smooth_step(0.35, -0.35, places.from_lips_mm(p)) * places.front(p);
    const Vector3 albedo = to_vector(rig_neutral.parts[parts[v]].albedo_srgb);
    person.colors_srgb[v] = to_float(clamped(lerp(to_vector(person.colors_srgb[v]), ratio(color, albedo), on)));
  }
}

void paint_person(std::int64_t seed, Mesh& person) {
  ensure_colors(person);
  std::vector<Vector3> normals(person.points_mm.size());
  for (std::size_t f = 0; f < person.polygon_count(); ++f) {
    const std::uint32_t first = person.polygon_starts[f], end = person.polygon_starts[f + 1];
    const Vector3 a = to_vector(person.points_mm[person.corners[first]]);
    for (std::uint32_t i = first + 1; i + 1 < end; ++i) {
      const Vector3 area = cross(to_vector(person.points_mm[person.corners[i]]) - a,
                                 to_vector(person.points_mm[person.corners[i + 1]]) - a);
      for (const std::uint32_t v : {person.corners[first], person.corners[i], person.corners[i + 1]})
        normals[v] += area;
    }
  }
  const Vector3 light = unit({-0.55, 0.5, 0.67});
  const Noise strokes(series(seed, 8), 5, 14);
  const std::vector<std::size_t> parts = vertex_parts(person);
  for (std::size_t v = 0; v < normals.size(); ++v) {
    if (parts[v] >= person.parts.size()) continue;
    const std::string& part = person.parts[parts[v]].name;
    if (!is_skin(part) && part != "hair") continue;
    const double lit = 0.5 + 0.5 * dot(unit(normals[v]), light) + 0.05 * strokes.at(to_vector(person.points_mm[v]));
    constexpr double kLevels = 5;  // the step between two tones is soft over a third of it
    const double level = std::clamp(lit, 0.0, 1.0) * kLevels, whole = std::floor(level);
    const double tone = (whole + smooth_step(0.33, 0.67, level - whole)) / kLevels;
    const Vector3 shade = lerp({0.42, 0.33, 0.34}, {1.05, 1.0, 0.88}, tone);
    person.colors_srgb[v] = to_float(clamped(product(to_vector(person.colors_srgb[v]), shade)));
  }
  for (Part& part : person.parts)
    if (is_skin(part.name) || part.name == "hair") part.gloss = 0;
}

}  // namespace face::phantom
