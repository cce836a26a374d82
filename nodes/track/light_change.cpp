// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/light_change.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/track/head_raster.h"

namespace face::track {
namespace {

using Place = std::complex<double>;

constexpr int stride = 2;                   // of the raster: some 200 places are enough for two numbers
constexpr int darkest = 4, lightest = 245;  // beyond, a level is clipped, or a part of its pixels is

// The mean about a place, over a square of this half width; the nearest pixels' outside the picture.
double level_at(const Image& image, Place place, int reach, int channel) {
  const int x = static_cast<int>(std::lround(place.real())), y = static_cast<int>(std::lround(place.imag()));
  double sum = 0;
  for (int v = y - reach; v <= y + reach; ++v)
    for (int u = x - reach; u <= x + reach; ++u) {
      const int row = std::clamp(v, 0, image.height - 1), column = std::clamp(u, 0, image.width - 1);
      sum += image.pixels[static_cast<std::size_t>((row * image.width + column) * image.channels + channel)];
    }
  return sum / ((2 * reach + 1) * (2 * reach + 1));
}

int reach_of(const RasterFrame& frame) {
  return std::max(0, static_cast<int>(std::lround(stride * raster_step * std::abs(frame.across) / 2)));
}

struct Pair {
  double now = 0, then = 0;
};

struct Line {
  double gain = 1, offset = 0;
};

// gain: what it is known to be, else 0.
Line line_through(const std::vector<Pair>& pairs, double known_gain) {
  constexpr double least_gain = 0.4, most_gain = 2.5;
  constexpr double even = 4;  // a deviation of levels that says nothing of the contrast
  const auto count = static_cast<double>(pairs.size());
  double now = 0, then = 0, now_square = 0, then_square = 0;
  for (const Pair& pair : pairs) now += pair.now / count, then += pair.then / count;
  for (const Pair& pair : pairs)
    now_square += std::pow(pair.now - now, 2) / count, then_square += std::pow(pair.then - then, 2) / count;
  const double gain = known_gain > 0 ? known_gain
                      : std::sqrt(std::min(now_square, then_square)) < even
                          ? 1
                          : std::clamp(std::sqrt(then_square / now_square), least_gain, most_gain);
  return {gain, then - gain * now};
}

// Without the pairs that are farthest from it: a shadow, hair, a reflex.
Line robust_line(std::vector<Pair> pairs, double known_gain = 0) {
  constexpr double kept = 0.8;
  constexpr int rounds = 3;
  const std::vector<Pair> all = pairs;
  Line line = line_through(pairs, known_gain);
  for (int round = 0; round < rounds; ++round) {
    const auto off = [&](const Pair& pair) { return std::abs(line.gain * pair.now + line.offset - pair.then); };
    pairs = all;
    const auto last = pairs.begin() + static_cast<std::ptrdiff_t>(kept * static_cast<double>(pairs.size()));
    std::nth_element(pairs.begin(), last, pairs.end(), [&](const Pair& a, const Pair& b) { return off(a) < off(b); });
    pairs.erase(last, pairs.end());
    line = line_through(pairs, known_gain);
  }
  return line;
}

std::vector<Knot> solid_knots(const RasterFrame& frame) {
  std::vector<Knot> knots = raster_knots(frame, stride);
  std::erase_if(knots, [](const Knot& knot) { return !knot.solid; });
  return knots;
}

}  // namespace

Image learn_light(const Image& image, const Landmarks& start) {
  const RasterFrame frame = raster_frame(start);
  if (!frame.valid) return {0, 0, 1, {}};
  const std::vector<Knot> knots = solid_knots(frame);
  Image learnt{static_cast<int>(knots.size()), 1, image.channels, {}};
  for (const Knot& knot : knots)
    for (int c = 0; c < image.channels; ++c)
      learnt.pixels.push_back(
          static_cast<std::uint8_t>(std::lround(level_at(image, frame.middle + knot.place_px, reach_of(frame), c))));
  return learnt;
}

LightChange see_light_change(const Image& image, const Landmarks& start, const SolidHead& head, const Image& learnt) {
  constexpr std::size_t least_pairs = 20;
  // Root mean square change of the levels up to which, and from which on, the light is another one.
  constexpr double same = 8, other = 16;
  const RasterFrame frame = raster_frame(start);
  if (!frame.valid || learnt.pixels.empty() || learnt.channels != image.channels) return {};
  const std::vector<Knot> knots = solid_knots(frame);
  const auto colours = static_cast<std::size_t>(std::min(image.channels, 3));
  std::vector<std::vector<Pair>> pairs(colours);
  std::vector<Line> lines(colours);
  double gain_sum = 0, gains = 0;
  // A colour that is clipped in much of the face hardly tells its own gain: what is left of it is the darkest.
  const auto tells_gain = [&](std::size_t c) { return 2 * pairs[c].size() >= knots.size(); };
  for (std::size_t c = 0; c < colours; ++c) {
    for (std::size_t i = 0; i < knots.size(); ++i) {
      const Place place = head.seen(frame.middle + knots[i].place_px, knots[i].depth_px);
      const Pair pair{level_at(image, place, reach_of(frame), static_cast<int>(c)),
                      static_cast<double>(learnt.pixels[i * static_cast<std::size_t>(learnt.channels) + c])};
      if (std::min(pair.now, pair.then) > darkest && std::max(pair.now, pair.then) < lightest) pairs[c].push_back(pair);
    }
    if (pairs[c].size() < least_pairs) return {};
    if (!tells_gain(c)) continue;
    lines[c] = robust_line(pairs[c]);
    gain_sum += lines[c].gain, ++gains;
  }
  LightChange light;
  double square = 0;
  for (std::size_t c = 0; c < colours; ++c) {
    if (!tells_gain(c)) lines[c] = robust_line(pairs[c], gains > 0 ? gain_sum / gains : 1);
    light.gain[c] = lines[c].gain, light.offset[c] = lines[c].offset;
    for (const Pair& pair : pairs[c])
      square += std::pow((lines[c].gain - 1) * pair.now + lines[c].offset, 2) /
                static_cast<double>(pairs[c].size() * colours);
  }
  const double share = std::clamp((std::sqrt(square) - same) / (other - same), 0.0, 1.0);
  if (share == 0) return {};
  for (std::size_t c = 0; c < 3; ++c) {
    light.gain[c] = 1 + share * (light.gain[c] - 1);
    light.offset[c] *= share;
  }
  return light;
}

Image relit(const Image& image, const LightChange& light) {
  if (light.is_same()) return image;
  Image out = image;
  std::array<std::array<std::uint8_t, 256>, 3> levels{};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t level = 0; level < 256; ++level)
      levels[c][level] = static_cast<std::uint8_t>(
          std::lround(std::clamp(light.gain[c] * static_cast<double>(level) + light.offset[c], 0.0, 255.0)));
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < out.pixels.size(); ++i)
    if (i % channels < 3) out.pixels[i] = levels[i % channels][out.pixels[i]];
  return out;
}

const Image& in_start_light(const Image& picture, const LightChange& light, Image& room) {
  if (light.is_same()) return picture;
  room = relit(picture, light);
  return room;
}

Matrix light_numbers(const LightChange& light) {
  const auto& [gain, offset] = light;
  return {3, 2, {gain[0], offset[0], gain[1], offset[1], gain[2], offset[2]}};
}

LightChange light_of(const Matrix& numbers) {
  if (numbers.rows == 0) return {};
  check(numbers.rows == 3 && numbers.columns == 2 && numbers.values.size() == 6, "light is ", numbers.rows, " x ",
        numbers.columns, ", expected 3 x 2 as track.klt gives it");
  LightChange light;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < 2; ++k)
      check(std::isfinite(numbers.at(c, k)), "light has ", numbers.at(c, k), ", expected finite numbers");
    light.gain[c] = numbers.at(c, 0), light.offset[c] = numbers.at(c, 1);
  }
  return light;
}

}  // namespace face::track
