// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/find_openings.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/grey_spline.h"
#include "nodes/base/scan_points.h"
#include "nodes/render/camera.h"
#include "nodes/render/triangulate.h"
#include "nodes/transfer/opening_sheet.h"

namespace face::transfer {
namespace {

constexpr std::size_t fewest_pixels = 60;
constexpr int edge_px = 4;       // nearer to what is not measured is a lip
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

// Flags of a picture's pixels.
class Flags {
 public:
  Flags(int width, int height) : width_(width), height_(height) {
    on_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  }
  int width() const { return width_; }
  int height() const { return height_; }
  bool at(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_ && on_[index(x, y)] != 0; }
  void set(int x, int y, bool on) { on_[index(x, y)] = on ? 1 : 0; }
  // On where any (or all) within a radius is.
  Flags spread(int radius, bool any) const {
    Flags out(width_, height_);
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        bool found = !any;
        for (int dy = -radius; dy <= radius; ++dy)
          for (int dx = -radius; dx <= radius; ++dx)
            if (dx * dx + dy * dy <= radius * radius && at(x + dx, y + dy) == any) found = any;
        out.set(x, y, found);
      }
    return out;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  int width_, height_;
  std::vector<char> on_;
};

using Pixels = std::vector<std::array<int, 2>>;

std::vector<Pixels> parts_of(Flags flags) {
  std::vector<Pixels> parts;
  for (int y = 0; y < flags.height(); ++y)
    for (int x = 0; x < flags.width(); ++x) {
      if (!flags.at(x, y)) continue;
      Pixels part = {{x, y}};
      flags.set(x, y, false);
      for (std::size_t next = 0; next < part.size(); ++next)
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            const int nx = part[next][0] + dx, ny = part[next][1] + dy;
            if (!flags.at(nx, ny)) continue;
            flags.set(nx, ny, false);
            part.push_back({nx, ny});
          }
      parts.push_back(std::move(part));
    }
  return parts;
}

// The outer border of a part, pixel by pixel (Moore's neighbours, clockwise).
std::vector<Place> border_of(const Pixels& part, int width, int height) {
  Flags flags(width, height);
  for (const auto& [x, y] : part) flags.set(x, y, true);
  constexpr std::array<std::array<int, 2>, 8> ways = {
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  // The first in reading order: there is nothing above and to its left.
  const auto [first_x, first_y] = *std::min_element(part.begin(), part.end(), [](const auto& a, const auto& b) {
    return std::pair(a[1], a[0]) < std::pair(b[1], b[0]);
  });
  std::vector<Place> border;
  int x = first_x, y = first_y;
  std::size_t way = 7;
  do {
    border.push_back({static_cast<double>(x), static_cast<double>(y)});
    std::size_t turned = 0;
    for (; turned < 8; ++turned) {
      const auto& [dx, dy] = ways[(way + turned) % 8];
      if (flags.at(x + dx, y + dy)) break;
    }
    if (turned == 8) break;
    way = (way + turned) % 8;
    x += ways[way][0];
    y += ways[way][1];
    way = (way + 6) % 8;
  } while ((x != first_x || y != first_y) && border.size() < 4 * part.size());
  return border;
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
  Flags hidden(width, height), edge(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      hidden.set(x, y, counts[i] >= options.fewest_frames);
      edge.set(x, y, !(reference.depth_mm[i] > 0));
    }
  // Closed over what no frame hides quite, opened over what hangs together by a thread.
  hidden = hidden.spread(4, true).spread(4, false).spread(2, false).spread(2, true);
  edge = edge.spread(edge_px, true);
  const Outliner outliner(reference.picture);
  Landmarks openings;
  int number = 0;
  for (const Pixels& part : parts_of(hidden)) {
    const bool at_edge =
        std::any_of(part.begin(), part.end(), [&](const auto& pixel) { return edge.at(pixel[0], pixel[1]); });
    if (part.size() < fewest_pixels || at_edge) continue;
    const Outline outline = outliner.about(border_of(part, width, height));
    ++number;
    for (std::size_t i = 0; i < outline.corners.size(); ++i)
      openings.points.push_back(
          {std::to_string(number) + "." + std::to_string(i), outline.corners[i][0], outline.corners[i][1], true});
  }
  return openings;
}

}  // namespace face::transfer
