// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/opening_sheet.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace face::transfer {
namespace {

constexpr int stride = sheet_stride_px;
// Shares of an opening's length: how far from it a lid's skin moves, along it and across it (14 and 18 pixels of an eye
// 57 pixels long); how far apart light is told.
constexpr double margin_along = 0.25, margin_across = 0.32, light_step = 0.175;
constexpr double snap = 0.7;  // pixels: vertices so near to the outline lie on it

// Cuts a grid of triangles at the outline.
class SheetCutter {
 public:
  SheetCutter(const Outline& outline, OpeningSheet& sheet) : outline_(outline), sheet_(sheet) {
    const auto count = static_cast<std::size_t>(sheet.columns * sheet.rows);
    vertex_.assign(count, -1);
    for (std::size_t i = 0; i < count; ++i) {
      Place place = {static_cast<double>(sheet.left + stride * column(i)),
                     static_cast<double>(sheet.top + stride * row(i))};
      Place nearest{};
      double away = outline.distance(place, &nearest);
      if (std::fabs(away) < snap) {
        place = nearest;
        away = 0;
      }
      place_.push_back(place);
      away_.push_back(away);
    }
    for (std::size_t i = 0; i < count; ++i)
      if (away_[i] >= 0) vertex_[i] = add(place_[i]);
  }

  void cut() {
    const int columns = sheet_.columns, rows = sheet_.rows;
    for (int r = 0; r + 1 < rows; ++r)
      for (int c = 0; c + 1 < columns; ++c) {
        const std::size_t a = at(c, r), b = at(c + 1, r), d = at(c, r + 1), e = at(c + 1, r + 1);
        if ((r + c) % 2) {
          keep({a, d, b});
          keep({b, d, e});
        } else {
          keep({a, d, e});
          keep({a, e, b});
        }
      }
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        if (c > 0 && c + 1 < columns) keep_line(at(c - 1, r), at(c, r), at(c + 1, r));
        if (r > 0 && r + 1 < rows) keep_line(at(c, r - 1), at(c, r), at(c, r + 1));
      }
    for (int c = 0; c < columns; ++c) sheet_.rim.push_back(id(at(c, 0)));
    for (int r = 1; r < rows; ++r) sheet_.rim.push_back(id(at(columns - 1, r)));
    for (int c = columns - 2; c >= 0; --c) sheet_.rim.push_back(id(at(c, rows - 1)));
    for (int r = rows - 2; r > 0; --r) sheet_.rim.push_back(id(at(0, r)));
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const render::Triangle& t : sheet_.triangles)
      for (std::size_t k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
    sheet_.edges.assign(edges.begin(), edges.end());
    find_hole();
    follow_outline();
  }

 private:
  int column(std::size_t i) const { return static_cast<int>(i) % sheet_.columns; }
  int row(std::size_t i) const { return static_cast<int>(i) / sheet_.columns; }
  std::size_t at(int c, int r) const { return static_cast<std::size_t>(r * sheet_.columns + c); }
  std::uint32_t id(std::size_t i) const { return static_cast<std::uint32_t>(vertex_[i]); }
  std::int64_t add(const Place& place) {
    sheet_.places.push_back(place);
    return static_cast<std::int64_t>(sheet_.places.size()) - 1;
  }

  // The vertex on the way from one outside to one inside. It moves as the line outside goes on.
  std::uint32_t crossing(std::size_t out, std::size_t in) {
    const auto found = crossings_.find({out, in});
    if (found != crossings_.end()) return found->second;
    const double share = away_[out] / (away_[out] - away_[in]);
    const auto v = static_cast<std::uint32_t>(add(place_[out] + share * (place_[in] - place_[out])));
    const int c = 2 * column(out) - column(in), r = 2 * row(out) - row(in);
    const bool before = c >= 0 && r >= 0 && c < sheet_.columns && r < sheet_.rows && away_[at(c, r)] >= 0;
    if (before)
      sheet_.lines.push_back({{v, id(out), id(at(c, r))}, share, false});
    else
      sheet_.lines.push_back({{v, id(out), id(out)}, 0, false});
    return crossings_[{out, in}] = v;
  }

