// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/inner_lips.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/find_landmark.h"
#include "nodes/track/head_motion.h"
#include "nodes/track/lip_line.h"
#include "nodes/track/lip_redness.h"
#include "nodes/track/solid_head.h"

namespace face::track {
namespace {

constexpr int samples = lip_line_samples;
constexpr double band_from = 0.06, band_to = 0.2;  // of it, from each end: surely lip
constexpr double edge = 0.1;                       // of it, at each end: never the mouth's hollow
// Of a lip's colour in a film of usual contrast: light, grain, coding.
constexpr std::array<double, 3> least_deviation{0.12, 0.12, 0.18};
constexpr double most_unlike = 8;  // a reflex on a tooth is not more than a tooth
constexpr double most_like = 0.3;  // what is like a lip hardly counts: the tongue is, between teeth and lower lip

using Colour = LipColour;

// Mean and deviation of a lip's colours.
struct LipLook {
  Colour mean{}, deviation{};

  double unlike(const Colour& colour) const {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += std::pow((colour[c] - mean[c]) / deviation[c], 2);
    return std::sqrt(sum);
  }
};

LipLook look_of(const std::vector<Colour>& colours, double from, double to, const Colour& contrast) {
  LipLook look;
  Colour square{};
  double count = 0;
  for (int i = static_cast<int>(from * samples); i < static_cast<int>(to * samples); ++i, ++count)
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = colours[static_cast<std::size_t>(i)][c];
      look.mean[c] += value;
      square[c] += value * value;
    }
  for (std::size_t c = 0; c < 3; ++c) {
    look.mean[c] /= count;
    look.deviation[c] = std::hypot(contrast[c] * least_deviation[c],
                                   std::sqrt(std::max(0.0, square[c] / count - look.mean[c] * look.mean[c])));
  }
  return look;
}

// Luma as a multiple of the lips', so that the light does not count.
void scale_luma(std::vector<Colour>& colours) {
  const double lips = (look_of(colours, band_from, band_to, {1, 1, 1}).mean[2] +
                       look_of(colours, 1 - band_to, 1 - band_from, {1, 1, 1}).mean[2]) /
                      2;
  for (Colour& colour : colours) colour[2] /= std::max(lips, 0.02);
}

struct Gap {
  double from = 0, to = 0;  // along the line, 0 to 1
};

// The lips' thickness as shares of a line.
struct Thickness {
  double upper = 0, lower = 0;
};

// How far every sample of a line is from the lips, beyond `unlike`; much less than 0 at its ends. What is as red as a
// lip is one, in the shade or under a reflex.
std::vector<double> excess_along(std::vector<Colour> colours, const Colour& contrast, double unlike) {
  constexpr double lip_pale = 0.1, other_pale = 0.3;  // of lip_redness.h: up to this a lip, and from this on none
  const LipRedness redness = lip_redness(colours);
  scale_luma(colours);
  const LipLook upper = look_of(colours, band_from, band_to, contrast),
                lower = look_of(colours, 1 - band_to, 1 - band_from, contrast);
  std::vector<double> excess;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const double pale = std::clamp((redness.pale[i] - lip_pale) / (other_pale - lip_pale), 0.0, 1.0);
    const double counts = 1 - redness.trust * (1 - pale);
    const double value = counts * std::min({upper.unlike(colours[i]), lower.unlike(colours[i]), most_unlike}) - unlike;
    const double v = place_on_line(i);
    excess.push_back(v < edge || v > 1 - edge ? -most_unlike : std::max(value, -most_like));
  }
  return excess;
}

