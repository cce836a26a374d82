// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/pattern_images.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "nodes/base/fringe_patterns.h"
#include "nodes/phantom/scanner_view.h"
#include "nodes/phantom/sensor_noise.h"

namespace face::phantom {

static_assert(FringePatterns::count == exposure_count);

void pattern_images(const Rig& rig, const engine::Window<Weights>& weights,
                    const engine::Window<RigidMotion>& world_from_head, const Camera& camera, const Camera& projector,
                    const SurfaceDots* dots, const std::string* id, engine::SeqWriter<Image>& images,
                    const PatternImagesOptions& options) {
  const OpaqueTriangles opaque = opaque_triangles(rig.neutral);
  const FringePatterns patterns{options.projector_width_px, options.fine_periods, options.coarse_periods};
  const NormalTable normal;
  const auto ambient = static_cast<float>(options.ambient), exposure = static_cast<float>(options.exposure);
  const auto grey_noise = static_cast<float>(options.grey_noise);
  for (std::size_t picture = 0; picture < exposure_count; ++picture) {
    const Moment moment = moment_at(weights, world_from_head, exposure_offset(picture, options.exposure_step));
    const ScannerView view(rig, opaque, moment, camera, {options.width_px, options.height_px}, projector,
                           {options.projector_width_px, options.projector_height_px}, dots, nullptr);
    Image image{options.width_px, options.height_px, 1, {}};
    std::vector<float> grey(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
                            255 * exposure * 0.05f * ambient);
    view.for_each([&](const SeenPoint& seen) {
      const float direct =
          seen.lit ? std::max(0.0f, seen.projector_cosine) *
                         static_cast<float>(patterns.light(picture, static_cast<double>(seen.projector_x_px)))
                   : 0.0f;
      grey[seen.pixel] = 255 * exposure * luminance(seen.albedo) * (ambient * seen.ambient + direct);
    });
    const PixelNoise grain(options.seed, id == nullptr ? std::string() : *id, 10 + picture);
    image.pixels.resize(grey.size());
    for (std::size_t i = 0; i < grey.size(); ++i) {
      const float level = grey_noise > 0 ? grey[i] + grey_noise * normal[grain.bits(i)] : grey[i];
      image.pixels[i] = static_cast<std::uint8_t>(std::clamp(level, 0.0f, 255.0f) + 0.5f);
    }
    images.push(std::move(image));
  }
}

}  // namespace face::phantom
