// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/add_teeth.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "nodes/base/check.h"
#include "nodes/base/luma.h"
#include "nodes/model/cylinder_grid.h"
#include "nodes/model/match_cylinder.h"
#include "nodes/model/scan_surface.h"
#include "nodes/model/skin_modes.h"

namespace face::model {
namespace {

constexpr Vec3f wall_colour = {0.42f, 0.12f, 0.12f};  // sRGB
constexpr Vec3f throat_colour = {0.16f, 0.03f, 0.03f};
constexpr float teeth_height_mm = 8;
constexpr int lip_shadow_px = 5;  // a column's teeth begin at most so far from the lip
constexpr int gap_px = 2;         // so many pixels that are no teeth end a column's teeth

// Position of the element with an id; empty = the first. Throws, with `name`, where there is none.
template <class T>
std::size_t index_of(const engine::Seq<T>& all, const std::string& id, const char* name) {
  check(!all.empty(), name, " is empty, expected at least 1 element");
  for (std::size_t i = 0; i < all.size(); ++i)
    if (id.empty() || all.id(i) == id) return i;
  fail(name, " has no element \"", id, "\"; the first is \"", all.id(0), "\"");
}

// Pixels between the lips.
cv::Mat between_lips(const CylinderScan& scan, const MeshPoints& shape, const std::vector<std::uint32_t>& loop) {
  cv::Mat mask = cv::Mat::zeros(scan.picture.height, scan.picture.width, CV_8U);
  std::vector<cv::Point> polygon;
  for (const std::uint32_t v : loop) {
    const CylinderPixel pixel = cylinder_pixel(scan, shape.points_mm[v]);
    polygon.emplace_back(cvRound(pixel.x_px), cvRound(pixel.y_px));
  }
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{polygon}, cv::Scalar(255));
  return mask;
}

// Of these, the teeth of one jaw.
cv::Mat teeth_mask(const CylinderScan& scan, const cv::Mat& mouth, bool upper, const AddTeethOptions& options) {
  const auto brightness = [&](int x, int y) {
    const std::uint8_t* p = scan.picture.pixels.data() + 3 * static_cast<std::size_t>(y * scan.picture.width + x);
    return luma<double>(p[0], p[1], p[2]);
  };
  std::vector<double> seen;
  for (int y = 0; y < mouth.rows; ++y)
    for (int x = 0; x < mouth.cols; ++x)
      if (mouth.at<std::uint8_t>(y, x) != 0) seen.push_back(brightness(x, y));
  cv::Mat teeth = cv::Mat::zeros(mouth.size(), CV_8U);
  if (seen.empty()) return teeth;
  const auto high = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() * 95 / 100);
  std::nth_element(seen.begin(), high, seen.end());
  const double least = options.least_brightness * *high;
  const auto is_tooth = [&](int x, int y) {
    const auto i = static_cast<std::size_t>(y * scan.picture.width + x);
    const std::uint8_t* p = scan.picture.pixels.data() + 3 * i;
    return brightness(x, y) > least && p[2] > options.least_whiteness * p[0] && scan.radius_mm[i] > 0;
  };
  for (int x = 0; x < mouth.cols; ++x) {
    int first = -1, last = -1;
    for (int y = 0; y < mouth.rows; ++y)
      if (mouth.at<std::uint8_t>(y, x) != 0) {
        if (first < 0) first = y;
        last = y;
      }
    if (first < 0) continue;
    const int step = upper ? 1 : -1;
    int y = upper ? first : last, waited = 0;
    while (y >= first && y <= last && !is_tooth(x, y) && waited <= lip_shadow_px) y += step, ++waited;
    if (waited > lip_shadow_px) continue;
    for (int missing = 0; y >= first && y <= last && missing < gap_px; y += step) {
      missing = is_tooth(x, y) ? 0 : missing + 1;
      if (missing == 0) teeth.at<std::uint8_t>(y, x) = 255;
    }
  }
  // A jaw whose teeth reach the other lip everywhere is not told apart: single columns that do are dropped.
  cv::morphologyEx(teeth, teeth, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  return teeth;
}

Vec3f moved(const RigidMotion& motion, const Vec3f& p) {
  Vec3f out{};
  for (std::size_t r = 0; r < 3; ++r) {
    double sum = motion.translation_mm[r];
    for (std::size_t c = 0; c < 3; ++c) sum += motion.rotation[3 * r + c] * static_cast<double>(p[c]);
    out[r] = static_cast<float>(sum);
  }
  return out;
}

// Vertices and triangles of a new part at the end of the mesh.
class PartBuilder {
 public:
  PartBuilder(Mesh& mesh, const char* name, float gloss) : mesh_(mesh) {
    part_ = {name, static_cast<std::uint32_t>(mesh.polygon_count()), 0, {1, 1, 1}, gloss, true};
  }
  std::uint32_t vertex(const Vec3f& point, const Vec3f& colour) {
    mesh_.points_mm.push_back(point);
    mesh_.colors_srgb.push_back(colour);
    mesh_.uvs.push_back({0, 0});
    return static_cast<std::uint32_t>(mesh_.points_mm.size() - 1);
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t v : {a, b, c}) {
      mesh_.corners.push_back(v);
      mesh_.corner_uvs.push_back(v);
    }
    mesh_.polygon_starts.push_back(static_cast<std::uint32_t>(mesh_.corners.size()));
    ++part_.polygon_count;
  }
  void finish() {
    if (part_.polygon_count > 0) mesh_.parts.push_back(part_);
  }

