// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/render_into.h"

#include "nodes/base/pose.h"
#include "nodes/model/pose_model.h"
#include "nodes/texture/continue_background.h"
#include "nodes/texture/draw_face.h"
#include "nodes/texture/face_mask.h"
#include "nodes/texture/lay_over.h"
#include "nodes/texture/measure_teeth.h"

namespace face::texture {

Image render_into(const MorphableModel& model, const Rig& person, const AlbedoMap& albedo, const FaceFit& fit,
                  const Image& picture, const Image* background, const Weights* weights, const Matrix* teeth,
                  const RenderIntoOptions& options) {
  const std::vector<Vec3f> was = model::pose_model(model, fit.identity, fit.expression);
  const std::vector<Vec3f> points = weights != nullptr ? pose_points(person, *weights) : was;
  return lay_over(draw_face(person, albedo, points, was, fit,
                            {.samples = static_cast<int>(options.samples), .teeth_gain = gain_of(teeth)}),
                  picture, background != nullptr ? *background : picture, face_mask(model, fit), face_scale_px(fit));
}

}  // namespace face::texture
