// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/flow_pair.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace face::track {

struct FlowPair::Pyramids {
  std::vector<cv::Mat> before, now;
  cv::Size window;
  int levels = 0;
  int width = 0, height = 0;

  std::vector<Sighting> follow(const std::vector<cv::Mat>& from, const std::vector<cv::Mat>& to,
                               const std::vector<Sighting>& points, const std::vector<Sighting>& guesses,
                               const std::vector<int>& sides_px) const {
    std::vector<Sighting> out = follow(from, to, points, guesses, window.width, levels);
    for (int side = 3; side < window.width; side += 2) {
      std::vector<std::size_t> chosen;
      std::vector<Sighting> some, guess;
      for (std::size_t i = 0; i < points.size(); ++i)
        if (sides_px[i] == side && is_seen(out[i])) {
          chosen.push_back(i);
          some.push_back(points[i]);
          guess.push_back(out[i]);
        }
      const std::vector<Sighting> fine = follow(from, to, some, guess, side, 0);
      for (std::size_t k = 0; k < chosen.size(); ++k) out[chosen[k]] = fine[k];
    }
    return out;
  }

  std::vector<Sighting> follow(const std::vector<cv::Mat>& from, const std::vector<cv::Mat>& to,
                               const std::vector<Sighting>& points, const std::vector<Sighting>& guesses, int side_px,
                               int top) const {
    if (points.empty()) return {};
    std::vector<cv::Point2f> a, b;
    for (const Sighting& p : points) a.emplace_back(static_cast<float>(p.x_px), static_cast<float>(p.y_px));
    for (const Sighting& p : guesses) b.emplace_back(static_cast<float>(p.x_px), static_cast<float>(p.y_px));
    std::vector<std::uint8_t> found;
    std::vector<float> error;
    const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 0.001);
    cv::calcOpticalFlowPyrLK(from, to, a, b, found, error, {side_px, side_px}, top, until,
                             cv::OPTFLOW_USE_INITIAL_FLOW);
    std::vector<Sighting> out = points;
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i].x_px = static_cast<double>(b[i].x);
      out[i].y_px = static_cast<double>(b[i].y);
      if (!found[i] || !is_inside(out[i].x_px, out[i].y_px, width, height)) forget(out[i]);
    }
    return out;
  }
};

FlowPair::FlowPair(const Grey& before, const Grey& now, int side_px, int levels)
    : pyramids_(std::make_unique<Pyramids>()) {
  const auto build = [&](const Grey& grey, std::vector<cv::Mat>& pyramid) {
    const cv::Mat values(grey.height, grey.width, CV_32F, const_cast<float*>(grey.values.data()));  // only read
    cv::Mat bytes;
    values.convertTo(bytes, CV_8U);
    pyramids_->levels = cv::buildOpticalFlowPyramid(bytes, pyramid, pyramids_->window, levels);
  };
  pyramids_->window = cv::Size(side_px, side_px);
  pyramids_->width = now.width;
  pyramids_->height = now.height;
  build(before, pyramids_->before);
  build(now, pyramids_->now);
}

FlowPair::~FlowPair() = default;

std::vector<Sighting> FlowPair::forth(const std::vector<Sighting>& points, const std::vector<Sighting>& guesses,
                                      const std::vector<int>& sides_px) const {
  return pyramids_->follow(pyramids_->before, pyramids_->now, points, guesses, sides_px);
}

std::vector<Sighting> FlowPair::back(const std::vector<Sighting>& points, const std::vector<Sighting>& guesses,
                                     const std::vector<int>& sides_px) const {
  return pyramids_->follow(pyramids_->now, pyramids_->before, points, guesses, sides_px);
}

void add_information(const Grey& grey, int side_px, Sighting& place) {
  constexpr double grey_noise = 5;  // 8-bit steps; compressed video
  const double half = (side_px - 1) / 2.0;
  double xx = 0, xy = 0, yy = 0;
  for (int v = 0; v < side_px; ++v)
    for (int u = 0; u < side_px; ++u) {
      const double x = place.x_px + u - half, y = place.y_px + v - half;
      const double gx = static_cast<double>(grey.at(x + 1, y) - grey.at(x - 1, y)) / 2;
      const double gy = static_cast<double>(grey.at(x, y + 1) - grey.at(x, y - 1)) / 2;
      xx += gx * gx;
      xy += gx * gy;
      yy += gy * gy;
    }
  const double scale = 1 / (side_px * side_px * grey_noise * grey_noise);
  xx *= scale, xy *= scale, yy *= scale;
  // M + M M has the eigenvectors of M.
  place.xx = xx + xx * xx + xy * xy;
  place.xy = xy + xy * (xx + yy);
  place.yy = yy + yy * yy + xy * xy;
}

}  // namespace face::track