// The most likely gap where the lips' thickness is known: teeth and hollow are unlike the lips, tongue and gums are
// not, but a lip is about as thick as expected.
Gap likely_gap(const std::vector<Colour>& colours, const Colour& contrast, const Thickness& expected,
               const InnerLipsOptions& options) {
  const std::vector<double> excess = excess_along(colours, contrast, options.unlike);
  std::vector<double> sum = {0};
  for (const double e : excess) sum.push_back(sum.back() + e * options.evidence / samples);
  const auto cost = [&](double thickness, double usual) {
    const double off = (thickness - usual) / (options.thickness_deviation * usual);
    return off * off / 2;
  };
  Gap gap;
  double best = std::numeric_limits<double>::lowest();
  for (int from = 1; from < samples; ++from)
    for (int to = from; to < samples; ++to) {
      const double u = from / double(samples), l = 1 - to / double(samples);
      const double score = sum[static_cast<std::size_t>(to)] - sum[static_cast<std::size_t>(from)] -
                           cost(u, expected.upper) - cost(l, expected.lower);
      if (score > best) best = score, gap = {u, 1 - l};
    }
  return gap;
}

Gap find_gap(const std::vector<Colour>& colours, const Colour& contrast, double unlike) {
  const std::vector<double> excess = excess_along(colours, contrast, unlike);
  double best = 0, sum = 0;
  int begin = 0, best_begin = -1, best_end = -1;
  for (int i = 0; i < samples; ++i) {
    if (sum <= 0) sum = 0, begin = i;
    sum += excess[static_cast<std::size_t>(i)];
    if (sum > best) best = sum, best_begin = begin, best_end = i;
  }
  if (best_begin < 0) {
    int darkest = samples / 2;
    for (int i = static_cast<int>(band_to * samples); i < static_cast<int>((1 - band_to) * samples); ++i)
      if (colours[static_cast<std::size_t>(i)][2] < colours[static_cast<std::size_t>(darkest)][2]) darkest = i;
    const double v = (darkest + 0.5) / samples;
    return {v, v};
  }
  // Between the samples on either side of an end, where the excess is 0.
  const auto crossing = [&](int in, int out) {
    if (out < 0 || out >= samples) return (in + 0.5) / samples;
    const double a = excess[static_cast<std::size_t>(in)], b = excess[static_cast<std::size_t>(out)];
    const double t = a > b ? std::clamp(a / (a - b), 0.0, 1.0) : 0.0;
    return (in + 0.5 + t * (out - in)) / samples;
  };
  return {crossing(best_begin, best_begin - 1), crossing(best_end, best_end + 1)};
}

// How much larger the head is in a picture than in that of the mouth at rest, by points that do not move; 1 without.
double scale_of(const Landmarks& landmarks, const Landmarks& rest) {
  double here = 0, there = 0;
  for (const auto& [one, other] :
       {std::pair{"eye_inner_r", "eye_inner_l"}, {"eye_inner_r", "nose_tip"}, {"eye_inner_l", "nose_tip"}}) {
    const Landmark *const a = find_landmark(landmarks, one), *const b = find_landmark(landmarks, other),
                          *const c = find_landmark(rest, one), *const d = find_landmark(rest, other);
    if (!a || !b || !c || !d || !a->valid || !b->valid) continue;
    here += distance_px(*a, *b);
    there += distance_px(*c, *d);
  }
  return here > 0 && there > 0 ? here / there : 1;
}

// What is known of the mouth at rest; without depths or head not how a head that has turned shows it.
struct RestLook {
  const Landmarks* points = nullptr;
  const Matrix *depths_px = nullptr, *head = nullptr;
};

// The mouth at rest, in the pose of this frame where that is known.
struct RestMouth {
  Landmarks points;
  double scale = 1;  // that it is seen at
};

RestMouth rest_mouth(const Landmarks& landmarks, const RestLook& rest) {
  const Landmarks& points = *rest.points;
  if (rest.depths_px == nullptr || rest.head == nullptr || rest.head->values.empty())
    return {points, scale_of(landmarks, points)};
  const HeadSight sight = head_sight(*rest.head);
  if (sight.likeness < head_is_seen) return {points, scale_of(landmarks, points)};
  const Matrix& depths_px = *rest.depths_px;
  check(depths_px.rows == points.points.size() && depths_px.values.size() == points.points.size(), "depths_px is ",
        depths_px.rows, " x ", depths_px.columns, ", expected ", points.points.size(), " x 1 as rest has points");
  RestMouth mouth{points};
  const SolidHead head = solid_head(sight.pose, {0, 0, 0});
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    Landmark& point = mouth.points.points[i];
    const std::complex<double> seen = head.seen({point.x_px, point.y_px}, depths_px.values[i]);
    point.x_px = seen.real(), point.y_px = seen.imag();
  }
  return mouth;
}

