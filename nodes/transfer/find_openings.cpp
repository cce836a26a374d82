// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/find_openings.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/grey_spline.h"
#include "nodes/base/quantile.h"
#include "nodes/base/scan_points.h"
#include "nodes/render/camera.h"
#include "nodes/render/triangulate.h"
#include "nodes/transfer/opening_sheet.h"
#include "nodes/transfer/pixel_parts.h"

namespace face::transfer {
namespace {

// In edges of the mesh, to which what is hidden is known: what no frame hides quite, and what hangs together by a
// thread; nearer to what is not measured is a lip; an opening has so many vertices.
constexpr int closed_edges = 2, thread_edges = 1, lip_edges = 2, fewest_vertices = 15;
constexpr double step_px = 0.5;  // along a normal
constexpr double pull = 0.15;    // of a pixel squared from where the curve was, against levels
constexpr double turn = 3;       // of a step squared between neighbours
constexpr double most_levels = 25, dark_levels = 5, sure_levels = 15;
constexpr double stiffness = 4;

double length(const Place& a) { return std::hypot(a[0], a[1]); }

// How many frames hide each pixel of the reference.
std::vector<int> hidden_counts(const Mesh& mesh, const DepthScan& reference, const engine::Seq<MeshPoints>& shapes,
                               const engine::Seq<DepthScan>& frames, double least_area) {
  const Image& picture = reference.picture;
  const std::vector<render::Triangle> triangles = render::triangulate(mesh).triangles;
  std::vector<render::ScreenPoint> before;
  for (const Vec2f& uv : mesh.uvs)
    before.push_back(
        {uv[0] * static_cast<float>(picture.width) - 0.5f, (1 - uv[1]) * static_cast<float>(picture.height) - 0.5f, 1});
  const auto twice_area = [](const render::Triangle& t, const std::vector<render::ScreenPoint>& at) {
    const auto &a = at[t[0]], &b = at[t[1]], &c = at[t[2]];
    return static_cast<double>((b.x_px - a.x_px) * (c.y_px - a.y_px) - (c.x_px - a.x_px) * (b.y_px - a.y_px));
  };
  std::vector<int> frames_hidden(triangles.size(), 0);
  for (std::size_t f = 0; f < shapes.size(); ++f) {
    const std::shared_ptr<const MeshPoints> shape = shapes.at(f);
    check(shape->points_mm.size() == mesh.points_mm.size(), "shape ", shapes.id(f), " has ", shape->points_mm.size(),
          " points, the mesh ", mesh.points_mm.size());
    const std::vector<render::ScreenPoint> now = render::project(frames.at(f)->camera, shape->points_mm);
    std::vector<double> squeezed;
    for (const render::Triangle& t : triangles)
      squeezed.push_back(twice_area(t, now) / twice_area(t, before) >= least_area ? 0 : 1);
    for (int ring = 0; ring < 2; ++ring) {
      std::vector<double> sum(before.size(), 0), count(before.size(), 0);
      for (std::size_t i = 0; i < triangles.size(); ++i)
        for (const std::uint32_t v : triangles[i]) {
          sum[v] += squeezed[i];
          ++count[v];
        }
      for (std::size_t i = 0; i < triangles.size(); ++i) {
        squeezed[i] = 0;
        for (const std::uint32_t v : triangles[i]) squeezed[i] += sum[v] / count[v] / 3;
      }
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) frames_hidden[i] += squeezed[i] > 0.5 ? 1 : 0;
  }
  const render::Raster raster = render::rasterize(
      before, triangles,
      {.width_px = picture.width, .height_px = picture.height, .near_mm = 0.5f, .culling = render::Culling::none});
  std::vector<int> counts;
  for (const std::int32_t t : raster.triangles)
    counts.push_back(t < 0 ? 0 : frames_hidden[static_cast<std::size_t>(t)]);
  return counts;
}

// How long the shortest edge of most polygons is in the reference's picture, whole pixels.
int edge_length_px(const Mesh& mesh, const Image& picture) {
  constexpr double longest = 16;
  std::vector<double> shortest;
  for (std::size_t p = 0; p < mesh.polygon_count(); ++p) {
    double least = longest;
    for (std::uint32_t first = mesh.polygon_starts[p], last = mesh.polygon_starts[p + 1], k = first; k < last; ++k) {
      const Vec2f &a = mesh.uvs[mesh.corners[k]], &b = mesh.uvs[mesh.corners[k + 1 < last ? k + 1 : first]];
      least = std::min(least, length({static_cast<double>(b[0] - a[0]) * picture.width,
                                      static_cast<double>(b[1] - a[1]) * picture.height}));
    }
    shortest.push_back(least);
  }
  return static_cast<int>(std::lround(std::max(1.0, median(shortest))));
}

// Corners a pixel apart.
std::vector<Place> evenly(const std::vector<Place>& curve) {
  double whole = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Place &a = curve[i], &b = curve[(i + 1) % curve.size()];
    whole += length({b[0] - a[0], b[1] - a[1]});
  }
  const auto count = std::max<std::size_t>(12, static_cast<std::size_t>(std::lround(whole)));
  std::vector<Place> out;
  double way = 0;
  for (std::size_t i = 0; i < curve.size() && out.size() < count; ++i) {
    const Place &a = curve[i], &b = curve[(i + 1) % curve.size()];
    const double part = length({b[0] - a[0], b[1] - a[1]});
    while (out.size() < count) {
      const double wanted = whole * static_cast<double>(out.size()) / static_cast<double>(count);
      if (wanted > way + part) break;
      const double t = part > 0 ? (wanted - way) / part : 0;
      out.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
    }
    way += part;
  }
  return out;
}

std::vector<Place> softened(std::vector<Place> curve, int sweeps) {
  const std::size_t count = curve.size();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const std::vector<Place> before = curve;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < 2; ++k)
        curve[i][k] = 0.5 * before[i][k] + 0.25 * (before[(i + 1) % count][k] + before[(i + count - 1) % count][k]);
  }
  return curve;
}

