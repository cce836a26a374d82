// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/uncover_skin.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "nodes/base/quantile.h"
#include "nodes/model/light_model.h"
#include "nodes/texture/draw_face.h"
#include "nodes/texture/vertex_graph.h"

namespace face::texture {
namespace {

constexpr float above_brows_mm = 7;    // where hair becomes possible
constexpr float fade_mm = 3;           // over which it does
constexpr float cheek_hair_mm = 16;    // from the outline inwards, where hair may hang over cheeks
constexpr float cheek_fade_mm = 14;    // below the eyes, over which that begins
constexpr double beard_darker = 0.25;  // of the chin's skin below the cheeks', logarithm: hair that grows there
constexpr float below_chin_mm = 2, below_beard_mm = 12;  // where collars begin
constexpr float brow_mm = 12, tail_mm = 4, eye_mm = 8, nose_mm = 14,
                lips_mm = 8;           // as far from their marks no strand is followed
constexpr float beside_mm = 4.5;       // twice as far about what hides the skin nothing is believed
constexpr double one_sided = 0.8;      // logarithm by which the sides differ where something lies over one of them
constexpr double other_side = 0.5;     // what the other side's skin counts where this one's is hidden
constexpr double light_reach_mm = 12;  // differences of the sides that are wider are the light's
constexpr double lights_share = 0.8;   // of them
constexpr double colours_share = 0.5;  // of such differences of colour, not brightness, that both sides have
constexpr double rest = 2.5e-3;        // pull towards the cheeks' tone, per neighbour's: fades over some 40 mm
constexpr float least_albedo = 1e-3f;

using Logarithms = std::vector<std::array<double, 3>>;

// x of the outline of cheek and jaw at a height; points first .. first + 8 go down one side, or up.
float outline_x(const Rig& person, std::size_t first, float y) {
  const auto mark = [&](std::size_t i) { return person.neutral.points_mm[person.landmarks68[i]]; };
  for (std::size_t i = first; i < first + 8; ++i) {
    const Vec3f a = mark(i), b = mark(i + 1);
    if ((a[1] > y) == (b[1] > y)) continue;
    return a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]);
  }
  return mark(first == 0 ? 0 : 16)[0];
}

// Height of the brows at a place; beside their ends it falls as steeply as it goes outwards.
float brow_y(const Rig& person, float x) {
  const auto mark = [&](std::size_t i) { return person.neutral.points_mm[person.landmarks68[i]]; };
  if (x < mark(17)[0]) return mark(17)[1] - (mark(17)[0] - x);
  if (x > mark(26)[0]) return mark(26)[1] - (x - mark(26)[0]);
  for (std::size_t i = 17; i < 26; ++i) {
    const Vec3f a = mark(i), b = mark(i + 1);
    if (x >= a[0] && x <= b[0] && b[0] > a[0]) return a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]);
  }
  return mark(19)[1];
}

// 1 where hair or a collar may hide the skin. V.
std::vector<float> may_be_hidden(const Rig& person, bool has_beard) {
  const std::vector<Vec3f>& points = person.neutral.points_mm;
  std::vector<float> share(points.size(), 0.0f);
  const float right = points[person.landmarks68[17]][0], left = points[person.landmarks68[26]][0];
  const float eyes = points[person.landmarks68[36]][1], tip = points[person.landmarks68[8]][1];
  const float chin = tip - (has_beard ? below_beard_mm : below_chin_mm);
  const float ears = 0.5f * (points[person.landmarks68[1]][2] + points[person.landmarks68[15]][2]);
  for (std::size_t v = 0; v < points.size(); ++v) {
    const float x = points[v][0], y = points[v][1];
    const float up = y > eyes ? (y - brow_y(person, x) - above_brows_mm) / fade_mm : 0;
    // From the ends of the brows the limits go over to the sides of the cheeks.
    const float t = std::clamp((eyes - y) / cheek_fade_mm, 0.0f, 1.0f);
    const float right_limit = right + t * (outline_x(person, 0, y) + cheek_hair_mm - right);
    const float left_limit = left + t * (outline_x(person, 8, y) - cheek_hair_mm - left);
    float out = std::max(right_limit - x, x - left_limit) / fade_mm;
    if (y < tip || (has_beard && y < eyes)) out = 0;
    const float down = (chin - y) / fade_mm;
    const float back = (ears - points[v][2]) / fade_mm;
    share[v] = std::clamp(std::max({up, out, down, back}), 0.0f, 1.0f);
  }
  return share;
}

float distance_to_segment(const Vec3f& point, const Vec3f& a, const Vec3f& b) {
  float along = 0, length = 0, squares = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    along += (point[k] - a[k]) * (b[k] - a[k]);
    length += (b[k] - a[k]) * (b[k] - a[k]);
  }
  const float t = length > 0 ? std::clamp(along / length, 0.0f, 1.0f) : 0.0f;
  for (std::size_t k = 0; k < 3; ++k) squares += std::pow(point[k] - a[k] - t * (b[k] - a[k]), 2.0f);
  return std::sqrt(squares);
}

