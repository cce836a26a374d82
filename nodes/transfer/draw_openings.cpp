// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/draw_openings.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/luma.h"
#include "nodes/base/scan_points.h"
#include "nodes/render/camera.h"
#include "nodes/transfer/draw_texture.h"
#include "nodes/transfer/fit_opening.h"
#include "nodes/transfer/opening_scene.h"

namespace face::transfer {
namespace {

constexpr double upper_share = 0.85;  // of a shut eye's opening that the upper lid covers
// How far from the lids' edges skin moves with them, shares of the opening's length: 14 and 10 pixels of 57.
constexpr double upper_reach = 0.25, lower_reach = 0.175;
constexpr double wild_levels = 20;
constexpr std::size_t starts_kept = 2;
constexpr std::size_t fewest_corners = 8;

std::vector<Outline> outlines_of(const Landmarks& openings) {
  std::map<std::string, Outline> named;
  for (const Landmark& point : openings.points)
    if (point.valid) named[point.name.substr(0, point.name.find('.'))].corners.push_back({point.x_px, point.y_px});
  std::vector<Outline> outlines;
  for (auto& [name, outline] : named) {
    check(outline.corners.size() >= fewest_corners, "opening ", name, " has ", outline.corners.size(),
          " points, expected ", fewest_corners, " or more");
    outlines.push_back(std::move(outline));
  }
  return outlines;
}

// The mesh in the reference's picture and in the frame's.
class MeshMotion {
 public:
  MeshMotion(const Mesh& mesh, const Image& picture, const std::vector<render::ScreenPoint>& screen) : mesh_(mesh) {
    for (std::size_t v = 0; v < mesh.uvs.size(); ++v) {
      before_.push_back({static_cast<double>(mesh.uvs[v][0]) * picture.width - 0.5,
                         (1 - static_cast<double>(mesh.uvs[v][1])) * picture.height - 0.5});
      after_.push_back({static_cast<double>(screen[v].x_px), static_cast<double>(screen[v].y_px)});
      vertex_[{std::lround(before_[v][0]), std::lround(before_[v][1])}] = v;
    }
  }
  // The motion of the vertex nearest to a place; false where there is none within 2 pixels.
  bool find(const Place& place, Place& motion) const {
    constexpr long reach = 2;
    double least = 1e30;
    for (long y = std::lround(place[1]) - reach; y <= std::lround(place[1]) + reach; ++y)
      for (long x = std::lround(place[0]) - reach; x <= std::lround(place[0]) + reach; ++x) {
        const auto found = vertex_.find({x, y});
        if (found == vertex_.end()) continue;
        const Place &from = before_[found->second], &to = after_[found->second];
        const double away = std::hypot(from[0] - place[0], from[1] - place[1]);
        if (away >= least) continue;
        least = away;
        motion = {to[0] - from[0], to[1] - from[1]};
      }
    return least < 1e30;
  }
  // Whether all of the mesh within an opening's length of it is within a picture's size of the picture: a camera may be
  // no camera.
  bool stays_near(const Outline& outline, const Image& picture) const {
    const double about_px = opening_axis(outline).length;
    for (std::size_t v = 0; v < before_.size(); ++v) {
      const double x = after_[v][0] / picture.width, y = after_[v][1] / picture.height;
      if (!(std::fabs(x) < 2 && std::fabs(y) < 2) && !(outline.distance(before_[v]) > about_px)) return false;
    }
    return true;
  }
  // The share of an opening's area that the mesh keeps.
  double open_share(const Outline& outline) const {
    double was = 0, is = 0;
    const auto twice_area = [&](const std::vector<Place>& at, std::size_t first) {
      const Place &a = at[mesh_.corners[first]], &b = at[mesh_.corners[first + 1]], &c = at[mesh_.corners[first + 2]];
      return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    };
    for (std::size_t p = 0; p < mesh_.polygon_count(); ++p) {
      const std::size_t first = mesh_.polygon_starts[p];
      if (mesh_.polygon_starts[p + 1] - first < 3 || outline.distance(before_[mesh_.corners[first]]) > 0) continue;
      const double area = twice_area(before_, first);
      was += std::fabs(area);
      is += std::max(area < 0 ? -twice_area(after_, first) : twice_area(after_, first), 0.0);
    }
    return was > 0 ? is / was : 1;
  }

