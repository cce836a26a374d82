// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/laser_truth.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "nodes/base/check.h"
#include "nodes/base/pose.h"
#include "nodes/base/scan_points.h"
#include "nodes/phantom/head_view.h"

namespace face::phantom {

Landmarks laser_landmarks(const Rig& rig, const Weights& weights, const CylinderScan& scan) {
  check(rig.landmarks68.size() == 68, "the rig names ", rig.landmarks68.size(), " landmarks, expected 68");
  check(scan.step_mm > 0 && scan.phi_step_rad > 0, "scan has steps of ", scan.step_mm, " mm and ", scan.phi_step_rad,
        " rad, expected more than 0");
  const std::vector<Vec3f> points_mm = pose_points(rig, weights);
  Landmarks landmarks;
  for (std::size_t i = 0; i < 68; ++i) {
    check(rig.landmarks68[i] < points_mm.size(), "landmark ", i, " is vertex ", rig.landmarks68[i],
          ", but the mesh has ", points_mm.size());
    const CylinderPlace place = cylinder_place(scan.axis, points_mm[rig.landmarks68[i]]);
    Landmark mark;
    mark.name = (i < 10 ? "0" : "") + std::to_string(i);
    mark.x_px = 0.5 * (scan.picture.width - 1) + place.phi_rad / static_cast<double>(scan.phi_step_rad);
    mark.y_px = (static_cast<double>(scan.top_mm) - place.h_mm) / static_cast<double>(scan.step_mm);
    mark.valid = mark.x_px >= -0.5 && mark.y_px >= -0.5 && mark.x_px <= scan.picture.width - 0.5 &&
                 mark.y_px <= scan.picture.height - 0.5;
    landmarks.points.push_back(mark);
  }
  return landmarks;
}

MeshPoints laser_truth(const Rig& rig, const Weights& weights, const SurfaceMap& truth, const MorphableModel& surface) {
  const std::vector<render::Triangle> triangles = fan_triangles(rig.neutral);
  const std::size_t pixels = static_cast<std::size_t>(truth.width) * static_cast<std::size_t>(truth.height);
  check(truth.triangle.size() == pixels && truth.weights.size() == pixels, "truth has ", truth.triangle.size(),
        " triangles and ", truth.weights.size(), " weights, expected ", truth.width, " x ", truth.height);
  const Mesh& mesh = surface.mean;
  check(mesh.uvs.size() == mesh.points_mm.size(), "surface has ", mesh.uvs.size(),
        " uvs, expected one for each of its ", mesh.points_mm.size(), " vertices");
  std::size_t skin = mesh.points_mm.size();
  if (mesh.parts.size() > 1) {
    check(mesh.parts[0].polygon_count <= mesh.polygon_count(), "surface has a first part of ",
          mesh.parts[0].polygon_count, " polygons, but ", mesh.polygon_count());
    skin = 0;
    for (std::size_t c = 0; c < mesh.polygon_starts[mesh.parts[0].polygon_count]; ++c)
      skin = std::max<std::size_t>(skin, mesh.corners[c] + 1);
  }
  const std::vector<Vec3f> points_mm = pose_points(rig, weights);
  MeshPoints out;
  check(skin <= mesh.points_mm.size(), "surface has a corner at vertex ", skin - 1, " of ", mesh.points_mm.size());
  for (std::size_t v = 0; v < skin; ++v) {
    check(std::isfinite(mesh.uvs[v][0] + mesh.uvs[v][1]), "surface has a uv ", v, " that is not finite");
    const auto x = std::lround(static_cast<double>(mesh.uvs[v][0]) * truth.width - 0.5),
               y = std::lround(static_cast<double>(1 - mesh.uvs[v][1]) * truth.height - 0.5);
    check(x >= 0 && y >= 0 && x < truth.width && y < truth.height, "vertex ", v, " lies on pixel (", x, ", ", y,
          "), outside the truth of ", truth.width, " x ", truth.height);
    const auto pixel = static_cast<std::size_t>(y * truth.width + x);
    const std::int32_t t = truth.triangle[pixel];
    check(t >= 0 && t < static_cast<std::int32_t>(triangles.size()), "vertex ", v, " lies on pixel (", x, ", ", y,
          "), where the truth shows triangle ", t, ", expected 0 to ", triangles.size());
    const render::Triangle& triangle = triangles[static_cast<std::size_t>(t)];
    const Vec2f& w = truth.weights[pixel];
    Vec3f point{};
    for (std::size_t k = 0; k < 3; ++k)
      point[k] = w[0] * points_mm[triangle[0]][k] + w[1] * points_mm[triangle[1]][k] +
                 (1 - w[0] - w[1]) * points_mm[triangle[2]][k];
    out.points_mm.push_back(point);
  }
  return out;
}

}  // namespace face::phantom
