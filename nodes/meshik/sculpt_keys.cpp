// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/sculpt_keys.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/meshik/landmark_vertices.h"

namespace face::meshik {
namespace {

// mm per pixel: least squares of the neutral landmarks, about their means, y turned round.
double scale_of(const Rig& rig, const Landmarks& neutral, const std::vector<LandmarkVertex>& places) {
  double mean[4] = {}, along = 0, size = 0;
  const auto values = [&](const LandmarkVertex& place, double(&v)[4]) {
    v[0] = neutral.points[place.landmark].x_px;
    v[1] = -neutral.points[place.landmark].y_px;
    v[2] = static_cast<double>(rig.neutral.points_mm[place.vertex][0]);
    v[3] = static_cast<double>(rig.neutral.points_mm[place.vertex][1]);
  };
  double v[4];
  for (const LandmarkVertex& place : places) {
    values(place, v);
    for (std::size_t i = 0; i < 4; ++i) mean[i] += v[i] / static_cast<double>(places.size());
  }
  for (const LandmarkVertex& place : places) {
    values(place, v);
    for (std::size_t d = 0; d < 2; ++d) {
      along += (v[d] - mean[d]) * (v[2 + d] - mean[2 + d]);
      size += (v[d] - mean[d]) * (v[d] - mean[d]);
    }
  }
  check(size > 0 && along > 0, "the neutral landmarks do not lie as those of an upright face do");
  return along / size;
}

// Offsets of the landmarks' x and y by each shape that may be used; empty for the others.
std::vector<std::vector<double>> shape_rows(const Rig& rig, const std::vector<LandmarkVertex>& places) {
  std::vector<std::vector<double>> rows(rig.shapes.size());
  for (std::size_t s = 0; s < rig.shapes.size(); ++s) {
    const Shape& shape = rig.shapes[s];
    if (!shape.name.starts_with("jaw") && !shape.name.starts_with("mouth")) continue;
    std::vector<double> row(2 * places.size(), 0.0);
    bool moves = false;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto at = std::lower_bound(shape.vertices.begin(), shape.vertices.end(), places[i].vertex);
      if (at == shape.vertices.end() || *at != places[i].vertex) continue;
      for (std::size_t d = 0; d < 2; ++d) {
        row[2 * i + d] =
            static_cast<double>(shape.offsets_mm[static_cast<std::size_t>(at - shape.vertices.begin())][d]);
        moves = moves || row[2 * i + d] != 0;
      }
    }
    if (moves) rows[s] = std::move(row);
  }
  return rows;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// min |sum_s w_s row_s - wanted|^2 + restraint |w|^2, 0 <= w <= 1; `wanted` becomes what is left.
std::vector<double> fit_box(const std::vector<std::vector<double>>& rows, double restraint,
                            std::vector<double>& wanted) {
  std::vector<double> weights(rows.size(), 0.0);
  constexpr int most_sweeps = 20000;
  double largest = 1;
  for (int sweep = 0; sweep < most_sweeps && largest > 1e-9; ++sweep) {
    largest = 0;
    for (std::size_t s = 0; s < rows.size(); ++s) {
      if (rows[s].empty()) continue;
      const double size = dot(rows[s], rows[s]) + restraint;
      const double next = std::clamp(weights[s] + (dot(rows[s], wanted) - restraint * weights[s]) / size, 0.0, 1.0);
      const double step = next - weights[s];
      for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] -= step * rows[s][i];
      weights[s] = next;
      largest = std::max(largest, std::abs(step));
    }
  }
  return weights;
}

}  // namespace

SculptKeysResult sculpt_keys(const Rig& rig, const KeyShapes& key_shapes, const Landmarks& neutral,
                             engine::SeqWriter<Mesh>& key_meshes, engine::SeqWriter<Weights>& rig_weights,
                             const SculptKeysOptions& options) {
  const std::vector<LandmarkVertex> places = landmark_vertices(rig, neutral);
  for (const LandmarkVertex& place : places)
    check(place.vertex < rig.neutral.points_mm.size(), "a landmark is vertex ", place.vertex, ", expected one below ",
          rig.neutral.points_mm.size());
  SculptKeysResult result;
  result.reference = rig.neutral;
  result.mm_per_px = scale_of(rig, neutral, places);
  const std::vector<std::vector<double>> rows = shape_rows(rig, places);
  double mean = 0, count = 0;
  for (const std::vector<double>& row : rows)
    if (!row.empty()) {
      mean += dot(row, row);
      ++count;
    }
  check(count > 0, "no jaw or mouth shape of the rig moves a landmark");
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
    const std::vector<double> weights = fit_box(rows, options.restraint * mean / count, wanted);
    squares += dot(wanted, wanted) / static_cast<double>(places.size());
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
