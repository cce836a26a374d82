// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/sample_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "nodes/base/check.h"
#include "nodes/base/luma.h"
#include "nodes/base/scan_points.h"
#include "nodes/model/scan_grid.h"

namespace face::model {
namespace {

double grey_at(const Image& picture, double x, double y) {
  x = std::clamp(x, 0.0, picture.width - 1.0);
  y = std::clamp(y, 0.0, picture.height - 1.0);
  const int x0 = std::min(static_cast<int>(x), std::max(picture.width - 2, 0)),
            y0 = std::min(static_cast<int>(y), std::max(picture.height - 2, 0));
  const int x1 = std::min(x0 + 1, picture.width - 1), y1 = std::min(y0 + 1, picture.height - 1);
  const double fx = x - x0, fy = y - y0;
  const auto grey = [&](int px, int py) -> double {
    const std::uint8_t* p = picture.pixels.data() + static_cast<std::size_t>(py * picture.width + px) *
                                                        static_cast<std::size_t>(picture.channels);
    return grey_value<double>(p, picture.channels);
  };
  return (grey(x0, y0) * (1 - fx) + grey(x1, y0) * fx) * (1 - fy) + (grey(x0, y1) * (1 - fx) + grey(x1, y1) * fx) * fy;
}

// Values on a grid (4 numbers per node), known where weight is 1; fills the rest: means of coarser levels, then
// smoothed by 30 sweeps of averaging among the filled.
void fill(std::vector<std::array<double, 4>>& values, std::vector<double>& weight, int columns, int rows) {
  if (columns > 1 || rows > 1) {
    const int half_columns = (columns + 1) / 2, half_rows = (rows + 1) / 2;
    std::vector<std::array<double, 4>> coarse(static_cast<std::size_t>(half_columns * half_rows), {0, 0, 0, 0});
    std::vector<double> coarse_weight(coarse.size(), 0);
    bool open = false;
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        const auto i = static_cast<std::size_t>(r * columns + c),
                   j = static_cast<std::size_t>(r / 2 * half_columns + c / 2);
        open = open || weight[i] == 0;
        coarse_weight[j] += weight[i];
        for (std::size_t k = 0; k < 4; ++k) coarse[j][k] += weight[i] * values[i][k];
      }
    if (!open) return;
    for (std::size_t j = 0; j < coarse.size(); ++j)
      if (coarse_weight[j] > 0) {
        for (double& v : coarse[j]) v /= coarse_weight[j];
        coarse_weight[j] = 1;
      }
    fill(coarse, coarse_weight, half_columns, half_rows);
    std::vector<std::size_t> unknown;
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        const auto i = static_cast<std::size_t>(r * columns + c);
        if (weight[i] > 0) continue;
        values[i] = coarse[static_cast<std::size_t>(r / 2 * half_columns + c / 2)];
        unknown.push_back(i);
      }
    for (int sweep = 0; sweep < 30; ++sweep)
      for (const std::size_t i : unknown) {
        const int r = static_cast<int>(i) / columns, c = static_cast<int>(i) % columns;
        std::array<double, 4> sum = {0, 0, 0, 0};
        double count = 0;
        const auto add = [&](int rr, int cc) {
          if (rr < 0 || cc < 0 || rr >= rows || cc >= columns) return;
          const std::array<double, 4>& v = values[static_cast<std::size_t>(rr * columns + cc)];
          for (std::size_t k = 0; k < 4; ++k) sum[k] += v[k];
          ++count;
        };
        add(r - 1, c), add(r + 1, c), add(r, c - 1), add(r, c + 1);
        for (std::size_t k = 0; k < 4; ++k) values[i][k] = sum[k] / count;
      }
  }
}

ScanGrid grid_of(const DepthScan& reference, const ScanMeshOptions& options) {
  return scan_grid(reference, static_cast<int>(options.stride_px), options.longest_edge_mm);
}

// Where the flow brings a place: the mean of the displacements that the pixels about it have, by nearness; none where
// the nearest pixel has none.
std::optional<Vec2f> follow_flow(const FlowField& flow, const Vec2f& place) {
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(flow.width) + static_cast<std::size_t>(x);
  };
  if (!flow.valid[index(static_cast<int>(std::lround(place[0])), static_cast<int>(std::lround(place[1])))])
    return std::nullopt;
  const int left = static_cast<int>(place[0]), top = static_cast<int>(place[1]);
  const float right_share = place[0] - static_cast<float>(left), lower_share = place[1] - static_cast<float>(top);
  Vec2f sum{};
  float weight = 0;
  for (int y = top; y <= std::min(top + 1, flow.height - 1); ++y)
    for (int x = left; x <= std::min(left + 1, flow.width - 1); ++x) {
      if (!flow.valid[index(x, y)]) continue;
      const float w = (x == left ? 1 - right_share : right_share) * (y == top ? 1 - lower_share : lower_share);
      for (std::size_t k = 0; k < 2; ++k) sum[k] += w * flow.displacement_px[index(x, y)][k];
      weight += w;
    }
  return Vec2f{place[0] + sum[0] / weight, place[1] + sum[1] / weight};
}

}  // namespace

