// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/scan_maps.h"

#include <Eigen/Dense>
#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "nodes/base/eigen_vector.h"
#include "nodes/flow/cylinder_curvature.h"
#include "nodes/model/cylinder_grid.h"

namespace face::model {
namespace {

constexpr double radius_blur_mm = 1.2;  // noise of 0.1 mm turns a normal between pixels by 5 degrees
constexpr std::array<double, 2> colour_blur_mm = {5, 1.5};  // coarse, fine
constexpr double head_radius_mm = 90;    // where columns are as far apart as the smoothing takes them to be
constexpr float least_measured = 0.25f;  // share of the Gaussian's weight

// Smoothed over the pixels that count (normalised convolution); 0 where those are too few.
cv::Mat smoothed(const cv::Mat& map, const cv::Mat& counts, double columns_px, double rows_px) {
  cv::Mat sum, share;
  cv::GaussianBlur(map.mul(counts), sum, {0, 0}, columns_px, rows_px, cv::BORDER_REPLICATE);
  cv::GaussianBlur(counts, share, {0, 0}, columns_px, rows_px, cv::BORDER_REPLICATE);
  cv::Mat out = cv::Mat::zeros(map.size(), CV_32F);
  for (int y = 0; y < out.rows; ++y)
    for (int x = 0; x < out.cols; ++x)
      if (share.at<float>(y, x) > least_measured) out.at<float>(y, x) = sum.at<float>(y, x) / share.at<float>(y, x);
  return out;
}

// Between pixels; the place is at least a pixel inside.
double between(const cv::Mat& map, double x_px, double y_px) {
  const int x = static_cast<int>(x_px), y = static_cast<int>(y_px);
  const double fx = x_px - x, fy = y_px - y;
  const auto at = [&](int dx, int dy) { return static_cast<double>(map.at<float>(y + dy, x + dx)); };
  return (at(0, 0) * (1 - fx) + at(1, 0) * fx) * (1 - fy) + (at(0, 1) * (1 - fx) + at(1, 1) * fx) * fy;
}

}  // namespace

class ScanMaps::Maps {
 public:
  Maps(const CylinderScan& scan, double curvature_scale_mm);
  std::optional<ScanPlace> find(const std::array<double, 3>& point_mm) const;
  ScanValue value(const cv::Mat& map, const ScanPlace& place) const;

  const cv::Mat& colour(std::size_t channel, Detail detail) const { return colours_[detail][channel]; }
  const cv::Mat& curvature() const { return curvature_; }

