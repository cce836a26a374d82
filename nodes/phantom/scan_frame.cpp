// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/scan_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/phantom/scanner_view.h"
#include "nodes/phantom/sensor_noise.h"
#include "nodes/phantom/sensor_picture.h"
#include "nodes/phantom/srgb_curve.h"

namespace face::phantom {
namespace {

// Depth over the five pictures at every pixel: what first and last show, where motion counts.
struct Motion {
  std::vector<float> first;  // 1 / depth, as of a raster; empty without motion
  std::vector<float> last;
};

}  // namespace

ScanFrameResult scan_frame(const Rig& rig, const engine::Window<Weights>& weights,
                           const engine::Window<RigidMotion>& world_from_head, const Camera& camera,
                           const Camera& projector, const SurfaceDots* dots, const VertexMask* lost,
                           const std::string* id, const ScanFrameOptions& options) {
  const PictureSize picture{options.width_px, options.height_px};
  const PictureSize pattern{options.projector_width_px, options.projector_height_px};
  const OpaqueTriangles opaque = opaque_triangles(rig.neutral);
  const ScannerView view(rig, opaque, moment_at(weights, world_from_head, 0), camera, picture, projector, pattern, dots,
                         lost);
  Motion motion;
  if (options.exposure_step > 0 && weights.size() > 1) {
    const auto depths_at = [&](std::size_t exposure) {
      const double offset = exposure_offset(exposure, options.exposure_step);
      return inverse_depths(rig, opaque, moment_at(weights, world_from_head, offset), camera, picture);
    };
    motion = {depths_at(0), depths_at(exposure_count - 1)};
  }
  const std::string frame = id == nullptr ? std::string() : *id;
  const PixelNoise depth_noise(options.seed, frame, 0), dropout(options.seed, frame, 1), grain(options.seed, frame, 2);
  const NormalTable normal;
  const SrgbCurve curve;
  const auto steepest = static_cast<float>(std::cos(options.max_angle_deg * std::numbers::pi / 180));
  const auto noise_mm = static_cast<float>(options.noise_mm), grazing = static_cast<float>(options.grazing);
  const auto min_signal = static_cast<float>(options.min_signal), dropouts = static_cast<float>(options.dropouts);
  const auto depth_step = static_cast<float>(options.depth_step_mm), ambient = static_cast<float>(options.ambient);
  const auto exposure = static_cast<float>(options.exposure);
  const auto grey_noise = static_cast<float>(options.grey_noise);
  const auto max_motion = static_cast<float>(options.max_motion_mm);
  const auto phase_per_px = static_cast<float>(4 * std::numbers::pi / options.ripple_period_px);  // of 2 phase

  const std::size_t pixels = static_cast<std::size_t>(options.width_px) * static_cast<std::size_t>(options.height_px);
  ScanFrameResult result;
  result.scan.camera = camera;
  result.scan.picture = {options.width_px, options.height_px, 1, {}};
  const auto light_of = [&](const SeenPoint& seen) {
    const float albedo = luminance(seen.albedo);
    if (!options.light) return albedo;
    return exposure * albedo * (ambient * seen.ambient + (seen.lit ? std::max(0.0f, seen.projector_cosine) : 0.0f));
  };
  const float dark_room = exposure * 0.05f * ambient;
  std::vector<float> light(pixels, dark_room);  // linear
  result.scan.depth_mm.assign(pixels, 0.0f);
  view.for_each([&](const SeenPoint& seen) {
    const bool measured_light = seen.lit || !options.shadow_holes;
    const float cosine = std::max(0.0f, seen.projector_cosine);
    const float albedo = luminance(seen.albedo);
    light[seen.pixel] = light_of(seen);
    const float smaller = options.shadow_holes ? std::min(seen.camera_cosine, cosine) : seen.camera_cosine;
    if (!measured_light || seen.lost > 0.5f || smaller < steepest || albedo * smaller < min_signal) return;
    if (dropouts > 0 && dropout.uniform(seen.pixel) < dropouts) return;
    float depth = seen.depth_mm;
    if (!motion.first.empty()) {
      const float first = motion.first[seen.pixel], last = motion.last[seen.pixel];
      if (first == 0 || last == 0) return;
      const float change = 1 / last - 1 / first;
      const float bend = 0.5f * (1 / first + 1 / last) - depth;
      if (std::abs(change) + 2 * std::abs(bend) > max_motion) return;
      // The mean of five equidistant values of a parabola with these ends and this middle.
      depth += 0.5f * bend;
      const float per_picture = change / static_cast<float>(exposure_count - 1);
      depth += static_cast<float>(options.ripple) * per_picture * std::sin(phase_per_px * seen.projector_x_px);
    }
    if (noise_mm > 0)
      depth += noise_mm * (1 + grazing * (1 / std::max(0.1f, smaller) - 1)) * depth_noise.normal(seen.pixel);
    if (depth_step > 0) depth = depth_step * std::round(depth / depth_step);
    result.scan.depth_mm[seen.pixel] = std::max(0.0f, depth);
  });
  std::vector<float> grey(pixels);
  const auto expose = [&] {
    std::transform(light.begin(), light.end(), grey.begin(), [&](float x) { return 255 * curve(x); });
  };
  expose();
  if (options.samples > 1)
    view.take_means(edges_of(grey, picture, edge_levels), options.samples, dark_room, light_of, light);
  if (options.lens_px > 0) blur_light(light, picture, options.lens_px);
  expose();
  result.scan.picture.pixels.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const float level = grey_noise > 0 ? grey[i] + grey_noise * normal[grain.bits(i)] : grey[i];
    result.scan.picture.pixels[i] = static_cast<std::uint8_t>(std::clamp(level, 0.0f, 255.0f) + 0.5f);
  }
  result.truth = view.map();
  return result;
}

}  // namespace face::phantom