Mesh scan_mesh(const DepthScan& reference, const ScanMeshOptions& options) {
  const ScanGrid grid = grid_of(reference, options);
  Mesh mesh;
  mesh.points_mm = grid.point_mm;
  for (const Vec2f& place : grid.place_px) {
    const double x = static_cast<double>(place[0]), y = static_cast<double>(place[1]);
    const auto grey = static_cast<float>(grey_at(reference.picture, x, y) / 255);
    mesh.colors_srgb.push_back({grey, grey, grey});
    mesh.uvs.push_back({(place[0] + 0.5f) / static_cast<float>(reference.picture.width),
                        1 - (place[1] + 0.5f) / static_cast<float>(reference.picture.height)});
  }
  for (const auto& triangle : grid.triangles) {
    mesh.polygon_starts.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    mesh.corners.insert(mesh.corners.end(), triangle.begin(), triangle.end());
  }
  mesh.polygon_starts.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  mesh.corner_uvs = mesh.corners;
  mesh.parts = {{"face", 0, static_cast<std::uint32_t>(mesh.polygon_count()), {1, 1, 1}, 0.1f, true}};
  return mesh;
}

SampleScanResult sample_scan(const DepthScan& reference, const DepthScan& target, const FlowField& flow,
                             const ScanMeshOptions& options) {
  const ScanGrid grid = grid_of(reference, options);
  check_scan(target, "target");
  check(flow.width == reference.picture.width && flow.height == reference.picture.height, "flow is ", flow.width, " x ",
        flow.height, " pixels, reference ", reference.picture.width, " x ", reference.picture.height);
  const std::size_t count = reference.depth_mm.size();
  check(flow.displacement_px.size() == count && flow.valid.size() == count, "flow has ", flow.displacement_px.size(),
        " displacements and ", flow.valid.size(), " flags, expected ", count);
  const ScanRays to(target.camera);
  std::vector<std::array<double, 4>> moved(grid.vertex.size(), {0, 0, 0, 0});  // displacement in mm, grey
  std::vector<double> known(grid.vertex.size(), 0);
  double sampled = 0;
  for (std::size_t g = 0; g < grid.vertex.size(); ++g) {
    if (grid.vertex[g] < 0) continue;
    const auto v = static_cast<std::size_t>(grid.vertex[g]);
    const std::optional<Vec2f> at = follow_flow(flow, grid.place_px[v]);
    if (!at) continue;
    const double px = static_cast<double>((*at)[0]), py = static_cast<double>((*at)[1]);
    const float depth = depth_at(target, px, py);
    if (!(depth > 0)) continue;
    const Vec3f p = to.point(px, py, depth);
    for (std::size_t k = 0; k < 3; ++k) moved[g][k] = static_cast<double>(p[k] - grid.point_mm[v][k]);
    moved[g][3] = grey_at(target.picture, px, py);
    known[g] = 1;
    ++sampled;
  }
  if (sampled > 0) fill(moved, known, grid.columns, grid.rows);
  SampleScanResult result;
  result.sampled = grid.point_mm.empty() ? 0 : sampled / static_cast<double>(grid.point_mm.size());
  result.shape.points_mm = grid.point_mm;
  result.texture = {std::max(static_cast<int>(grid.point_mm.size()), 1), 1, 1, {}};
  result.texture.pixels.assign(static_cast<std::size_t>(result.texture.width), 0);
  for (std::size_t g = 0; g < grid.vertex.size(); ++g) {
    if (grid.vertex[g] < 0) continue;
    const auto v = static_cast<std::size_t>(grid.vertex[g]);
    for (std::size_t k = 0; k < 3; ++k) result.shape.points_mm[v][k] += static_cast<float>(moved[g][k]);
    result.texture.pixels[v] = static_cast<std::uint8_t>(std::clamp(std::lround(moved[g][3]), 0l, 255l));
  }
  return result;
}

Matrix region_weights(const Mesh& mesh, const RegionWeightsOptions& options) {
  check(mesh.uvs.size() == mesh.points_mm.size(), "mesh has ", mesh.uvs.size(), " uvs, expected one for each of its ",
        mesh.points_mm.size(), " points");
  Matrix out{mesh.uvs.size(), 1, {}};
  for (const Vec2f& uv : mesh.uvs) {
    const double x = (static_cast<double>(uv[0]) - options.centre_x) / (0.5 * options.width);
    const double y = (1 - static_cast<double>(uv[1]) - options.centre_y) / (0.5 * options.height);
    const double inside = std::clamp((1 - std::hypot(x, y)) / std::max(options.feather, 1e-9), 0.0, 1.0);
    out.values.push_back(inside * inside * (3 - 2 * inside));
  }
  return out;
}

}  // namespace face::model