// Whether a place differs from skin by itself: brows, eyes, nose and mouth.
bool has_own_colour(const Rig& person, const Vec3f& point) {
  const auto mark = [&](std::size_t i) { return person.neutral.points_mm[person.landmarks68[i]]; };
  const auto along = [&](std::size_t from, std::size_t to, float reach_mm) {
    for (std::size_t i = from; i < to; ++i)
      if (distance_to_segment(point, mark(i), mark(i + 1)) < reach_mm) return true;
    return false;
  };
  return along(17, 18, tail_mm) || along(18, 21, brow_mm) || along(22, 25, brow_mm) || along(25, 26, tail_mm) ||
         along(36, 41, eye_mm) || along(42, 47, eye_mm) || along(27, 35, nose_mm) || along(48, 59, lips_mm);
}

double size_of(const std::array<double, 3>& difference) {
  double squares = 0;
  for (const double value : difference) squares += value * value / 3;
  return std::sqrt(squares);
}

std::array<double, 3> apart(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// 0 well below the limit, 1 well above it.
double beyond(double value, double limit) {
  const double odd = std::pow(value / limit, 6);
  return odd / (1 + odd);
}

// Whether the chin is darker than the cheeks: stubble or a beard, whose sides are no hair that hangs over cheeks.
bool is_bearded(const Rig& person, const SeenSkin& seen, const Logarithms& differences) {
  const Vec3f chin = person.neutral.points_mm[person.landmarks68[8]];
  const Vec3f lip = person.neutral.points_mm[person.landmarks68[57]];
  std::vector<double> darker;
  for (std::size_t v = 0; v < seen.colour.size(); ++v) {
    const Vec3f& p = person.neutral.points_mm[v];
    if (seen.colour[v][0] <= 0 || std::abs(p[0] - chin[0]) > 25 || p[1] > lip[1] - 6 || p[1] < chin[1]) continue;
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum -= model::luma[c] * differences[v][c];
    darker.push_back(sum);
  }
  return median(darker) > beard_darker;
}

// Means over what is beside every vertex, so often that it is `reach_mm` wide.
Logarithms spread_out(const Neighbours& beside, const std::vector<double>& weight, double reach_mm, Logarithms values) {
  const int rounds = std::max(1, static_cast<int>(std::lround(std::pow(reach_mm / (0.7 * beside_mm), 2))));
  for (int round = 0; round < rounds; ++round) {
    Logarithms next = values;
    for (std::size_t v = 0; v < values.size(); ++v) {
      std::array<double, 3> sum{};
      double all = 0;
      for (const std::uint32_t w : beside.of(v)) {
        all += weight[w];
        for (std::size_t c = 0; c < 3; ++c) sum[c] += weight[w] * values[w][c];
      }
      for (std::size_t c = 0; c < 3 && all > 0; ++c) next[v][c] = sum[c] / all;
    }
    values = std::move(next);
  }
  return values;
}

template <class Left>
Neighbours without(const Neighbours& all, Left is_left_out) {
  Neighbours result;
  result.starts.push_back(0);
  for (std::size_t v = 0; v + 1 < all.starts.size(); ++v) {
    for (const std::uint32_t w : all.of(v))
      if (!is_left_out(w)) result.vertices.push_back(w);
    result.starts.push_back(static_cast<std::uint32_t>(result.vertices.size()));
  }
  return result;
}

}  // namespace

std::array<double, 3> tone_of(const std::vector<Vec3f>& colours, const std::vector<Vec3f>& own,
                              const std::vector<float>& cheeks) {
  std::array<double, 3> tone = {1, 1, 1};
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> ratios;
    for (std::size_t v = 0; v < colours.size(); ++v)
      if (colours[v][0] > 0 && cheeks[v] >= 0.5f)
        ratios.push_back(std::log(static_cast<double>(std::max(colours[v][c], least_albedo)) /
                                  static_cast<double>(std::max(own[v][c], least_albedo))));
    if (!ratios.empty()) tone[c] = std::exp(median(ratios));
  }
  return tone;
}

