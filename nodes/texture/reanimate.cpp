// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/reanimate.h"

#include <algorithm>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/pose.h"
#include "nodes/model/pose_model.h"
#include "nodes/texture/continue_background.h"
#include "nodes/texture/draw_face.h"
#include "nodes/texture/face_mask.h"
#include "nodes/texture/lay_over.h"
#include "nodes/texture/measure_teeth.h"

namespace face::texture {

Image reanimate(const MorphableModel& model, const Rig& person, const AlbedoMap& albedo, const FaceFit& fit,
                const Image& frame, const Image& background, const engine::Window<Weights>& weights,
                const Matrix* teeth, const ReanimateOptions& options) {
  check(options.moments >= 1, "moments is ", options.moments, ", expected at least 1");
  if (!fit.converged) return frame;
  const Weights& now = weights.centre();
  const Weights& next = weights[std::min(weights.centre_index() + 1, weights.size() - 1)];
  const Image mask = face_mask(model, fit);
  const std::vector<Vec3f> was = model::pose_model(model, fit.identity, fit.expression);
  FaceLayer sum;
  for (std::int64_t m = 0; m < options.moments; ++m) {
    const float t = static_cast<float>(m) / static_cast<float>(options.moments);
    Weights between = now;
    between.values.resize(std::max(now.values.size(), next.values.size()), 0.0f);
    for (std::size_t k = 0; k < next.values.size(); ++k) between.values[k] += t * (next.values[k] - between.values[k]);
    for (std::size_t k = next.values.size(); k < between.values.size(); ++k) between.values[k] *= 1 - t;
    const FaceLayer layer = draw_face(person, albedo, pose_points(person, between), was, fit,
                                      {.samples = static_cast<int>(options.samples), .teeth_gain = gain_of(teeth)});
    const float share = 1.0f / static_cast<float>(options.moments);
    if (m == 0) {
      sum = layer;
      std::fill(sum.colour.begin(), sum.colour.end(), Vec3f{0, 0, 0});
      std::fill(sum.mouth_colour.begin(), sum.mouth_colour.end(), Vec3f{0, 0, 0});
      std::fill(sum.mouth.begin(), sum.mouth.end(), 0.0f);
      std::fill(sum.alpha.begin(), sum.alpha.end(), 0.0f);
      std::fill(sum.cover.begin(), sum.cover.end(), 0.0f);
      for (Vec2f& shift : sum.shift_px) shift = {0, 0};
    }
    for (std::size_t i = 0; i < sum.alpha.size(); ++i) {
      sum.alpha[i] += share * layer.alpha[i];
      sum.cover[i] += share * layer.cover[i];
      for (std::size_t k = 0; k < 2; ++k) sum.shift_px[i][k] += share * layer.shift_px[i][k];
      sum.mouth[i] += share * layer.mouth[i];
      for (std::size_t c = 0; c < 3; ++c) {
        sum.colour[i][c] += share * layer.colour[i][c];
        sum.mouth_colour[i][c] += share * layer.mouth_colour[i][c];
      }
    }
  }
  return lay_over(sum, frame, background, mask, face_scale_px(fit));
}

}  // namespace face::texture
