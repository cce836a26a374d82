// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/plane.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/base/keys_cubic.h"

namespace face::flow {
namespace {

constexpr std::array<float, 5> kernel = {0.0625f, 0.25f, 0.375f, 0.25f, 0.0625f};

// Every second pixel of the plane, filtered. Outside counts as 0: the share is filtered alike.
Plane reduced(const Plane& in) {
  const int width = (in.width + 1) / 2, height = (in.height + 1) / 2;
  Plane rows(width, in.height), out(width, height);
  for (int y = 0; y < in.height; ++y) {
    const float* source = in.row(y);
    float* target = rows.row(y);
    for (int x = 0; x < width; ++x) {
      float sum = 0;
      for (int k = -2; k <= 2; ++k) {
        const int at = 2 * x + k;
        if (at >= 0 && at < in.width) sum += kernel[static_cast<std::size_t>(k + 2)] * source[at];
      }
      target[x] = sum;
    }
  }
  for (int y = 0; y < height; ++y)
    for (int k = -2; k <= 2; ++k) {
      const int at = 2 * y + k;
      if (at < 0 || at >= in.height) continue;
      const float weight = kernel[static_cast<std::size_t>(k + 2)];
      const float* source = rows.row(at);
      float* target = out.row(y);
      for (int x = 0; x < width; ++x) target[x] += weight * source[x];
    }
  return out;
}

Level reduced(const Level& level) {
  Level out;
  const Plane share = reduced(level.share);
  out.share = Plane(share.width, share.height);
  for (std::size_t i = 0; i < share.values.size(); ++i) out.share.values[i] = share.values[i] > 0.5f ? 1.0f : 0.0f;
  for (const Plane& channel : level.channels) {
    Plane weighted = channel;
    for (std::size_t i = 0; i < weighted.values.size(); ++i) weighted.values[i] *= level.share.values[i];
    Plane small = reduced(weighted);
    for (std::size_t i = 0; i < small.values.size(); ++i)
      small.values[i] = out.share.values[i] > 0 ? small.values[i] / share.values[i] : 0;
    out.channels.push_back(std::move(small));
  }
  return out;
}

// 1 where the 4 x 4 pixels from one up and left to two down and right are measured.
std::vector<std::uint8_t> within_measured(const Plane& share) {
  const int width = share.width, height = share.height;
  std::vector<std::uint8_t> within(share.values.size(), 0), across = within;
  const auto at = [&](int y) { return static_cast<std::size_t>(y) * static_cast<std::size_t>(width); };
  for (int y = 0; y < height; ++y) {
    const float* s = share.row(y);
    std::uint8_t* out = across.data() + at(y);
    for (int x = 1; x + 2 < width; ++x) out[x] = s[x - 1] * s[x] * s[x + 1] * s[x + 2] > 0 ? 1 : 0;
  }
  for (int y = 1; y + 2 < height; ++y) {
    const std::uint8_t *a = across.data() + at(y - 1), *b = across.data() + at(y), *c = across.data() + at(y + 1),
                       *d = across.data() + at(y + 2);
    std::uint8_t* out = within.data() + at(y);
    for (int x = 0; x < width; ++x) out[x] = a[x] & b[x] & c[x] & d[x];
  }
  return within;
}

// Between the pixel at p, its right and lower neighbours.
float cubic_at(const float* p, int width, float fx, float fy) {
  const std::array<float, 4> wx = keys_weights(fx), wy = keys_weights(fy);
  float sum = 0;
  for (int j = 0; j < 4; ++j) {
    const float* row = p + (j - 1) * width - 1;
    sum += wy[static_cast<std::size_t>(j)] * (wx[0] * row[0] + wx[1] * row[1] + wx[2] * row[2] + wx[3] * row[3]);
  }
  return sum;
}

}  // namespace

Level level_of(const FeatureMap& map) {
  Level level;
  level.share = Plane(map.width, map.height);
  const std::size_t count = level.share.values.size();
  for (std::size_t i = 0; i < count; ++i) level.share.values[i] = map.valid[i] ? 1.0f : 0.0f;
  for (std::size_t c = 0; c < map.names.size(); ++c) {
    Plane plane(map.width, map.height);
    for (std::size_t i = 0; i < count; ++i) plane.values[i] = map.valid[i] ? map.values[c * count + i] : 0;
    level.channels.push_back(std::move(plane));
  }
  return level;
}

std::vector<Level> pyramid_of(const FeatureMap& map, int levels) {
  std::vector<Level> pyramid = {level_of(map)};
  while (static_cast<int>(pyramid.size()) < levels &&
         std::min(pyramid.back().share.width, pyramid.back().share.height) >= 32)
    pyramid.push_back(reduced(pyramid.back()));
  return pyramid;
}

void box_mean(Plane& plane, int radius) {
  if (radius == 0) return;
  const int width = plane.width, height = plane.height;
  const float scale = 1.0f / static_cast<float>((2 * radius + 1) * (2 * radius + 1));
  // Rows of horizontal sums, kept until they leave the window; sums are made anew for each pixel, so that rounding does
  // not travel.
  std::vector<float> padded(static_cast<std::size_t>(width + 2 * radius), 0.0f);
  Plane sums(width, height);
  for (int y = 0; y < height; ++y) {
    std::copy(plane.row(y), plane.row(y) + width, padded.begin() + radius);
    float* target = sums.row(y);
    for (int x = 0; x < width; ++x) target[x] = padded[static_cast<std::size_t>(x)];
    for (int k = 1; k <= 2 * radius; ++k) {
      const float* source = padded.data() + k;
      for (int x = 0; x < width; ++x) target[x] += source[x];
    }
  }
  for (int y = 0; y < height; ++y) {
    float* target = plane.row(y);
    std::fill(target, target + width, 0.0f);
    for (int k = std::max(y - radius, 0); k <= std::min(y + radius, height - 1); ++k) {
      const float* source = sums.row(k);
      for (int x = 0; x < width; ++x) target[x] += source[x];
    }
    for (int x = 0; x < width; ++x) target[x] *= scale;
  }
}

void warp(const Level& level, const Plane& u, const Plane& v, Level& warped, Between between) {
  const int width = level.share.width, height = level.share.height;
  if (warped.channels.size() != level.channels.size() || warped.share.width != width || warped.share.height != height) {
    warped.channels.assign(level.channels.size(), Plane(width, height));
    warped.share = Plane(width, height);
  }
  const float* share = level.share.values.data();
  const std::vector<std::uint8_t> within =
      between == Between::cubic ? within_measured(level.share) : std::vector<std::uint8_t>();
  const float right = static_cast<float>(width - 1), bottom = static_cast<float>(height - 1);
  std::vector<std::int32_t> index(static_cast<std::size_t>(width));
  std::vector<float> fx(index.size()), fy(index.size()), ok(index.size());
  for (int y = 0; y < height; ++y) {
    const float *du = u.row(y), *dv = v.row(y);
    for (int x = 0; x < width; ++x) {
      const float px = static_cast<float>(x) + du[x], py = static_cast<float>(y) + dv[x];
      const auto n = static_cast<std::size_t>(x);
      // In this order a displacement that is not a number lands at 0.
      const float cx = std::min(std::max(0.0f, px), right - 0.001f), cy = std::min(std::max(0.0f, py), bottom - 0.001f);
      const int ix = static_cast<int>(cx), iy = static_cast<int>(cy);
      index[n] = iy * width + ix;
      fx[n] = cx - static_cast<float>(ix);
      fy[n] = cy - static_cast<float>(iy);
      const bool inside = px >= 0 && py >= 0 && px <= right && py <= bottom;
      const float* s = share + index[n];
      ok[n] = inside && s[0] > 0 && s[1] > 0 && s[width] > 0 && s[width + 1] > 0 ? 1.0f : 0.0f;
    }
    std::copy(ok.begin(), ok.end(), warped.share.row(y));
    for (std::size_t c = 0; c < level.channels.size(); ++c) {
      const float* source = level.channels[c].values.data();
      float* target = warped.channels[c].row(y);
      for (std::size_t n = 0; n < index.size(); ++n) {
        const float* p = source + index[n];
        if (!within.empty() && within[static_cast<std::size_t>(index[n])]) {
          target[n] = cubic_at(p, width, fx[n], fy[n]);
          continue;
        }
        const float above = p[0] + fx[n] * (p[1] - p[0]), below = p[width] + fx[n] * (p[width + 1] - p[width]);
        target[n] = above + fy[n] * (below - above);
      }
    }
  }
}

Plane finer(const Plane& plane, int width, int height, float scale) {
  Plane out(width, height);
  for (int y = 0; y < height; ++y) {
    const int y0 = std::min(y / 2, plane.height - 1), y1 = std::min((y + 1) / 2, plane.height - 1);
    const float *above = plane.row(y0), *below = plane.row(y1);
    for (int x = 0; x < width; ++x) {
      const int x0 = std::min(x / 2, plane.width - 1), x1 = std::min((x + 1) / 2, plane.width - 1);
      out.row(y)[x] = scale * 0.25f * (above[x0] + above[x1] + below[x0] + below[x1]);
    }
  }
  return out;
}

Plane coarser(const Plane& plane, float scale) {
  Plane ones(plane.width, plane.height, 1);
  Plane out = reduced(plane);
  const Plane weight = reduced(ones);
  for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] *= scale / weight.values[i];
  return out;
}