 private:
  const Mesh& mesh_;
  std::vector<Place> before_, after_;
  std::map<std::pair<long, long>, std::size_t> vertex_;
};

// Where the head brings a place: an affine map, by least squares over the sheet's rim.
Eigen::Matrix<double, 3, 2> head_motion(const OpeningSheet& sheet, const MeshMotion& mesh) {
  Eigen::Matrix3d sums = 1e-6 * Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 3, 2> sides = Eigen::Matrix<double, 3, 2>::Zero();
  for (const std::uint32_t v : sheet.rim) {
    Place motion{};
    if (!mesh.find(sheet.places[v], motion)) continue;
    const Eigen::Vector3d place(sheet.places[v][0], sheet.places[v][1], 1);
    sums += place * place.transpose();
    sides += place * Eigen::RowVector2d(motion[0], motion[1]);
  }
  return sums.ldlt().solve(sides);
}

// The top and bottom of a closed curve in a column; false beside it.
bool column_of(const std::vector<Place>& corners, double x, double& top, double& bottom) {
  top = 1e30;
  bottom = -1e30;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Place &a = corners[i], &b = corners[(i + 1) % corners.size()];
    if ((a[0] <= x) == (b[0] <= x)) continue;
    const double y = a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
    top = std::min(top, y);
    bottom = std::max(bottom, y);
  }
  return bottom > top;
}

// Where lids shut by a share bring a place of the skin: across the opening, the less the farther they are from it.
class LidMotion {
 public:
  explicit LidMotion(const Outline& outline) : axis_(opening_axis(outline)) {
    for (const Place& corner : outline.corners) corners_.push_back(axis_.own(corner));
  }
  Place shut(const Place& place, double share) const {
    Place own = axis_.own(place);
    double top = 0, bottom = 0;
    if (!column_of(corners_, own[0], top, bottom)) return place;
    const double way = share * (bottom - top);
    if (own[1] < 0.5 * (top + bottom))
      own[1] += way * upper_share * std::clamp(1 - (top - own[1]) / (upper_reach * axis_.length), 0.0, 1.0);
    else
      own[1] -= way * (1 - upper_share) * std::clamp(1 - (own[1] - bottom) / (lower_reach * axis_.length), 0.0, 1.0);
    return axis_.picture(own);
  }

 private:
  OpeningAxis axis_;
  std::vector<Place> corners_;
};

double grey_of(const Image& picture, std::size_t i) {
  const std::uint8_t* p = picture.pixels.data() + i * static_cast<std::size_t>(picture.channels);
  return grey_value<double>(p, picture.channels);
}

// The frame's pixels that a view draws: take(pixel, its index).
template <class Take>
void each_drawn(const OpeningView& view, const Image& frame, Take take) {
  for (int y = std::max(view.top, 0); y < std::min(view.top + view.height, frame.height); ++y)
    for (int x = std::max(view.left, 0); x < std::min(view.left + view.width, frame.width); ++x)
      if (view.at(x, y).drawn)
        take(view.at(x, y),
             static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) + static_cast<std::size_t>(x));
}

