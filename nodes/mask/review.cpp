// SPDX-License-Identifier: Apache-2.0
#include "nodes/mask/review.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "nodes/base/check.h"
#include "nodes/base/quantile.h"
#include "nodes/base/scan_points.h"

namespace face::mask {
namespace {

struct Areas {
  double area, low, high, proposed_mm;
};

Areas areas_of(const Table& report, const std::string& id) {
  check(report.rows.size() == 1 && report.columns.size() == 5 && report.rows[0].values.size() == 5, "report of frame ",
        id, " has ", report.rows.size(), " rows of ", report.columns.size(), " columns, expected 1 of 5");
  const std::vector<double>& v = report.rows[0].values;
  return {v[1], v[2], v[3], v[4]};
}

// The mouth of a frame, scaled by nearest pixels, the interior red.
void draw(const DepthScan& scan, const Image& interior, const std::array<int, 4>& box, int side, int left, int top,
          Image& sheet) {
  const double scale = static_cast<double>(std::max(box[2], box[3])) / side;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const int sx = box[0] + static_cast<int>((x - side / 2) * scale) + box[2] / 2,
                sy = box[1] + static_cast<int>((y - side / 2) * scale) + box[3] / 2;
      if (sx < 0 || sy < 0 || sx >= interior.width || sy >= interior.height) continue;
      const auto i = static_cast<std::size_t>(sy * interior.width + sx);
      const std::uint8_t grey = scan.picture.pixels[i * static_cast<std::size_t>(scan.picture.channels)];
      std::uint8_t* p = sheet.pixels.data() + static_cast<std::size_t>((top + y) * sheet.width + left + x) * 3;
      const bool inside = interior.pixels[i] >= 128;
      p[0] = inside ? static_cast<std::uint8_t>(128 + grey / 2) : grey;
      p[1] = p[2] = inside ? static_cast<std::uint8_t>(grey / 2) : grey;
    }
}

}  // namespace

ReviewResult review(const engine::Seq<DepthScan>& scans, const engine::Seq<Image>& interiors,
                    const engine::Seq<Table>& reports, const ReviewOptions& options) {
  check(scans.size() == reports.size() && interiors.size() == reports.size(), "scans has ", scans.size(),
        " frames, interiors ", interiors.size(), ", reports ", reports.size());
  const std::size_t count = reports.size();
  std::vector<Areas> areas;
  for (std::size_t t = 0; t < count; ++t) areas.push_back(areas_of(*reports.at(t), reports.id(t)));
  ReviewResult result;
  result.doubtful.columns = {"proposed_mm", "instability", "departure"};
  std::vector<std::size_t> shown;
  std::string lines;
  for (std::size_t t = 0; t < count; ++t) {
    std::vector<double> about;
    for (std::size_t k = t > 2 ? t - 2 : 0; k < std::min(count, t + 3); ++k) about.push_back(areas[k].area);
    const double middle = median(std::move(about));
    const double usual = std::max(middle, 30.0), own = std::max(areas[t].area, 30.0);
    const double instability = std::fabs(areas[t].low - areas[t].high) / own;
    const double departure = std::fabs(areas[t].area - middle) / usual;
    if (instability <= options.doubt && departure <= options.doubt) continue;
    shown.push_back(t);
    result.doubtful.rows.push_back({reports.id(t), {areas[t].proposed_mm, instability, departure}});
    char number[32];
    std::snprintf(number, sizeof number, "%.2f", areas[t].proposed_mm);
    lines +=
        (lines.empty() ? "" : ",\n ") + std::string("\"") + reports.id(t) + "\": {\"threshold_mm\": " + number + "}";
  }
  result.overrides = "{" + lines + "}\n";

  // Doubtful frames, then others at equal steps.
  const auto wanted = static_cast<std::size_t>(options.pictures);
  if (shown.size() > wanted) shown.resize(wanted);
  for (std::size_t k = 0; shown.size() < std::min(wanted, count) && k < wanted; ++k) {
    const std::size_t t = k * count / wanted;
    if (std::find(shown.begin(), shown.end(), t) == shown.end()) shown.push_back(t);
  }
  for (const std::size_t t : shown) {
    const auto scan = scans.at(t);
    const auto interior = interiors.at(t);
    check_scan(*scan, ("scan of frame " + scans.id(t)).c_str());
    check(interior->width == scan->picture.width && interior->height == scan->picture.height &&
              interior->channels == 1 && interior->pixels.size() == scan->depth_mm.size(),
          "interior of frame ", interiors.id(t), " is ", interior->width, " x ", interior->height, " pixels with ",
          interior->pixels.size(), " values, expected ", scan->picture.width, " x ", scan->picture.height,
          " as its scan, one value each");
  }
  // One box for all: where anything was removed in any shown frame, and a third about it.
  int x0 = 1 << 30, y0 = 1 << 30, x1 = -1, y1 = -1;
  for (const std::size_t t : shown) {
    const auto interior = interiors.at(t);
    for (int y = 0; y < interior->height; ++y)
      for (int x = 0; x < interior->width; ++x)
        if (interior->pixels[static_cast<std::size_t>(y * interior->width + x)] >= 128) {
          x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
        }
  }
  if (x1 < 0 && count > 0) x0 = y0 = 0, x1 = interiors.at(0)->width - 1, y1 = interiors.at(0)->height - 1;
  const int pad = (x1 - x0) / 3 + 4;
  const std::array<int, 4> box = {x0 - pad, y0 - pad, x1 - x0 + 1 + 2 * pad, y1 - y0 + 1 + 2 * pad};
  const int side = static_cast<int>(options.picture_px), columns = static_cast<int>(options.columns);
  const int rows = std::max(1, (static_cast<int>(shown.size()) + columns - 1) / columns);
  result.sheet = {side * columns, side * rows, 3,
                  std::vector<std::uint8_t>(
                      static_cast<std::size_t>(side * columns) * static_cast<std::size_t>(side * rows) * 3, 20)};
  for (std::size_t k = 0; k < shown.size(); ++k)
    draw(*scans.at(shown[k]), *interiors.at(shown[k]), box, side, static_cast<int>(k) % columns * side,
         static_cast<int>(k) / columns * side, result.sheet);
  return result;
}

}  // namespace face::mask