  void keep(const std::array<std::size_t, 3>& triangle) {
    std::vector<std::uint32_t> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = triangle[k], b = triangle[(k + 1) % 3];
      if (away_[a] >= 0) corners.push_back(id(a));
      if (away_[a] > 0 && away_[b] < 0) corners.push_back(crossing(a, b));
      if (away_[a] < 0 && away_[b] > 0) corners.push_back(crossing(b, a));
    }
    for (std::size_t k = 2; k < corners.size(); ++k)
      sheet_.triangles.push_back({corners[0], corners[k - 1], corners[k]});
  }

  void keep_line(std::size_t a, std::size_t b, std::size_t c) {
    if (away_[a] >= 0 && away_[b] >= 0 && away_[c] >= 0) sheet_.lines.push_back({{id(a), id(b), id(c)}, 1, false});
  }

  // Edges of one triangle alone that do not lie on the rim.
  void find_hole() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> triangles;
    for (const render::Triangle& t : sheet_.triangles)
      for (std::size_t k = 0; k < 3; ++k) ++triangles[std::minmax(t[k], t[(k + 1) % 3])];
    const std::set<std::uint32_t> rim(sheet_.rim.begin(), sheet_.rim.end());
    for (const render::Triangle& t : sheet_.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        if (triangles[std::minmax(a, b)] == 1 && !(rim.contains(a) && rim.contains(b)))
          sheet_.hole.push_back({a, b, t[(k + 2) % 3]});
      }
  }

  // The hole's edge moves smoothly along itself.
  void follow_outline() {
    std::vector<bool> used(sheet_.places.size(), false);
    for (const render::Triangle& t : sheet_.triangles)
      for (const std::uint32_t v : t) used[v] = true;
    const std::vector<Place>& corners = outline_.corners;
    std::vector<std::pair<double, std::uint32_t>> edge;
    for (std::uint32_t v = 0; v < used.size(); ++v) {
      if (!used[v] || std::fabs(outline_.distance(sheet_.places[v])) > 0.05) continue;
      double least = 1e30, way = 0, here = 0;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Place &a = corners[i], &b = corners[(i + 1) % corners.size()];
        const double t = along(a, b, sheet_.places[v]);
        const double away = length(sheet_.places[v] - (a + t * (b - a)));
        if (away < least) {
          least = away;
          here = way + t * length(b - a);
        }
        way += length(b - a);
      }
      edge.push_back({here, v});
    }
    std::sort(edge.begin(), edge.end());
    for (std::size_t i = 0; edge.size() > 2 && i < edge.size(); ++i) {
      const std::uint32_t a = edge[(i + edge.size() - 1) % edge.size()].second, b = edge[i].second;
      const std::uint32_t c = edge[(i + 1) % edge.size()].second;
      const double before = length(sheet_.places[b] - sheet_.places[a]);
      const double after = length(sheet_.places[c] - sheet_.places[b]);
      sheet_.lines.push_back({{a, b, c}, before / std::max(after, 1e-6), true});
    }
  }

  const Outline& outline_;
  OpeningSheet& sheet_;
  std::vector<Place> place_;
  std::vector<double> away_;
  std::vector<std::int64_t> vertex_;
  std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> crossings_;
};

}  // namespace

OpeningSheet opening_sheet(const Outline& outline) {
  const Box box = box_of(outline);
  const OpeningAxis axis = opening_axis(outline);
  const double right = std::fabs(axis.along[0]) * axis.length, down = std::fabs(axis.along[1]) * axis.length;
  const auto margin_x = static_cast<int>(std::lround(margin_along * right + margin_across * down));
  const auto margin_y = static_cast<int>(std::lround(margin_along * down + margin_across * right));
  OpeningSheet sheet;
  sheet.light_px = light_step * axis.length;
  sheet.left = (static_cast<int>(box.left) - margin_x) / stride * stride;
  sheet.top = (static_cast<int>(box.top) - margin_y) / stride * stride;
  sheet.columns = (static_cast<int>(box.right) + margin_x - sheet.left) / stride + 1;
  sheet.rows = (static_cast<int>(box.bottom) + margin_y - sheet.top) / stride + 1;
  SheetCutter(outline, sheet).cut();
  return sheet;
}

}  // namespace face::transfer