 private:
  Mesh& mesh_;
  Part part_;
};

// What is measured at a pixel; where nothing is, the mean of those about it: a lost pixel is no gap between teeth.
struct Measured {
  float radius_mm = 0;
  Vec3f colour = {0, 0, 0};
};
Measured measured_at(const CylinderScan& scan, int x, int y) {
  Measured sum;
  float count = 0;
  const auto add = [&](int column, int row) {
    if (column < 0 || row < 0 || column >= scan.picture.width || row >= scan.picture.height) return;
    const auto i = static_cast<std::size_t>(row * scan.picture.width + column);
    if (!(scan.radius_mm[i] > 0)) return;
    ++count;
    sum.radius_mm += scan.radius_mm[i];
    for (std::size_t k = 0; k < 3; ++k) sum.colour[k] += static_cast<float>(scan.picture.pixels[3 * i + k]) / 255;
  };
  add(x, y);
  if (count == 0)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) add(x + dx, y + dy);
  if (count == 0) return sum;
  sum.radius_mm /= count;
  for (float& c : sum.colour) c /= count;
  return sum;
}

void add_jaw(MorphableModel& surface, const CylinderScan& scan, const MeshPoints& shape,
             const std::vector<std::uint32_t>& loop, bool upper, const AddTeethOptions& options) {
  const OrientShapeResult rest = orient_shape(shape, surface);
  Vec3f offset = {0, 0, 0};
  if (!upper)
    for (std::size_t k = 0; k < 3; ++k)
      offset[k] = surface.mean.points_mm[surface.landmarks68[8]][k] - rest.shape.points_mm[surface.landmarks68[8]][k];
  const cv::Mat teeth = teeth_mask(scan, between_lips(scan, shape, loop), upper, options);
  constexpr std::int32_t nothing = -1, to_come = -2;
  std::vector<std::int32_t> number(static_cast<std::size_t>(teeth.rows * teeth.cols), nothing);
  PartBuilder part(surface.mean, upper ? upper_teeth_part : lower_teeth_part, 0.6f);
  const auto at = [&](int x, int y) -> std::int32_t& { return number[static_cast<std::size_t>(y * teeth.cols + x)]; };
  for (int y = 0; y < teeth.rows; ++y)
    for (int x = 0; x < teeth.cols; ++x)
      if (teeth.at<std::uint8_t>(y, x) != 0 && measured_at(scan, x, y).radius_mm > 0) at(x, y) = to_come;
  // Vertices come with their first triangle: one without any would belong to no part.
  const auto vertex = [&](int x, int y) {
    if (at(x, y) == to_come) {
      const Measured seen = measured_at(scan, x, y);
      Vec3f p = moved(rest.surface_from_scan, cylinder_world(scan, {static_cast<double>(x), static_cast<double>(y),
                                                                    static_cast<double>(seen.radius_mm)}));
      for (std::size_t k = 0; k < 3; ++k) p[k] += offset[k];
      at(x, y) = static_cast<std::int32_t>(part.vertex(p, seen.colour));
    }
    return static_cast<std::uint32_t>(at(x, y));
  };
  for (int y = 0; y + 1 < teeth.rows; ++y)
    for (int x = 0; x + 1 < teeth.cols; ++x) {
      // Around the cell, from its upper right corner by the upper left one: two triangles, or one of three corners.
      std::vector<cv::Point> corners;
      for (const cv::Point corner :
           {cv::Point(x + 1, y), cv::Point(x, y), cv::Point(x, y + 1), cv::Point(x + 1, y + 1)})
        if (at(corner.x, corner.y) != nothing) corners.push_back(corner);
      if (corners.size() < 3) continue;
      std::vector<std::uint32_t> around;
      for (const cv::Point corner : corners) around.push_back(vertex(corner.x, corner.y));
      for (std::size_t k = 2; k < around.size(); ++k) part.triangle(around[0], around[k - 1], around[k]);
    }
  part.finish();
}