// How many times as wide the mouth at rest is on the head; 1 where it does not say.
double narrowing(const RestMouth& rest, const MouthWidth& width) {
  constexpr double most = 2;  // beyond, a corner is lost
  const Landmark *const right = find_landmark(rest.points, "lip_0"), *const left = find_landmark(rest.points, "lip_6");
  if (!right || !left || width.length_px() <= 0) return 1;
  return std::clamp(rest.scale * distance_px(*right, *left) / width.length_px(), 1 / most, most);
}

// Of the line of inner_lip_1, _2 or _3 as thick as at rest, but for the mouth's width; none where rest does not say.
std::optional<Thickness> expected_thickness(const RestMouth& rest, const LipLine& line, std::size_t number,
                                            const MouthWidth& width, double thickening) {
  const Landmark *const upper = find_landmark(rest.points, line.upper->name),
                        *const lower = find_landmark(rest.points, line.lower->name),
                        *const above = find_landmark(rest.points, "inner_lip_" + std::to_string(number)),
                        *const below = find_landmark(rest.points, "inner_lip_" + std::to_string(8 - number));
  const double length = distance_px(*line.upper, *line.lower);
  if (!upper || !lower || !above || !below || length <= 0) return std::nullopt;
  const double share = rest.scale / length * std::pow(narrowing(rest, width), thickening);
  const Thickness result{share * distance_px(*upper, *above), share * distance_px(*below, *lower)};
  if (result.upper <= 0 || result.lower <= 0) return std::nullopt;
  return result;
}

Colour contrast_of(const Matrix& numbers) {
  check(numbers.rows == 1 && numbers.columns == 3 && numbers.values.size() == 3, "contrast is ", numbers.rows, " x ",
        numbers.columns, ", expected 1 x 3 as lip_colours gives it");
  for (const double value : numbers.values)
    check(std::isfinite(value) && value > 0, "contrast has ", value, ", expected numbers above 0");
  return {numbers.values[0], numbers.values[1], numbers.values[2]};
}

}  // namespace

Landmarks inner_lips(const Matrix& colours, const Matrix& contrast, const Landmarks& landmarks, const Landmarks* rest,
                     const Matrix* depths_px, const Matrix* head, const InnerLipsOptions& options) {
  for (const Landmark& point : landmarks.points)
    check(!point.name.starts_with("inner_lip_"), "there is a landmark ", point.name, " already");
  const MouthWidth width = mouth_width(landmarks);
  std::vector<LipLine> lines;
  for (int line = 1; line <= lip_lines; ++line) lines.push_back(lip_line(landmarks, line + 1));
  const Colour contrasts = contrast_of(contrast);
  std::optional<RestMouth> resting;
  if (rest) resting = rest_mouth(landmarks, {rest, depths_px, head});
  Landmarks out = landmarks;
  std::vector<Landmark> below;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const LipLine& line = lines[i];
    const std::optional<Thickness> expected =
        resting ? expected_thickness(*resting, line, i + 1, width, options.thickening) : std::nullopt;
    const std::vector<Colour> seen = colours_of_line(colours, static_cast<int>(i + 1));
    const Gap gap =
        expected ? likely_gap(seen, contrasts, *expected, options) : find_gap(seen, contrasts, options.unlike);
    const auto at = [&](double v, std::size_t number) {
      return Landmark{"inner_lip_" + std::to_string(number), (1 - v) * line.upper->x_px + v * line.lower->x_px,
                      (1 - v) * line.upper->y_px + v * line.lower->y_px, line.upper->valid && line.lower->valid};
    };
    out.points.push_back(at(gap.from, i + 1));
    below.push_back(at(gap.to, 7 - i));
  }
  out.points.insert(out.points.end(), below.begin(), below.end());
  return out;
}

}  // namespace face::track