// The curve of few harmonics nearest to places, robustly: a place a pixel off counts half.
std::vector<Place> of_harmonics(const std::vector<Place>& places, const std::vector<double>& sure, int harmonics) {
  const auto count = static_cast<Eigen::Index>(places.size());
  const Eigen::Index size = 2 * harmonics + 1;
  Eigen::MatrixXd basis(count, size);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    basis(i, 0) = 1;
    for (Eigen::Index h = 1; h <= harmonics; ++h) {
      basis(i, 2 * h - 1) = std::cos(static_cast<double>(h) * angle);
      basis(i, 2 * h) = std::sin(static_cast<double>(h) * angle);
    }
  }
  std::vector<Place> out = places;
  std::vector<double> weights = sure;
  for (int round = 0; round < 10; ++round) {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(size, size), sides = Eigen::MatrixXd::Zero(size, 2);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto p = static_cast<std::size_t>(i);
      sums += weights[p] * basis.row(i).transpose() * basis.row(i);
      sides += weights[p] * basis.row(i).transpose() * Eigen::RowVector2d(places[p][0], places[p][1]);
    }
    for (Eigen::Index h = 1; h <= harmonics; ++h)
      for (Eigen::Index k = 2 * h - 1; k <= 2 * h; ++k)
        sums(k, k) += 6e-6 * static_cast<double>(count) * std::pow(static_cast<double>(h), 4);
    const Eigen::MatrixXd solved = sums.ldlt().solve(sides);
    const Eigen::MatrixXd curve = basis * solved;
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto p = static_cast<std::size_t>(i);
      out[p] = {curve(i, 0), curve(i, 1)};
      const double away = length({out[p][0] - places[p][0], out[p][1] - places[p][1]});
      weights[p] = sure[p] / (1 + away * away);
    }
  }
  return out;
}

// Moves a curve to the picture's edges near it.
class Outliner {
 public:
  explicit Outliner(const Image& picture) : grey_(picture) {}