void add_walls(MorphableModel& surface, const std::vector<std::uint32_t>& loop) {
  Mesh& mesh = surface.mean;
  Vec3f middle = {0, 0, 0};
  for (const std::uint32_t v : loop)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += mesh.points_mm[v][k] / static_cast<float>(loop.size());
  PartBuilder part(mesh, mouth_part, 0.3f);
  std::vector<std::uint32_t> before = loop;
  for (std::size_t ring = 0; ring < mouth_rings.size(); ++ring) {
    const float deep = static_cast<float>(ring) / static_cast<float>(mouth_rings.size());
    Vec3f colour{};
    for (std::size_t k = 0; k < 3; ++k) colour[k] = wall_colour[k] + deep * (throat_colour[k] - wall_colour[k]);
    std::vector<std::uint32_t> here;
    for (const std::uint32_t v : loop) {
      Vec3f p = mesh.points_mm[v];
      p[0] = middle[0] + mouth_rings[ring].width * (p[0] - middle[0]);
      p[1] = middle[1] + mouth_rings[ring].height * (p[1] - middle[1]);
      // Behind the lips the cavity is as high as the teeth, however little the mouth is open.
      const float side = mesh.points_mm[v][1] >= middle[1] ? 1.0f : -1.0f;
      p[1] += side * teeth_height_mm * (mouth_rings[ring].height - 1);
      p[2] -= mouth_rings[ring].back_mm;
      here.push_back(part.vertex(p, colour));
    }
    // The hole's edge runs clockwise seen from the front, so that the walls face the viewer.
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::size_t j = (i + 1) % loop.size();
      part.triangle(before[j], before[i], here[i]);
      part.triangle(before[j], here[i], here[j]);
    }
    before = std::move(here);
  }
  Vec3f throat = middle;
  throat[2] -= mouth_rings.back().back_mm + 5;
  const std::uint32_t end = part.vertex(throat, throat_colour);
  for (std::size_t i = 0; i < loop.size(); ++i) part.triangle(before[(i + 1) % loop.size()], before[i], end);
  part.finish();
}

}  // namespace

MorphableModel add_teeth(const MorphableModel& surface, const engine::Seq<CylinderScan>& scans,
                         const engine::Seq<MeshPoints>& shapes, const AddTeethOptions& options) {
  const std::size_t skin = skin_count(surface);
  check(skin == surface.mean.points_mm.size(), "surface has ", surface.mean.points_mm.size() - skin,
        " vertices that are not skin, expected none: does it have its teeth already?");
  MorphableModel whole = surface;
  const std::vector<std::uint32_t> loop = mouth_loop(surface);
  if (loop.empty()) return whole;
  for (const bool upper : {true, false}) {
    const std::string& id = upper ? options.upper : options.lower;
    const auto scan = scans.at(index_of(scans, id, "scans"));
    const MeshPoints shape = *shapes.at(index_of(shapes, id, "shapes"));
    check_cylinder(*scan, "scan");
    check(shape.points_mm.size() == skin, "shape has ", shape.points_mm.size(), " vertices, the surface's skin has ",
          skin);
    add_jaw(whole, *scan, shape, loop, upper, options);
  }
  add_walls(whole, loop);
  whole.mean_albedo = vertex_albedo(whole.mean);
  return whole;
}

}  // namespace face::model
