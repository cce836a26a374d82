// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/scan_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
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

// What the five pictures of a pattern make of what they see, every pixel with its own noise.
class DepthSensor {
 public:
  DepthSensor(const ScanFrameOptions& options, const std::string& frame, Motion motion)
      : options_(options),
        motion_(std::move(motion)),
        depth_noise_(options.seed, frame, 0),
        dropout_(options.seed, frame, 1),
        steepest_(static_cast<float>(std::cos(options.max_angle_deg * std::numbers::pi / 180))),
        phase_per_px_(static_cast<float>(4 * std::numbers::pi / options.ripple_period_px)) {}

  // 0 where nothing is measured.
  float measure_mm(const SeenPoint& seen) const {
    const bool projected = seen.lit || !options_.shadow_holes;
    const float smaller = options_.shadow_holes ? std::min(seen.camera_cosine, std::max(0.0f, seen.projector_cosine))
                                                : seen.camera_cosine;
    if (!projected || seen.lost > 0.5f || smaller < steepest_ ||
        luminance(seen.albedo) * smaller < static_cast<float>(options_.min_signal))
      return 0;
    if (options_.dropouts > 0 && dropout_.uniform(seen.pixel) < static_cast<float>(options_.dropouts)) return 0;
    float depth = seen.depth_mm;
    if (!add_motion(seen, depth)) return 0;
    if (options_.noise_mm > 0) {
      const float glance = 1 + static_cast<float>(options_.grazing) * (1 / std::max(0.1f, smaller) - 1);
      depth += static_cast<float>(options_.noise_mm) * glance * depth_noise_.normal(seen.pixel);
    }
    const auto step = static_cast<float>(options_.depth_step_mm);
    if (step > 0) depth = step * std::round(depth / step);
    return std::max(0.0f, depth);
  }

 private:
  // False where the pixel saw too much of it.
  bool add_motion(const SeenPoint& seen, float& depth) const {
    if (motion_.first.empty()) return true;
    const float first = motion_.first[seen.pixel], last = motion_.last[seen.pixel];
    if (first == 0 || last == 0) return false;
    const float change = 1 / last - 1 / first;
    const float bend = 0.5f * (1 / first + 1 / last) - depth;
    if (std::abs(change) + 2 * std::abs(bend) > static_cast<float>(options_.max_motion_mm)) return false;
    // The mean of five equidistant values of a parabola with these ends and this middle.
    depth += 0.5f * bend;
    const float per_picture = change / static_cast<float>(exposure_count - 1);
    depth += static_cast<float>(options_.ripple) * per_picture * std::sin(phase_per_px_ * seen.projector_x_px);
    return true;
  }

  const ScanFrameOptions& options_;
  const Motion motion_;
  const PixelNoise depth_noise_, dropout_;
  const float steepest_, phase_per_px_;  // of 2 phase
};

// Linear light to the camera's bytes, with grain.
std::vector<std::uint8_t> developed(const std::vector<float>& light, const std::string& frame,
                                    const ScanFrameOptions& options) {
  const PixelNoise grain(options.seed, frame, 2);
  const NormalTable normal;
  const SrgbCurve curve;
  const auto grey_noise = static_cast<float>(options.grey_noise);
  std::vector<std::uint8_t> levels(light.size());
  for (std::size_t i = 0; i < light.size(); ++i) {
    const float grey = 255 * curve(light[i]);
    const float level = grey_noise > 0 ? grey + grey_noise * normal[grain.bits(i)] : grey;
    levels[i] = static_cast<std::uint8_t>(std::clamp(level, 0.0f, 255.0f) + 0.5f);
  }
  return levels;
}

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
  const DepthSensor sensor(options, frame, std::move(motion));
  const auto exposure = static_cast<float>(options.exposure), ambient = static_cast<float>(options.ambient);
  const auto light_of = [&](const SeenPoint& seen) {
    const float albedo = luminance(seen.albedo);
    if (!options.light) return albedo;
    return exposure * albedo * (ambient * seen.ambient + (seen.lit ? std::max(0.0f, seen.projector_cosine) : 0.0f));
  };
  const float dark_room = exposure * 0.05f * ambient;
  const std::size_t pixels = static_cast<std::size_t>(options.width_px) * static_cast<std::size_t>(options.height_px);
  std::vector<float> light(pixels, dark_room);  // linear
  ScanFrameResult result;
  result.scan.camera = camera;
  result.scan.depth_mm.assign(pixels, 0.0f);
  view.for_each([&](const SeenPoint& seen) {
    light[seen.pixel] = light_of(seen);
    result.scan.depth_mm[seen.pixel] = sensor.measure_mm(seen);
  });
  if (options.samples > 1) {
    const SrgbCurve curve;
    std::vector<float> grey(pixels);
    std::transform(light.begin(), light.end(), grey.begin(), [&](float x) { return 255 * curve(x); });
    view.take_means(edges_of(grey, picture, edge_levels), options.samples, dark_room, light_of, light);
  }
  if (options.lens_px > 0) blur_light(light, picture, options.lens_px);
  result.scan.picture = {options.width_px, options.height_px, 1, developed(light, frame, options)};
  result.truth = view.map();
  return result;
}

}  // namespace face::phantom
