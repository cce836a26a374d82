// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/draw_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace face::evaluate {
namespace {

cv::Mat view_of(Image& image) { return {image.height, image.width, CV_8UC3, image.pixels.data()}; }
cv::Scalar scalar(const Colour& colour) { return {double(colour[0]), double(colour[1]), double(colour[2])}; }

// Sixteenths of a pixel.
cv::Point fine_point(const Place& place) {
  const auto to = [](double v) { return static_cast<int>(std::lround(16 * std::clamp(v, -1e5, 1e5))); };
  return {to(place.x_px), to(place.y_px)};
}

}  // namespace

Canvas::Canvas(int width_px, int height_px) : image_{width_px, height_px, 3, {}} {
  image_.pixels.resize(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 3);
  fill(0, 0, width_px, height_px, paper);
}

void Canvas::fill(int x_px, int y_px, int width_px, int height_px, const Colour& colour) {
  cv::Mat mat = view_of(image_);
  const cv::Rect all(0, 0, image_.width, image_.height);
  mat(cv::Rect(x_px, y_px, std::max(0, width_px), std::max(0, height_px)) & all).setTo(scalar(colour));
}

void Canvas::paste(const Image& rgb, int x_px, int y_px) {
  const cv::Rect all(0, 0, image_.width, image_.height), at(x_px, y_px, rgb.width, rgb.height), seen = at & all;
  if (seen.empty()) return;
  cv::Mat mat = view_of(image_);
  Image source = rgb;
  view_of(source)(cv::Rect(seen.x - x_px, seen.y - y_px, seen.width, seen.height)).copyTo(mat(seen));
}

void Canvas::line(const Place& from, const Place& to, const Colour& colour, int thickness_px) {
  cv::Mat mat = view_of(image_);
  cv::line(mat, fine_point(from), fine_point(to), scalar(colour), thickness_px, cv::LINE_AA, 4);
}

int Canvas::text(const std::string& text, const Place& at, double capital_px, const Colour& colour, Anchor anchor) {
  std::string shown;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 32 && byte < 127)
      shown += c;
    else if (byte < 0x80 || byte >= 0xC0)
      shown += '?';
  }
  const double scale = capital_px / 22;  // of the font: a capital at scale 1 is 22 pixels high
  int base_line = 0;
  const cv::Size size = cv::getTextSize(shown, cv::FONT_HERSHEY_SIMPLEX, scale, 1, &base_line);
  const int shift = anchor == Anchor::left ? 0 : anchor == Anchor::middle ? size.width / 2 : size.width;
  cv::Mat mat = view_of(image_);
  const cv::Point corner(static_cast<int>(std::lround(at.x_px)) - shift, static_cast<int>(std::lround(at.y_px)));
  cv::putText(mat, shown, corner, cv::FONT_HERSHEY_SIMPLEX, scale, scalar(colour), 1, cv::LINE_AA);
  return size.width;
}

std::string short_number(double value) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 4).ptr;
  const std::string written(text, end);
  return written == "-0" ? "0" : written;
}

std::vector<double> ticks_between(double low, double high) {
  if (!(high > low)) return {low};
  const double raw = (high - low) / 5, power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= 0.999 * raw) step = factor * power;
  std::vector<double> ticks;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step && ticks.size() < 50; ++k)
    ticks.push_back(k * step);
  return ticks;
}

}  // namespace face::evaluate
