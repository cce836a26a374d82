// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/sculpt_keys.h"

#include <cmath>

#include "nodes/base/check.h"
#include "nodes/meshik/landmark_vertices.h"
#include "nodes/meshik/mouth_fit.h"

namespace face::meshik {
SculptKeysResult sculpt_keys(const Rig& rig, const KeyShapes& key_shapes, const Landmarks& neutral,
                             const Visemes* visemes, engine::SeqWriter<Mesh>& key_meshes,
                             engine::SeqWriter<Weights>& rig_weights, const SculptKeysOptions& options) {
  const std::vector<LandmarkVertex> places = landmark_vertices(rig, neutral);
  const MouthFit fit(rig, places, visemes,
                     {.restraint = options.restraint,
                      .variety = options.variety,
                      .common_share = options.common_share,
                      .own_deviation = options.own_deviation,
                      .landmark_error_mm = options.landmark_error_mm,
                      .gap_error_mm = options.gap_error_mm});
  SculptKeysResult result;
  result.reference = rig.neutral;
  result.mm_per_px = landmark_scale_mm(rig, neutral, places);
  double squares = 0;
  for (const KeyShape& key : key_shapes.shapes) {
    check(key.landmarks.points.size() == neutral.points.size(), "key shape ", key.frame, " has ",
          key.landmarks.points.size(), " landmarks, expected ", neutral.points.size(), " as neutral");
    std::vector<double> wanted;
    for (const LandmarkVertex& place : places) {
      const Landmark &here = key.landmarks.points[place.landmark], &rest = neutral.points[place.landmark];
      check(here.name == rest.name, "landmark ", place.landmark, " of key shape ", key.frame, " is ", here.name,
            ", expected ", rest.name, " as of neutral");
      wanted.push_back(result.mm_per_px * (here.x_px - rest.x_px));
      wanted.push_back(-result.mm_per_px * (here.y_px - rest.y_px));
    }
    const std::vector<double> weights = fit.weights(wanted);
    for (const double left : wanted) squares += left * left / static_cast<double>(places.size());
    Mesh mesh = rig.neutral;
    for (std::size_t s = 0; s < weights.size(); ++s) {
      const Shape& shape = rig.shapes[s];
      for (std::size_t i = 0; weights[s] > 0 && i < shape.vertices.size(); ++i)
        for (std::size_t d = 0; d < 3; ++d)
          mesh.points_mm[shape.vertices[i]][d] += static_cast<float>(weights[s]) * shape.offsets_mm[i][d];
    }
    key_meshes.push(std::move(mesh));
    rig_weights.push({std::vector<float>(weights.begin(), weights.end())});
  }
  if (!key_shapes.shapes.empty()) result.rms_mm = std::sqrt(squares / static_cast<double>(key_shapes.shapes.size()));
  return result;
}

}  // namespace face::meshik
