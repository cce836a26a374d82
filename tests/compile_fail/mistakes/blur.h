// SPDX-License-Identifier: Apache-2.0
// A node's function without a mistake: what the declarations in this folder are wrong about.
#pragma once
#include <string>

#include "engine/port.h"

namespace mistakes {

enum class Edge { keep, fade };

struct BlurOptions {
  double radius_px = 2;
  bool fast = false;
  Edge edge = Edge::keep;
};
struct OtherOptions {
  double radius_px = 2;
};
struct BlurResult {
  double sharpness = 0;
  std::string report;
};
struct OtherResult {
  double sharpness = 0;
};

BlurResult blur(const std::string& image, const double* mask, const BlurOptions& options);
BlurResult blur_in_place(std::string& image, const BlurOptions& options);
BlurResult blur_by_value(std::string image, const BlurOptions& options);
double blur_and_stream(const std::string& image, engine::SeqWriter<double>& steps);
double without_options(const std::string& image);

}  // namespace mistakes
