// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/find_face.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace face::track {
namespace {

constexpr int face_width_px = 40;

struct Box {
  int x = 0, y = 0, width = 0, height = 0;
  double scale = 1;  // of the small picture
};

Box box_of(const Landmarks& points, int width, int height) {
  if (points.points.size() < 2) return {};
  double x0 = 1e9, y0 = 1e9, x1 = -1e9, y1 = -1e9;
  for (const Landmark& p : points.points) {
    x0 = std::min(x0, p.x_px), x1 = std::max(x1, p.x_px);
    y0 = std::min(y0, p.y_px), y1 = std::max(y1, p.y_px);
  }
  const double margin = 0.15 * std::max(x1 - x0, y1 - y0);
  Box box;
  box.x = std::max(0, static_cast<int>(std::floor(x0 - margin)));
  box.y = std::max(0, static_cast<int>(std::floor(y0 - margin)));
  box.width = std::min(width - 1, static_cast<int>(std::ceil(x1 + margin))) - box.x + 1;
  box.height = std::min(height - 1, static_cast<int>(std::ceil(y1 + margin))) - box.y + 1;
  if (box.width < 4 || box.height < 4) return {};
  box.scale = std::min(1.0, static_cast<double>(face_width_px) / box.width);
  return box;
}

cv::Mat matrix_of(const Grey& grey) {
  return cv::Mat(grey.height, grey.width, CV_32F, const_cast<float*>(grey.values.data()));  // only read
}

cv::Mat shrunk(const cv::Mat& picture, double scale) {
  cv::Mat small;
  const cv::Size size(std::max(1, static_cast<int>(std::lround(picture.cols * scale))),
                      std::max(1, static_cast<int>(std::lround(picture.rows * scale))));
  cv::resize(picture, small, size, 0, 0, cv::INTER_AREA);
  cv::Mat bytes;
  small.convertTo(bytes, CV_8U);
  return bytes;
}

struct Moments {
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
};

// Means, variances and covariance of every 16th pixel.
Moments moments_of(const Grey& a, const Grey& b) {
  Moments m;
  double count = 0;
  for (int y = 2; y < a.height; y += 4)
    for (int x = 2; x < a.width; x += 4) {
      const auto i = static_cast<std::size_t>(y * a.width + x);
      const double u = static_cast<double>(a.values[i]), v = static_cast<double>(b.values[i]);
      m.a += u, m.b += v, m.aa += u * u, m.bb += v * v, m.ab += u * v;
      ++count;
    }
  if (count == 0) return {};
  m.a /= count, m.b /= count;
  m.aa = m.aa / count - m.a * m.a;
  m.bb = m.bb / count - m.b * m.b;
  m.ab = m.ab / count - m.a * m.b;
  return m;
}

}  // namespace

Image learn_face(const Grey& grey, const Landmarks& points) {
  const Box box = box_of(points, grey.width, grey.height);
  if (box.width == 0) return {0, 0, 1, {}};
  const cv::Mat small = shrunk(matrix_of(grey)(cv::Rect(box.x, box.y, box.width, box.height)), box.scale);
  Image face{small.cols, small.rows, 1, {}};
  for (int y = 0; y < small.rows; ++y) face.pixels.insert(face.pixels.end(), small.ptr(y), small.ptr(y) + small.cols);
  return face;
}

FaceMatch find_face(const Grey& grey, const Landmarks& points, const Image& face) {
  const Box box = box_of(points, grey.width, grey.height);
  FaceMatch match;
  if (box.width == 0 || face.width == 0 || is_even(grey)) return match;
  const cv::Mat small = shrunk(matrix_of(grey), box.scale);
  const cv::Mat wanted(face.height, face.width, CV_8U, const_cast<std::uint8_t*>(face.pixels.data()));  // only read
  if (small.cols < wanted.cols || small.rows < wanted.rows) return match;
  cv::Mat likeness;
  cv::matchTemplate(small, wanted, likeness, cv::TM_CCOEFF_NORMED);
  double best = 0;
  cv::Point place;
  cv::minMaxLoc(likeness, nullptr, &best, nullptr, &place);
  match.dx_px = place.x / box.scale - box.x;
  match.dy_px = place.y / box.scale - box.y;
  match.likeness = std::isfinite(best) ? best : -1;
  return match;
}

double spread_of(const Grey& grey) { return std::sqrt(std::max(0.0, moments_of(grey, grey).aa)); }

bool is_even(const Grey& grey) { return spread_of(grey) < 3; }

bool is_cut(const Grey& before, const Grey& now) {
  if (before.width != now.width || before.height != now.height) return true;
  const Moments m = moments_of(before, now);
  return m.aa < 9 || m.bb < 9 || m.ab < 0.5 * std::sqrt(m.aa * m.bb);
}

}  // namespace face::track
