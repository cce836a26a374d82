// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/recolour.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/luma.h"
#include "nodes/transfer/mesh_graph.h"

namespace face::transfer {
namespace {

float luma_of(const Vec3f& c) { return luma(c[0], c[1], c[2]); }

}  // namespace

Mesh recolour(const Mesh& mesh, const Mesh& colours, const RecolourOptions& options) {
  const std::size_t count = mesh.points_mm.size();
  check(mesh.colors_srgb.size() == count && colours.colors_srgb.size() == count, "mesh has ", mesh.colors_srgb.size(),
        " colours and colours ", colours.colors_srgb.size(), ", expected ", count, ", one per vertex");
  std::vector<Vec3f> wanted = colours.colors_srgb;
  if (options.smooth_mm > 0) {
    // As often as steps of an edge's length walk that far at random.
    const auto neighbours = neighbours_of(mesh);
    double length = 0, edges = 0;
    for (std::size_t v = 0; v < count; ++v)
      for (const std::uint32_t n : neighbours[v]) {
        const Vec3f &p = mesh.points_mm[v], &q = mesh.points_mm[n];
        length += static_cast<double>(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
        ++edges;
      }
    const double step_mm = edges > 0 ? length / edges : options.smooth_mm;
    const int passes = std::clamp(static_cast<int>(std::ceil(std::pow(options.smooth_mm / step_mm, 2))), 1, 1000);
    for (int pass = 0; pass < passes; ++pass) {
      std::vector<Vec3f> next = wanted;
      for (std::size_t v = 0; v < count; ++v) {
        for (const std::uint32_t n : neighbours[v])
          for (std::size_t k = 0; k < 3; ++k) next[v][k] += wanted[n][k];
        for (float& x : next[v]) x /= static_cast<float>(neighbours[v].size() + 1);
      }
      wanted = std::move(next);
    }
  }
  Mesh out = mesh;
  const auto recorded = static_cast<float>(options.recorded);
  for (std::size_t v = 0; v < count; ++v) {
    const float from = luma_of(wanted[v]), to = (1 - recorded) * from + recorded * luma_of(mesh.colors_srgb[v]);
    for (std::size_t k = 0; k < 3; ++k)
      out.colors_srgb[v][k] = std::clamp(from > 1e-4f ? wanted[v][k] * to / from : to, 0.0f, 1.0f);
  }
  return out;
}

}  // namespace face::transfer
