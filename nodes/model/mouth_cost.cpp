// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/mouth_cost.h"

#include <array>
#include <limits>
#include <vector>

#include "nodes/model/robust_weights.h"

namespace face::model {
namespace {

struct Place {
  double x_px, y_px;
};

// Where a vertex of the model is on a level.
Place place_of(const Joint& joint, std::size_t index, double factor, std::uint32_t vertex) {
  const MorphableModel& model = *joint.model;
  const PictureState& state = joint.pictures[index].state;
  const std::size_t vertices = model.mean.points_mm.size();
  Vec3f point = model.mean.points_mm[vertex];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double sum = point[axis];
    for (std::size_t k = 0; k < joint.identity.size(); ++k)
      sum += joint.identity[k] * model.identity.modes[k * vertices + vertex][axis];
    for (std::size_t k = 0; k < state.expression.size(); ++k)
      sum += state.expression[k] * model.expression.modes[k * vertices + vertex][axis];
    point[axis] = static_cast<float>(sum);
  }
  const PoseView at = view(scaled(state.pose, factor), point);
  return {at.x_px, at.y_px};
}

// Whether a ray to the right crosses the outline an odd number of times.
bool is_inside(const std::vector<Place>& outline, double x_px, double y_px) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Place &a = outline[i], &b = outline[(i + 1) % outline.size()];
    if ((a.y_px > y_px) == (b.y_px > y_px)) continue;
    if (x_px < a.x_px + (b.x_px - a.x_px) * (y_px - a.y_px) / (b.y_px - a.y_px)) inside = !inside;
  }
  return inside;
}

}  // namespace

double mouth_cost(const Joint& open, const Joint& closed, std::size_t index, const PictureLevel& level) {
  const std::vector<LipPair>& pairs = open.model->inner_lips;
  std::vector<Place> hole;
  for (std::size_t i = 0; i < pairs.size(); ++i) hole.push_back(place_of(open, index, level.factor, pairs[i].upper));
  for (std::size_t i = pairs.size(); i-- > 0;) hole.push_back(place_of(open, index, level.factor, pairs[i].lower));
  const PictureState& state = closed.pictures[index].state;
  const std::vector<Vec3f> points = posed_skin(closed.basis, closed.identity, state.expression);
  const FacePose pose = scaled(state.pose, level.factor);
  Random random(static_cast<std::uint64_t>(closed.options.seed), 79);
  std::size_t visible = 0;
  std::vector<SkinPoint> between;
  for (const SkinPoint& chosen : choose_points(closed.basis, points, state.pose, level,
                                               std::numeric_limits<std::size_t>::max(), random, visible)) {
    Vec3f at{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        at[axis] += chosen.weights[i] * points[closed.basis.triangles[chosen.triangle][i]][axis];
    const PoseView seen = view(pose, at);
    if (is_inside(hole, seen.x_px, seen.y_px)) between.push_back(chosen);
  }
  const PixelRows rows =
      rows_at(between, closed.basis, points, skin_albedo(closed.basis, closed.albedo), state, level, {0, 0, 0, false});
  double sum = 0;
  for (const float r : rows.residual) {
    const double u = r / (2.5 * least_noise);
    sum += u * u / (1 + u * u);
  }
  return rows.residual.empty() ? 0 : sum / static_cast<double>(rows.residual.size());
}

}  // namespace face::model