 private:
  CylinderScan grid_;  // axis and steps; radii and colours are in the maps
  cv::Mat radius_;     // mm, 0 where nothing is measured, or too little about it for a normal
  std::array<cv::Mat, 3> normal_;
  std::array<std::array<cv::Mat, colours>, 2> colours_;
  cv::Mat curvature_;
};

ScanMaps::Maps::Maps(const CylinderScan& scan, double curvature_scale_mm) {
  check_cylinder(scan, "scan");
  grid_ = scan;
  const cv::Size size(scan.picture.width, scan.picture.height);
  const double step = static_cast<double>(scan.step_mm), turn = head_radius_mm * static_cast<double>(scan.phi_step_rad);
  const cv::Mat radius(size, CV_32F, grid_.radius_mm.data());
  cv::Mat measured;
  cv::Mat(radius > 0).convertTo(measured, CV_32F, 1 / 255.0);
  const cv::Mat smooth = smoothed(radius, measured, radius_blur_mm / turn, radius_blur_mm / step);
  radius_ = cv::Mat::zeros(size, CV_32F);
  for (cv::Mat& axis : normal_) axis = cv::Mat::zeros(size, CV_32F);
  for (int y = 1; y + 1 < size.height; ++y)
    for (int x = 1; x + 1 < size.width; ++x) {
      const auto at = [&](int dx, int dy) { return smooth.at<float>(y + dy, x + dx); };
      if (!(measured.at<float>(y, x) > 0) || !(std::min({at(-1, 0), at(1, 0), at(0, -1), at(0, 1)}) > 0)) continue;
      const auto point = [&](int dx, int dy) {
        return vector_of(cylinder_world(
            grid_, {static_cast<double>(x + dx), static_cast<double>(y + dy), static_cast<double>(at(dx, dy))}));
      };
      const Eigen::Vector3d normal = (point(1, 0) - point(-1, 0)).cross(point(0, -1) - point(0, 1)).normalized();
      for (std::size_t k = 0; k < 3; ++k) normal_[k].at<float>(y, x) = static_cast<float>(normal[static_cast<int>(k)]);
      radius_.at<float>(y, x) = at(0, 0);
    }

  const cv::Mat picture(size, CV_8UC3, grid_.picture.pixels.data());
  cv::Mat numbers, seen = cv::Mat::zeros(size, CV_32F);
  picture.convertTo(numbers, CV_32FC3);
  std::vector<cv::Mat> rgb;
  cv::split(numbers, rgb);
  const cv::Mat sum_before = rgb[0] + rgb[1] + rgb[2];
  cv::Mat(sum_before > 3).convertTo(seen, CV_32F, 1 / 255.0);
  for (const Detail detail : {coarse, fine}) {
    std::array<cv::Mat, colours> smooth_rgb;
    for (std::size_t k = 0; k < colours; ++k)
      smooth_rgb[k] = smoothed(rgb[k], seen, colour_blur_mm[detail] / turn, colour_blur_mm[detail] / step);
    const cv::Mat sum = smooth_rgb[0] + smooth_rgb[1] + smooth_rgb[2] + 10;
    std::array<cv::Mat, colours>& to = colours_[detail];
    cv::log(sum, to[0]);
    to[0] *= 60;
    cv::divide(smooth_rgb[0], sum, to[1], 300);
    cv::divide(smooth_rgb[2], sum, to[2], 300);
  }

  flow::CylinderCurvature curvature = flow::cylinder_curvature(scan, curvature_scale_mm);
  curvature_ = cv::Mat(size, CV_32F, curvature.times_scale.data()).clone();
}

std::optional<ScanPlace> ScanMaps::Maps::find(const std::array<double, 3>& point_mm) const {
  const CylinderPixel pixel = cylinder_pixel(
      grid_, {static_cast<float>(point_mm[0]), static_cast<float>(point_mm[1]), static_cast<float>(point_mm[2])});
  if (!(pixel.x_px >= 1 && pixel.y_px >= 1 && pixel.x_px < radius_.cols - 2 && pixel.y_px < radius_.rows - 2))
    return {};
  const int x = static_cast<int>(pixel.x_px), y = static_cast<int>(pixel.y_px);
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx)
      if (!(radius_.at<float>(y + dy, x + dx) > 0)) return {};
  Eigen::Vector3d normal;
  for (std::size_t k = 0; k < 3; ++k) normal[static_cast<int>(k)] = between(normal_[k], pixel.x_px, pixel.y_px);
  if (!(normal.norm() > 0.5)) return {};  // an edge, where normals about it point anywhere
  const Vec3f point = cylinder_world(grid_, {pixel.x_px, pixel.y_px, between(radius_, pixel.x_px, pixel.y_px)});
  return ScanPlace{pixel.x_px, pixel.y_px, array_of(vector_of(point)), array_of(normal.normalized())};
}

ScanValue ScanMaps::Maps::value(const cv::Mat& map, const ScanPlace& place) const {
  constexpr double reach_px = 0.7;
  const double x = place.x_px, y = place.y_px;
  const double by_x = (between(map, x + reach_px, y) - between(map, x - reach_px, y)) / (2 * reach_px),
               by_y = (between(map, x, y + reach_px) - between(map, x, y - reach_px)) / (2 * reach_px);
  const Eigen::Vector3d up = vector_of(grid_.axis.direction);
  Eigen::Vector3d out = vector_of(place.point_mm) - vector_of(grid_.axis.origin_mm);
  out -= out.dot(up) * up;
  const double radius = out.norm();
  const Eigen::Vector3d around = up.cross(out) / radius;
  Eigen::Vector3d gradient = by_x / (static_cast<double>(grid_.phi_step_rad) * radius) * around -
                             by_y / static_cast<double>(grid_.step_mm) * up;
  const Eigen::Vector3d normal = vector_of(place.normal);
  gradient -= gradient.dot(normal) * normal;
  return {between(map, x, y), array_of(gradient)};
}

ScanMaps::ScanMaps(const CylinderScan& scan, double curvature_scale_mm)
    : maps_(std::make_unique<const Maps>(scan, curvature_scale_mm)) {}
ScanMaps::~ScanMaps() = default;

std::optional<ScanPlace> ScanMaps::find(const std::array<double, 3>& point_mm) const { return maps_->find(point_mm); }
ScanValue ScanMaps::colour(const ScanPlace& place, std::size_t channel, Detail detail) const {
  return maps_->value(maps_->colour(channel, detail), place);
}
ScanValue ScanMaps::curvature(const ScanPlace& place) const { return maps_->value(maps_->curvature(), place); }

}  // namespace face::model