void check_pair(const FeatureMap& reference, const FeatureMap& target, const FlowField* start) {
  for (const FeatureMap* map : {&reference, &target}) {
    const char* name = map == &reference ? "reference" : "target";
    check(map->width > 1 && map->height > 1, name, " is ", map->width, " x ", map->height,
          " pixels, expected at least 2 x 2");
    const std::size_t count = static_cast<std::size_t>(map->width) * static_cast<std::size_t>(map->height);
    check(!map->names.empty(), name, " has no channel");
    check(map->values.size() == count * map->names.size(), name, " has ", map->values.size(), " values, expected ",
          map->names.size(), " x ", map->height, " x ", map->width);
    check(map->valid.size() == count, name, " has ", map->valid.size(), " valid flags, expected ", map->height, " x ",
          map->width);
  }
  check(reference.width == target.width && reference.height == target.height, "target is ", target.width, " x ",
        target.height, " pixels, reference ", reference.width, " x ", reference.height);
  check(reference.names == target.names, "target and reference have different channels");
  if (!start) return;
  check(start->width == reference.width && start->height == reference.height, "start is ", start->width, " x ",
        start->height, " pixels, reference ", reference.width, " x ", reference.height);
}

void start_planes(const FlowField* start, int width, int height, Plane& u, Plane& v) {
  u = Plane(width, height);
  v = Plane(width, height);
  if (!start) return;
  Level level;
  level.channels = {u, v};
  level.share = u;
  for (std::size_t i = 0; i < start->valid.size(); ++i) {
    if (!start->valid[i]) continue;
    level.share.values[i] = 1;
    level.channels[0].values[i] = start->displacement_px[i][0];
    level.channels[1].values[i] = start->displacement_px[i][1];
  }
  // Holes take the value of the finest coarser level that has one.
  std::vector<Level> levels = {level};
  while (std::min(levels.back().share.width, levels.back().share.height) >= 4) {
    const Level& fine = levels.back();
    Level coarse;
    const Plane share = reduced(fine.share);
    coarse.share = share;
    for (float& s : coarse.share.values) s = s > 0 ? 1.0f : 0.0f;
    for (const Plane& channel : fine.channels) {
      Plane small = reduced(channel);
      for (std::size_t i = 0; i < small.values.size(); ++i)
        if (share.values[i] > 0) small.values[i] /= share.values[i];
      coarse.channels.push_back(std::move(small));
    }
    levels.push_back(std::move(coarse));
  }
  for (std::size_t l = levels.size() - 1; l-- > 0;)
    for (std::size_t c = 0; c < 2; ++c) {
      const Plane filled = finer(levels[l + 1].channels[c], levels[l].share.width, levels[l].share.height, 1);
      for (std::size_t i = 0; i < filled.values.size(); ++i)
        if (levels[l].share.values[i] == 0) levels[l].channels[c].values[i] = filled.values[i];
    }
  u = levels[0].channels[0];
  v = levels[0].channels[1];
}

FlowField field_of(const FeatureMap& reference, const FeatureMap& target, const Plane& u, const Plane& v) {
  const Level level{{}, level_of(target).share};
  Level warped;
  warp(level, u, v, warped);
  FlowField field{reference.width, reference.height, {}, {}};
  const std::size_t count = u.values.size();
  field.displacement_px.resize(count);
  field.valid.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    field.displacement_px[i] = {u.values[i], v.values[i]};
    field.valid[i] = reference.valid[i] && warped.share.values[i] > 0 ? 1 : 0;
  }
  return field;
}

}  // namespace face::flow
