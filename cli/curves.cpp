// SPDX-License-Identifier: Apache-2.0
#include "cli/curves.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace cli {

std::string short_number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string curve_html(const std::vector<double>& values, std::size_t count) {
  std::size_t finite = 0;
  double low = INFINITY, high = -INFINITY, sum = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    ++finite;
    sum += value;
    low = std::min(low, value), high = std::max(high, value);
  }
  if (finite == 0) return "<p class=\"dim\">No finite number.</p>";
  constexpr double width = 640, height = 110;
  std::string path;
  bool pen = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      pen = false;
      continue;
    }
    const double x =
        values.size() > 1 ? width * static_cast<double>(i) / static_cast<double>(values.size() - 1) : width / 2;
    const double y = high > low ? height * (high - values[i]) / (high - low) : height / 2;
    char text[64];
    std::snprintf(text, sizeof text, "%s%.1f %.1f", pen ? "L" : "M", x, y);
    path += text;
    pen = true;
  }
  return "<div><svg class=\"curve\" viewBox=\"-4 -4 648 118\" role=\"img\" aria-label=\"curve\"><path d=\"" + path +
         "\"/></svg><p class=\"dim\">" + std::to_string(count) + " values, " + short_number(low) + " to " +
         short_number(high) + ", mean " + short_number(sum / static_cast<double>(finite)) + "</p></div>";
}

std::string curves_html(const std::vector<std::vector<double>>& lists, std::size_t count) {
  constexpr std::size_t most_curves = 6;
  static constexpr const char* colours[most_curves] = {"#2f6bb3", "#c8602a", "#3a8f4d",
                                                       "#a03c8c", "#8a7a1f", "#4d4d4d"};
  std::size_t width = 0;
  for (const auto& list : lists) width = std::max(width, list.size());
  std::vector<std::pair<double, std::size_t>> spans;
  double low = INFINITY, high = -INFINITY;
  for (std::size_t k = 0; k < width; ++k) {
    double from = INFINITY, to = -INFINITY;
    for (const auto& list : lists)
      if (k < list.size() && std::isfinite(list[k])) from = std::min(from, list[k]), to = std::max(to, list[k]);
    if (to > from) spans.emplace_back(to - from, k);
  }
  std::stable_sort(spans.begin(), spans.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  spans.resize(std::min(spans.size(), most_curves));
  if (spans.empty()) return {};
  for (const auto& [span, k] : spans)
    for (const auto& list : lists)
      if (k < list.size() && std::isfinite(list[k])) low = std::min(low, list[k]), high = std::max(high, list[k]);
  std::string paths, names;
  for (std::size_t c = 0; c < spans.size(); ++c) {
    const std::size_t k = spans[c].second;
    std::string path;
    for (std::size_t i = 0; i < lists.size(); ++i) {
      if (k >= lists[i].size() || !std::isfinite(lists[i][k])) continue;
      char text[64];
      std::snprintf(text, sizeof text, "%s%.1f %.1f", path.empty() ? "M" : "L",
                    640 * static_cast<double>(i) / static_cast<double>(lists.size() - 1),
                    110 * (high - lists[i][k]) / (high - low));
      path += text;
    }
    paths += "<path style=\"stroke:" + std::string(colours[c]) + "\" d=\"" + path + "\"/>";
    names += (names.empty() ? "" : ", ") + std::string("<span style=\"color:") + colours[c] + "\">" +
             std::to_string(k) + "</span>";
  }
  return "<div><svg class=\"curve\" viewBox=\"-4 -4 648 118\" role=\"img\" aria-label=\"curves\">" + paths +
         "</svg><p class=\"dim\">" + std::to_string(count) + " values of " + std::to_string(width) +
         " numbers; number " + names + (spans.size() == 1 ? " changes" : " change most") + ", from " +
         short_number(low) + " to " + short_number(high) + "</p></div>";
}

}  // namespace cli