  Outline about(const std::vector<Place>& border) const {
    std::vector<Place> curve = softened(evenly(border), 12);
    // Coarse: white against what is about it. Fine: every edge that is near.
    for (const auto& [most, harmonics] : {std::pair(10, 5), std::pair(6, 9), std::pair(2, 9)}) {
      const Search found = searched(curve, most, false);
      curve = of_harmonics(found.found, found.sure, harmonics);
    }
    for (int round = 0; round < 2; ++round) curve = held(searched(curve, 2, true));
    return {evenly(curve)};
  }

 private:
  // A curve, and where the picture's edges are on its normals.
  struct Search {
    std::vector<Place> curve, normals, found;
    std::vector<double> offsets, sure;
  };

  double smooth_grey(const Place& p) const {
    double sum = 0;
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) sum += (x == 0 ? 0.5 : 0.25) * (y == 0 ? 0.5 : 0.25) * grey_.at(p[0] + x, p[1] + y);
    return sum;
  }
  // Levels that it gets lighter outwards.
  double step(const Place& p, const Place& normal) const {
    return smooth_grey({p[0] + 0.5 * normal[0], p[1] + 0.5 * normal[1]}) -
           smooth_grey({p[0] - 0.5 * normal[0], p[1] - 0.5 * normal[1]});
  }

  // Places on the normals, `most` steps to either side, at the picture's edges; sure says how clear these are.
  Search searched(const std::vector<Place>& before, int most, bool fine) const {
    Search out;
    out.curve = evenly(before);
    const std::size_t count = out.curve.size();
    const auto places = static_cast<std::size_t>(2 * most + 1);
    const auto away = [&](std::size_t j) { return step_px * (static_cast<double>(j) - most); };
    for (std::size_t i = 0; i < count; ++i) {
      const Place &a = out.curve[(i + count - 3) % count], &b = out.curve[(i + 3) % count];
      const double size = std::max(length({b[0] - a[0], b[1] - a[1]}), 1e-9);
      out.normals.push_back({(b[1] - a[1]) / size, -(b[0] - a[0]) / size});
    }
    if (Outline{out.curve}.distance(
            {out.curve[0][0] + 0.5 * out.normals[0][0], out.curve[0][1] + 0.5 * out.normals[0][1]}) < 0)
      for (Place& n : out.normals) n = {-n[0], -n[1]};
    const auto on_normal = [&](std::size_t i, double offset) {
      return Place{out.curve[i][0] + offset * out.normals[i][0], out.curve[i][1] + offset * out.normals[i][1]};
    };
    const auto value = [&](double levels, bool weighing) {
      if (levels < 0) return -levels;
      return fine ? std::min(levels, 8.0) : (weighing ? 0.2 : 0.5) * std::min(levels, dark_levels);
    };
    std::vector<std::vector<double>> own(count, std::vector<double>(places));
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < places; ++j)
        own[i][j] =
            std::min(value(step(on_normal(i, away(j)), out.normals[i]), false), most_levels) - pull * away(j) * away(j);
    // A closed curve ends where it began: every first place in turn.
    const auto near = [&](std::size_t j, auto take) {
      for (std::size_t k = j < 2 ? 0 : j - 2; k <= std::min(places - 1, j + 2); ++k) {
        const double apart = static_cast<double>(j) - static_cast<double>(k);
        take(k, -turn * apart * apart);
      }
    };
    double best = -1e30;
    std::vector<std::size_t> chosen(count, static_cast<std::size_t>(most));
    for (std::size_t first = 0; first < places; ++first) {
      std::vector<std::vector<double>> total(count, std::vector<double>(places, -1e30));
      std::vector<std::vector<std::size_t>> from(count, std::vector<std::size_t>(places, 0));
      total[0][first] = own[0][first];
      for (std::size_t i = 1; i < count; ++i)
        for (std::size_t j = 0; j < places; ++j)
          near(j, [&](std::size_t k, double cost) {
            if (total[i - 1][k] + own[i][j] + cost <= total[i][j]) return;
            total[i][j] = total[i - 1][k] + own[i][j] + cost;
            from[i][j] = k;
          });
      near(first, [&](std::size_t last, double cost) {
        if (total[count - 1][last] + cost <= best) return;
        best = total[count - 1][last] + cost;
        std::size_t j = last;
        for (std::size_t i = count; i-- > 0;) {
          chosen[i] = j;
          j = from[i][j];
        }
      });
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t j = chosen[i];
      double offset = away(j);
      if (j > 0 && j + 1 < places) {
        const double less = own[i][j - 1], more = own[i][j + 1], bend = less - 2 * own[i][j] + more;
        if (bend < 0) offset += step_px * std::clamp(0.5 * (less - more) / bend, -0.5, 0.5);
      }
      out.offsets.push_back(offset);
      out.found.push_back(on_normal(i, offset));
      out.sure.push_back(std::clamp(value(step(out.found.back(), out.normals[i]), true) / sure_levels, 0.02, 1.0));
    }
    return out;
  }

  // The searched curve, where what was found counts by how sure it is and the way there changes smoothly.
  std::vector<Place> held(const Search& search) const {
    const auto count = static_cast<Eigen::Index>(search.curve.size());
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(count, count);
    Eigen::VectorXd side = Eigen::VectorXd::Zero(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto p = static_cast<std::size_t>(i);
      sums(i, i) += search.sure[p] + 0.01;
      side[i] += search.sure[p] * search.offsets[p];
      const std::array<Eigen::Index, 3> about = {(i + count - 1) % count, i, (i + 1) % count};
      constexpr std::array<double, 3> bend = {1, -2, 1};
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) sums(about[a], about[b]) += stiffness * bend[a] * bend[b];
    }
    const Eigen::VectorXd offset = sums.ldlt().solve(side);
    std::vector<Place> out;
    for (std::size_t i = 0; i < search.curve.size(); ++i) {
      const double o = offset[static_cast<Eigen::Index>(i)];
      out.push_back({search.curve[i][0] + o * search.normals[i][0], search.curve[i][1] + o * search.normals[i][1]});
    }
    return out;
  }

  GreySpline grey_;
};

}  // namespace