OpeningPose fitted(const OpeningScene& scene, const Outline& outline, const MeshMotion& mesh, const Image& frame) {
  const OpeningSheet& sheet = scene.sheet();
  const Eigen::Matrix<double, 3, 2> head = head_motion(sheet, mesh);
  const auto by_head = [&](const Place& p) {
    const Eigen::RowVector2d motion = Eigen::RowVector3d(p[0], p[1], 1) * head;
    return Place{p[0] + motion[0], p[1] + motion[1]};
  };
  OpeningPose held;
  held.light.assign(static_cast<std::size_t>(scene.light_columns() * scene.light_rows()), 0);
  const Eigen::Matrix2d turned = (Eigen::Matrix2d::Identity() + head.topRows<2>().transpose()).inverse();
  const Eigen::Vector2d from = -turned * head.row(2).transpose();
  held.eye_from_frame = {turned(0, 0), turned(0, 1), turned(1, 0), turned(1, 1), from[0], from[1]};
  for (const Place& place : sheet.places) {
    Place motion{};
    const bool known = mesh.find(place, motion);
    held.vertices.push_back(known ? Place{place[0] + motion[0], place[1] + motion[1]} : by_head(place));
  }
  std::vector<std::pair<double, OpeningPose>> starts;
  const auto consider = [&](const OpeningPose& pose) {
    double cost = 0;
    each_drawn(scene.view(pose), frame, [&](const OpeningView::Pixel& pixel, std::size_t i) {
      cost += std::log1p(std::pow((grey_of(frame, i) - pixel.grey) / wild_levels, 2));
    });
    starts.push_back({cost, pose});
  };
  consider(held);
  const LidMotion lids(outline);
  for (int step = -2; step <= 10; ++step) {
    OpeningPose pose = held;
    for (std::size_t v = 0; v < sheet.places.size(); ++v)
      pose.vertices[v] = by_head(lids.shut(sheet.places[v], 0.1 * step));
    consider(pose);
  }
  std::stable_sort(starts.begin(), starts.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  FitOpeningResult best{{}, 1e300};
  for (std::size_t i = 0; i < starts_kept; ++i) {
    FitOpeningResult found = fit_opening(scene, frame, starts[i].second, held);
    if (found.cost < best.cost) best = std::move(found);
  }
  return best.pose;
}

}  // namespace

Image draw_openings(const Image& drawn, const Landmarks& openings, const Mesh& mesh, const DepthScan& reference,
                    const DepthScan* texture, const MeshPoints& shape, const DepthScan& frame,
                    const DrawOpeningsOptions& options) {
  check_texture(mesh, reference, shape, frame);
  check(drawn.width == frame.picture.width && drawn.height == frame.picture.height && drawn.channels == 1, "drawn is ",
        drawn.width, " x ", drawn.height, " x ", drawn.channels, ", frame ", frame.picture.width, " x ",
        frame.picture.height, " x 1");
  check(drawn.pixels.size() == frame.depth_mm.size(), "drawn has ", drawn.pixels.size(), " pixels, expected ",
        frame.depth_mm.size());
  if (texture) {
    check_scan(*texture, "texture");
    check(texture->picture.width == reference.picture.width && texture->picture.height == reference.picture.height,
          "texture is ", texture->picture.width, " x ", texture->picture.height, " pixels, reference ",
          reference.picture.width, " x ", reference.picture.height);
  }
  Image result = drawn;
  std::optional<DrawTextureResult> learned;  // what most frames, in which no lid shuts, do not need
  const MeshMotion motion(mesh, reference.picture, render::project(frame.camera, shape.points_mm));
  for (const Outline& outline : outlines_of(openings)) {
    if (!(motion.open_share(outline) < options.least_open) || !motion.stays_near(outline, frame.picture)) continue;
    if (!learned) learned = draw_texture(mesh, reference, shape, frame);
    const OpeningSheet sheet = opening_sheet(outline);
    const OpeningLayers layers = opening_layers(reference.picture, outline);
    const OpeningScene scene(sheet, layers);
    OpeningPose pose = fitted(scene, outline, motion, frame.picture);
    double by_layers = 0, by_mesh = 0;
    each_drawn(scene.view(pose), frame.picture, [&](const OpeningView::Pixel& pixel, std::size_t i) {
      if (learned->mask.pixels[i] == 0) return;
      by_layers += std::pow(pixel.grey - learned->picture.pixels[i], 2);
      by_mesh += std::pow(static_cast<double>(learned->drawn.pixels[i]) - learned->picture.pixels[i], 2);
    });
    if (!(by_layers < options.least_gain * by_mesh)) continue;
    // In the texture's own light.
    if (texture) std::fill(pose.light.begin(), pose.light.end(), 0);
    const OpeningLayers own = texture ? opening_layers(texture->picture, outline) : layers;
    each_drawn(OpeningScene(sheet, own).view(pose), frame.picture, [&](const OpeningView::Pixel& pixel, std::size_t i) {
      if (learned->mask.pixels[i] > 0)
        result.pixels[i] = static_cast<std::uint8_t>(std::clamp(pixel.grey + 0.5, 0.0, 255.0));
    });
  }
  return result;
}

}  // namespace face::transfer
