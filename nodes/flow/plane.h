// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/types/feature_map.h"
#include "nodes/types/flow_field.h"

namespace face::flow {

// One number per pixel, rows from the top.
struct Plane {
  int width = 0;
  int height = 0;
  std::vector<float> values;  // height x width

  Plane() = default;
  Plane(int w, int h, float value = 0)
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}
  float* row(int y) { return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width); }
  const float* row(int y) const {
    return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
};

// Channels with the share of every pixel that is measured, 0 to 1. Values are 0 where the share is.
struct Level {
  std::vector<Plane> channels;
  Plane share;
};

// The finest level of a picture.
Level level_of(const FeatureMap& map);

// Gaussian pyramid (Burt and Adelson, The Laplacian Pyramid as a Compact Image Code, 1983: the 5-tap kernel with a =
// 0.375), finest level first. What is not measured has no weight (normalised convolution: Knutsson and Westin, CVPR
// 1993). Stops before a side is shorter than 16 pixels.
std::vector<Level> pyramid_of(const FeatureMap& map, int levels);

// Means over the (2 radius + 1)^2 pixels about each; outside the picture counts as 0.
void box_mean(Plane& plane, int radius);

enum class Between { linear, cubic };

// value(x + u, y + v) for every pixel, between pixels bilinear, or by the cubic of Keys (keys_cubic.h) where
// all of its 16 pixels are measured; share
// becomes 0 where a neighbour outside the picture or without measurement is needed by the bilinear one.
void warp(const Level& level, const Plane& u, const Plane& v, Level& warped, Between between = Between::linear);

// A level's plane on the next finer level of the given size, bilinear, times scale (2 for a displacement).
Plane finer(const Plane& plane, int width, int height, float scale);

// A plane on the next coarser level, times scale.
Plane coarser(const Plane& plane, float scale);

// Throws where two pictures cannot be compared: sizes, channels, sizes of their vectors.
void check_pair(const FeatureMap& reference, const FeatureMap& target, const FlowField* start);

// The displacement where the start is valid, spread by averages to where it is not; 0 without one.
void start_planes(const FlowField* start, int width, int height, Plane& u, Plane& v);

// The field of two planes: valid where the reference is measured and the place in the target, too.
FlowField field_of(const FeatureMap& reference, const FeatureMap& target, const Plane& u, const Plane& v);

}  // namespace face::flow
