// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/cylinder_curvature.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "nodes/base/check.h"

namespace face::flow {
namespace {

constexpr double head_radius_mm = 90;   // where columns are as far apart as the smoothing takes them to be
constexpr float least_measured = 0.3f;  // share of the Gaussian's weight
constexpr double longest = 2;           // what curvature times scale tends to

// The radius smoothed over what is measured; 0 where that is too little.
cv::Mat smoothed(const CylinderScan& scan, double scale_mm) {
  const cv::Mat radius(scan.picture.height, scan.picture.width, CV_32F, const_cast<float*>(scan.radius_mm.data()));
  const cv::Mat measured = cv::Mat(radius > 0) / 255;
  cv::Mat share, sum;
  measured.convertTo(share, CV_32F);
  radius.copyTo(sum, radius > 0);
  const double rows = scale_mm / static_cast<double>(scan.step_mm),
               columns = scale_mm / (head_radius_mm * static_cast<double>(scan.phi_step_rad));
  cv::GaussianBlur(sum, sum, {0, 0}, columns, rows, cv::BORDER_REPLICATE);
  cv::GaussianBlur(share, share, {0, 0}, columns, rows, cv::BORDER_REPLICATE);
  cv::Mat out = cv::Mat::zeros(radius.size(), CV_32F);
  for (int y = 0; y < out.rows; ++y)
    for (int x = 0; x < out.cols; ++x)
      if (share.at<float>(y, x) > least_measured) out.at<float>(y, x) = sum.at<float>(y, x) / share.at<float>(y, x);
  return out;
}

}  // namespace

CylinderCurvature cylinder_curvature(const CylinderScan& scan, double scale_mm) {
  const std::size_t count =
      static_cast<std::size_t>(scan.picture.width) * static_cast<std::size_t>(scan.picture.height);
  check(scan.radius_mm.size() == count, "scan has ", scan.radius_mm.size(), " radii, its picture is ",
        scan.picture.width, " x ", scan.picture.height, " pixels");
  check(scan.step_mm > 0 && scan.phi_step_rad > 0, "scan has steps of ", scan.step_mm, " mm and ", scan.phi_step_rad,
        " rad, expected more than 0");
  check(scale_mm > 0, "scale_mm is ", scale_mm, ", expected more than 0");
  CylinderCurvature result{std::vector<float>(count, 0.0f), std::vector<std::uint8_t>(count, 0)};
  if (count == 0) return result;
  const cv::Mat radius = smoothed(scan, scale_mm);
  const double step = static_cast<double>(scan.step_mm), turn = static_cast<double>(scan.phi_step_rad);
  for (int y = 1; y + 1 < radius.rows; ++y)
    for (int x = 1; x + 1 < radius.cols; ++x) {
      double at[3][3];
      bool known = true;
      for (int dy = 0; dy < 3; ++dy)
        for (int dx = 0; dx < 3; ++dx) {
          at[dy][dx] = static_cast<double>(radius.at<float>(y + dy - 1, x + dx - 1));
          known = known && at[dy][dx] > 0;
        }
      if (!known) continue;
      // Derivatives by height, which falls from row to row, and by angle.
      const double r = at[1][1], rh = (at[0][1] - at[2][1]) / (2 * step), rp = (at[1][2] - at[1][0]) / (2 * turn),
                   rhh = (at[0][1] - 2 * r + at[2][1]) / (step * step),
                   rpp = (at[1][2] - 2 * r + at[1][0]) / (turn * turn),
                   rhp = (at[0][2] - at[0][0] - at[2][2] + at[2][0]) / (4 * step * turn);
      // First and second fundamental form with respect to (h, phi).
      const double e = 1 + rh * rh, f = rh * rp, g = r * r + rp * rp, area = std::sqrt(e * g - f * f);
      const double l = r * rhh / area, m = (r * rhp - rp * rh) / area, n = (r * (rpp - r) - 2 * rp * rp) / area;
      const double bulge = -scale_mm * (e * n - 2 * f * m + g * l) / (2 * area * area);
      const auto i = static_cast<std::size_t>(y * radius.cols + x);
      result.times_scale[i] = static_cast<float>(bulge / std::sqrt(1 + bulge * bulge / (longest * longest)));
      result.known[i] = 1;
    }
  return result;
}

}  // namespace face::flow