Landmarks find_openings(const Mesh& mesh, const DepthScan& reference, const engine::Seq<MeshPoints>& shapes,
                        const engine::Seq<DepthScan>& frames, const FindOpeningsOptions& options) {
  check_scan(reference, "reference");
  check(mesh.uvs.size() == mesh.points_mm.size(), "mesh has ", mesh.uvs.size(), " uvs, expected one for each of its ",
        mesh.points_mm.size(), " points");
  check(shapes.size() == frames.size(), "shapes has ", shapes.size(), " elements, frames ", frames.size());
  const std::vector<int> counts = hidden_counts(mesh, reference, shapes, frames, options.least_area);
  const int width = reference.picture.width, height = reference.picture.height;
  PixelFlags hidden(width, height), edge(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      hidden.set(x, y, counts[i] >= options.fewest_frames);
      edge.set(x, y, !(reference.depth_mm[i] > 0));
    }
  const int edge_px = edge_length_px(mesh, reference.picture);
  hidden = hidden.grown(closed_edges * edge_px).shrunk(closed_edges * edge_px);
  hidden = hidden.shrunk(thread_edges * edge_px).grown(thread_edges * edge_px);
  edge = edge.grown(lip_edges * edge_px);
  const Outliner outliner(reference.picture);
  Landmarks openings;
  int number = 0;
  for (const Pixels& part : parts_of(hidden)) {
    const bool at_edge =
        std::any_of(part.begin(), part.end(), [&](const auto& pixel) { return edge.at(pixel[0], pixel[1]); });
    if (part.size() < static_cast<std::size_t>(fewest_vertices * edge_px * edge_px) || at_edge) continue;
    std::vector<Place> border;
    for (const auto& [x, y] : border_of(part)) border.push_back({static_cast<double>(x), static_cast<double>(y)});
    const Outline outline = outliner.about(border);
    ++number;
    for (std::size_t i = 0; i < outline.corners.size(); ++i)
      openings.points.push_back(
          {std::to_string(number) + "." + std::to_string(i), outline.corners[i][0], outline.corners[i][1], true});
  }
  return openings;
}

}  // namespace face::transfer