std::vector<Vec3f> uncover_skin(const MorphableModel& model, const Rig& person, const SeenSkin& seen,
                                double hair_contrast) {
  const std::size_t count = seen.colour.size();
  if (person.landmarks68.size() != 68 || hair_contrast <= 0) return seen.colour;
  const std::array<double, 3> tone = tone_of(seen.colour, model.mean_albedo, drawn_share(person));
  std::vector<bool> skin(count);
  std::vector<double> weight(count, 0.0);
  Logarithms difference(count);
  for (std::size_t v = 0; v < count; ++v) {
    skin[v] = seen.colour[v][0] > 0;
    weight[v] = skin[v] ? 0.05 + static_cast<double>(seen.sure[v]) : 0;
    for (std::size_t c = 0; c < 3 && skin[v]; ++c)
      difference[v][c] = std::log(static_cast<double>(std::max(seen.colour[v][c], least_albedo)) /
                                  (tone[c] * static_cast<double>(std::max(model.mean_albedo[v][c], least_albedo))));
  }
  const Neighbours beside = vertices_within(model.mean.points_mm, skin, beside_mm);
  const std::vector<std::int32_t> mirrored = mirrored_vertices(model.mean.points_mm, skin);
  const Logarithms smooth = spread_out(beside, weight, beside_mm, difference);

  const bool has_beard = is_bearded(person, seen, difference);
  std::vector<bool> own_colour(count);
  for (std::size_t v = 0; v < count; ++v)
    own_colour[v] = skin[v] && has_own_colour(person, person.neutral.points_mm[v]);
  const std::vector<float> possible = may_be_hidden(person, has_beard);
  const float eyes = person.neutral.points_mm[person.landmarks68[36]][1];
  const auto may_be_beard = [&](std::size_t v) { return has_beard && person.neutral.points_mm[v][1] < eyes; };
  std::vector<double> hidden(count, 0.0);
  for (std::size_t v = 0; v < count; ++v) {
    if (!skin[v]) continue;
    const double off = std::max(size_of(smooth[v]), size_of(difference[v]));
    if (own_colour[v]) continue;
    hidden[v] = static_cast<double>(possible[v]) * beyond(off, hair_contrast);
    if (mirrored[v] < 0 || may_be_beard(v)) continue;
    const auto m = static_cast<std::size_t>(mirrored[v]);
    if (size_of(smooth[v]) > size_of(smooth[m]))
      hidden[v] = std::max(hidden[v], beyond(size_of(apart(smooth[v], smooth[m])), one_sided));
  }
  // Strands reach farther in than hair is looked for: they are followed.
  const Neighbours edges = mesh_neighbours(model.mean, skin);
  std::vector<std::uint32_t> strands;
  for (std::size_t v = 0; v < count; ++v)
    if (hidden[v] > 0.5) strands.push_back(static_cast<std::uint32_t>(v));
  for (std::size_t next = 0; next < strands.size(); ++next)
    for (const std::uint32_t w : edges.of(strands[next])) {
      const double too = beyond(size_of(smooth[w]), hair_contrast);
      if (hidden[w] > 0.5 || too <= 0.5 || own_colour[w] || may_be_beard(w)) continue;
      hidden[w] = too;
      strands.push_back(w);
    }
  for (int round = 0; round < 2; ++round) {
    std::vector<double> wider = hidden;
    for (std::size_t v = 0; v < count; ++v)
      for (const std::uint32_t w : beside.of(v))
        if (!own_colour[v]) wider[v] = std::max(wider[v], hidden[w]);
    hidden = std::move(wider);
  }
  std::vector<double> shown(count, 0.0);
  for (std::size_t v = 0; v < count; ++v)
    if (skin[v]) shown[v] = std::pow(1 - hidden[v], 4) * static_cast<double>(seen.sure[v]);

  // What is hidden goes on from what is shown (a harmonic function), the other side counting too.
  HarmonicFill fill;
  fill.value = difference;
  fill.held.assign(count, 0.0);
  for (std::size_t v = 0; v < count; ++v) {
    if (!skin[v]) continue;
    const double other = mirrored[v] < 0 ? 0.0 : other_side * shown[static_cast<std::size_t>(mirrored[v])];
    const double all = shown[v] + (1 - shown[v]) * other;
    if (all <= 0) continue;
    for (std::size_t c = 0; c < 3 && mirrored[v] >= 0; ++c)
      fill.value[v][c] = (shown[v] * difference[v][c] +
                          (1 - shown[v]) * other * difference[static_cast<std::size_t>(mirrored[v])][c]) /
                         all;
    fill.held[v] = all;
  }
  // Brows, lids and lips are no skin that could go on.
  const Neighbours sources =
      without(edges, [&](std::uint32_t w) { return fill.held[w] > 0.05 && size_of(smooth[w]) > hair_contrast; });
  fill_harmonically(sources, rest, fill);

  const Logarithms wide = spread_out(beside, std::vector<double>(count, 1.0), light_reach_mm, fill.value);
  std::vector<double> bright(count, 0.0);
  for (std::size_t v = 0; v < count; ++v)
    for (std::size_t c = 0; c < 3; ++c) {
      const double other = wide[mirrored[v] >= 0 ? static_cast<std::size_t>(mirrored[v]) : v][c];
      bright[v] += model::luma[c] * 0.5 * (wide[v][c] + other);
    }
  std::vector<Vec3f> result(count, Vec3f{0, 0, 0});
  for (std::size_t v = 0; v < count; ++v)
    for (std::size_t c = 0; c < 3 && skin[v]; ++c) {
      double value = fill.value[v][c], both = wide[v][c];
      if (mirrored[v] >= 0) {
        both = 0.5 * (wide[v][c] + wide[static_cast<std::size_t>(mirrored[v])][c]);
        value -= lights_share * (wide[v][c] - both);
      }
      value -= colours_share * (both - bright[v]);
      result[v][c] = static_cast<float>(tone[c] * static_cast<double>(std::max(model.mean_albedo[v][c], least_albedo)) *
                                        std::exp(value));
    }
  return result;
}

}  // namespace face::texture
