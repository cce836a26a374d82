// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/opening_sheet.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "nodes/base/luma.h"
#include "nodes/base/srgb.h"

namespace face::transfer {
namespace {

constexpr int stride = 2;
// Shares of an opening's length: how far from it a lid's skin moves, along it and across it (14 and 18 pixels of an eye
// 57 pixels long); how far apart light is told; how far an eye goes on below a lid.
constexpr double margin_along = 0.25, margin_across = 0.32, light_step = 0.175, reach_below = 0.25;
constexpr double snap = 0.7;     // pixels: vertices so near to the outline lie on it
constexpr int parts = 4;         // of a pixel's width, where layers are told apart
constexpr int window = 16;       // parts that a pixel sees, with the lens's blur
constexpr double lens_px = 0.5;  // standard deviation of a sharp lens's blur
constexpr double clean = 0.03;   // shares that are none
constexpr int sure_px = 8;       // so far from a view's border a pixel is within the sheet's rim
constexpr int blur_px = 8;       // a pixel at the outline sees less than half as far

Place operator+(const Place& a, const Place& b) { return {a[0] + b[0], a[1] + b[1]}; }
Place operator-(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1]}; }
Place operator*(double s, const Place& a) { return {s * a[0], s * a[1]}; }
double length(const Place& a) { return std::hypot(a[0], a[1]); }

double light_of(double grey) { return linear_of(std::clamp(grey, 0.0, 255.0) / 255); }
double grey_of(double light) { return 255 * srgb_of(std::max(light, 0.0)); }

// Where on the segment from a to b a place is nearest.
double along(const Place& a, const Place& b, const Place& place) {
  const Place ab = b - a, ap = place - a;
  return std::clamp((ap[0] * ab[0] + ap[1] * ab[1]) / std::max(ab[0] * ab[0] + ab[1] * ab[1], 1e-12), 0.0, 1.0);
}

// How a pixel weighs the parts about it: its own width, through the lens.
const std::array<double, window>& pixel_weights() {
  static const std::array<double, window> weights = [] {
    std::array<double, window> w{};
    double sum = 0;
    for (int i = 0; i < window; ++i)
      for (int part = 0; part < parts; ++part) {
        const double apart = (i - 0.5 * (window - 1)) - (part - 0.5 * (parts - 1));
        w[static_cast<std::size_t>(i)] += std::exp(-0.5 * std::pow(apart / (parts * lens_px), 2));
      }
    for (const double v : w) sum += v;
    for (double& v : w) v /= sum;
    return w;
  }();
  return weights;
}

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

struct Box {
  double left = 1e30, top = 1e30, right = -1e30, bottom = -1e30;
};
Box box_of(const Outline& outline) {
  Box box;
  for (const Place& p : outline.corners)
    box = {std::min(box.left, p[0]), std::min(box.top, p[1]), std::max(box.right, p[0]), std::max(box.bottom, p[1])};
  return box;
}

}  // namespace

double Outline::distance(const Place& place, Place* nearest) const {
  double least = 1e30;
  bool inside = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Place &a = corners[j], &b = corners[i];
    const Place there = a + along(a, b, place) * (b - a);
    const double away = length(place - there);
    if (away < least) {
      least = away;
      if (nearest) *nearest = there;
    }
    if ((a[1] > place[1]) != (b[1] > place[1]) && place[0] < (b[0] - a[0]) * (place[1] - a[1]) / (b[1] - a[1]) + a[0])
      inside = !inside;
  }
  return inside ? -least : least;
}

Place OpeningAxis::own(const Place& place) const {
  const Place from = place - middle;
  return {from[0] * along[0] + from[1] * along[1], from[1] * along[0] - from[0] * along[1]};
}

Place OpeningAxis::picture(const Place& own) const {
  return {middle[0] + own[0] * along[0] - own[1] * along[1], middle[1] + own[0] * along[1] + own[1] * along[0]};
}

OpeningAxis opening_axis(const Outline& outline) {
  OpeningAxis axis;
  const auto count = static_cast<double>(outline.corners.size());
  for (const Place& p : outline.corners) axis.middle = axis.middle + (1 / count) * p;
  double xx = 0, xy = 0, yy = 0;
  for (const Place& p : outline.corners) {
    const Place from = p - axis.middle;
    xx += from[0] * from[0];
    xy += from[0] * from[1];
    yy += from[1] * from[1];
  }
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);  // -90 to 90 degrees: to the right
  axis.along = {std::cos(angle), std::sin(angle)};
  double least = 0, most = 0;
  for (const Place& p : outline.corners) {
    least = std::min(least, axis.own(p)[0]);
    most = std::max(most, axis.own(p)[0]);
  }
  axis.length = most - least;
  return axis;
}

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

OpeningLayers opening_layers(const Image& picture, const Outline& outline) {
  const Box box = box_of(outline);
  const auto reach = static_cast<int>(std::lround(reach_below * opening_axis(outline).length));
  const int left = std::max(static_cast<int>(box.left) - blur_px, 0);
  const int top = std::max(static_cast<int>(box.top) - blur_px, 0);
  const int right = std::min(static_cast<int>(box.right) + blur_px + 1, picture.width - 1);
  const int bottom = std::min(static_cast<int>(box.bottom) + blur_px + 1, picture.height - 1);
  const int width = right - left + 1;
  Image skin{picture.width, picture.height, 1, {}};
  for (std::size_t i = 0; i < picture.pixels.size(); i += static_cast<std::size_t>(picture.channels)) {
    const std::uint8_t* p = picture.pixels.data() + i;
    skin.pixels.push_back(static_cast<std::uint8_t>(std::lround(grey_value<double>(p, picture.channels))));
  }
  const Image grey = skin;
  Image eye = skin;
  const auto pixel = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
  };
  // How much of every pixel is eye.
  std::vector<double> shares;
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      const double away = outline.distance({static_cast<double>(x), static_cast<double>(y)});
      double share = away < 0 ? 1 : 0;
      if (std::fabs(away) < 0.5 * window / parts * 1.5) {
        share = 0;
        for (int j = 0; j < window; ++j)
          for (int i = 0; i < window; ++i) {
            const Place part = {x + (i - 0.5 * (window - 1)) / parts, y + (j - 0.5 * (window - 1)) / parts};
            if (outline.distance(part) < 0)
              share += pixel_weights()[static_cast<std::size_t>(i)] * pixel_weights()[static_cast<std::size_t>(j)];
          }
      }
      shares.push_back(share);
    }
  const auto share_at = [&](int x, int y) {
    return shares[static_cast<std::size_t>(y - top) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x - left)];
  };
  // The grey of the nearest pixels that see one layer alone; < 0 where there are none.
  const auto nearest = [&](int x, int y, bool of_eye) {
    double least = 1e30, sum = 0, weights = 0;
    for (const bool measure : {true, false})
      for (int ny = std::max(y - reach, top); ny <= std::min(y + reach, bottom); ++ny)
        for (int nx = std::max(x - reach, left); nx <= std::min(x + reach, right); ++nx) {
          if (of_eye ? share_at(nx, ny) < 1 - clean : share_at(nx, ny) > clean) continue;
          const double away = std::hypot(nx - x, ny - y);
          if (measure) {
            least = std::min(least, away);
          } else if (away < least + 0.8) {
            const double weight = std::exp(-4 * (away - least) * (away - least));
            sum += weight * grey.pixels[pixel(nx, ny)];
            weights += weight;
          }
        }
    return weights > 0 ? sum / weights : -1.0;
  };
  const auto to_byte = [](double value) { return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0)); };
  // What a pixel shows less what it sees of the other layer; the less is left of it, the more it is as its neighbours.
  const auto freed = [&](double light, double other_share, double own, double other) {
    if (other_share >= 0.5 || other < 0) return own;
    const double rest = grey_of(std::clamp((light - other_share * light_of(other)) / (1 - other_share), 0.0, 1.0));
    const double known = own < 0 ? 1 : std::clamp((0.5 - other_share) / 0.2, 0.0, 1.0);
    return known * rest + (1 - known) * own;
  };
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      const double share = share_at(x, y), light = light_of(grey.pixels[pixel(x, y)]);
      if (share <= clean && share >= 1 - clean) continue;
      const double near_skin = share > clean ? nearest(x, y, false) : -1;
      const double near_eye = share < 1 - clean || share > clean ? nearest(x, y, true) : -1;
      if (share > clean) {
        const double own = freed(light, share, near_skin, near_eye);
        if (own >= 0) skin.pixels[pixel(x, y)] = to_byte(own);
      }
      if (share < 1 - clean) {
        const double own = freed(light, 1 - share, near_eye, near_skin >= 0 ? near_skin : grey.pixels[pixel(x, y)]);
        if (own >= 0) eye.pixels[pixel(x, y)] = to_byte(own);
      }
      // Together they are the picture.
      if (share <= 0.001 || share >= 0.999) continue;
      const double skin_light = light_of(skin.pixels[pixel(x, y)]), eye_light = light_of(eye.pixels[pixel(x, y)]);
      if (share >= 0.3)
        eye.pixels[pixel(x, y)] = to_byte(grey_of(std::clamp((light - (1 - share) * skin_light) / share, 0.0, 1.0)));
      else
        skin.pixels[pixel(x, y)] = to_byte(grey_of(std::clamp((light - share * eye_light) / (1 - share), 0.0, 1.0)));
    }
  return {GreySpline(skin), GreySpline(eye)};
}

OpeningScene::OpeningScene(const OpeningSheet& sheet, const OpeningLayers& layers)
    : sheet_(sheet),
      layers_(layers),
      light_columns_(static_cast<int>(stride * sheet.columns / sheet.light_px) + 2),
      light_rows_(static_cast<int>(stride * sheet.rows / sheet.light_px) + 2) {}

std::array<std::pair<std::size_t, double>, 4> OpeningScene::light_at(const Place& place) const {
  const double x = std::clamp((place[0] - sheet_.left) / sheet_.light_px, 0.0, light_columns_ - 1.001);
  const double y = std::clamp((place[1] - sheet_.top) / sheet_.light_px, 0.0, light_rows_ - 1.001);
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const double fx = x - column, fy = y - row;
  const auto first = static_cast<std::size_t>(row * light_columns_ + column);
  const auto below = first + static_cast<std::size_t>(light_columns_);
  return {{{first, (1 - fx) * (1 - fy)}, {first + 1, fx * (1 - fy)}, {below, (1 - fx) * fy}, {below + 1, fx * fy}}};
}

double OpeningScene::eye_light(const Place& place) const { return light_of(layers_.eye.at(place[0], place[1])); }

OpeningView OpeningScene::view(const OpeningPose& pose) const {
  Box box;
  Outline border;
  for (const std::uint32_t v : sheet_.rim) {
    const Place& p = pose.vertices[v];
    border.corners.push_back(p);
    box = {std::min(box.left, p[0]), std::min(box.top, p[1]), std::max(box.right, p[0]), std::max(box.bottom, p[1])};
  }
  OpeningView view;
  view.left = static_cast<int>(std::floor(box.left)) - 2;
  view.top = static_cast<int>(std::floor(box.top)) - 2;
  view.width = static_cast<int>(std::ceil(box.right)) + 3 - view.left;
  view.height = static_cast<int>(std::ceil(box.bottom)) + 3 - view.top;
  view.pixels.resize(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height));
  const int fine_width = parts * view.width, fine_height = parts * view.height;
  std::vector<render::ScreenPoint> screen;
  for (const Place& p : pose.vertices)
    screen.push_back({static_cast<float>((p[0] - view.left + 0.5) * parts - 0.5),
                      static_cast<float>((p[1] - view.top + 0.5) * parts - 0.5), 1});
  const render::Raster raster = render::rasterize(
      screen, sheet_.triangles,
      {.width_px = fine_width, .height_px = fine_height, .near_mm = 0.5f, .culling = render::Culling::none});
  // The skin's share of every pixel: rows first, then columns.
  const int before = (window - parts) / 2;
  std::vector<double> by_rows(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(fine_height), 0);
  for (int y = 0; y < fine_height; ++y)
    for (int x = 0; x < view.width; ++x)
      for (int i = 0; i < window; ++i)
        if (raster.triangles[raster.index(std::clamp(parts * x - before + i, 0, fine_width - 1), y)] >= 0)
          by_rows[static_cast<std::size_t>(y * view.width + x)] += pixel_weights()[static_cast<std::size_t>(i)];
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      OpeningView::Pixel& pixel = view.pixels[static_cast<std::size_t>(y * view.width + x)];
      const Place here = {static_cast<double>(view.left + x), static_cast<double>(view.top + y)};
      const bool deep = x >= sure_px && y >= sure_px && x < view.width - sure_px && y < view.height - sure_px;
      if (!deep && !(border.distance(here) < -1)) continue;
      pixel.drawn = true;
      for (int j = 0; j < window; ++j)
        pixel.share +=
            pixel_weights()[static_cast<std::size_t>(j)] *
            by_rows[static_cast<std::size_t>(std::clamp(parts * y - before + j, 0, fine_height - 1) * view.width + x)];
      std::map<std::uint32_t, double> vertices;
      double weights = 0;
      const auto take = [&](int fine_x, int fine_y, double weight) {
        if (fine_x < 0 || fine_y < 0 || fine_x >= fine_width || fine_y >= fine_height) return;
        const std::int32_t triangle = raster.triangles[raster.index(fine_x, fine_y)];
        if (triangle < 0) return;
        const render::Triangle& corners = sheet_.triangles[static_cast<std::size_t>(triangle)];
        const Vec3f b =
            render::barycentrics_at(screen, corners, static_cast<float>(fine_x), static_cast<float>(fine_y));
        Place place{};
        for (std::size_t k = 0; k < 3; ++k) {
          place = place + static_cast<double>(b[k]) * sheet_.places[corners[k]];
          vertices[corners[k]] += weight * static_cast<double>(b[k]);
        }
        pixel.skin_place = pixel.skin_place + weight * place;
        pixel.skin += weight * light_of(layers_.skin.at(place[0], place[1]));
        weights += weight;
      };
      for (int j = 0; j < parts; ++j)
        for (int i = 0; i < parts; ++i) take(parts * x + i, parts * y + j, 1);
      // A pixel that sees the skin through the lens alone.
      if (weights == 0 && pixel.share > clean)
        for (int j = -parts; j < 2 * parts; ++j)
          for (int i = -parts; i < 2 * parts; ++i) {
            const double away = std::hypot(i - 0.5 * (parts - 1), j - 0.5 * (parts - 1)) / parts;
            take(parts * x + i, parts * y + j, std::exp(-0.5 * std::pow(away / lens_px, 2)));
          }
      if (weights > 0) {
        pixel.skin /= weights;
        pixel.skin_place = (1 / weights) * pixel.skin_place;
        double gain = 0;
        for (const auto& [i, w] : light_at(pixel.skin_place)) gain += w * pose.light[i];
        pixel.skin *= std::exp(gain);
        std::vector<std::pair<double, std::uint32_t>> largest;
        for (const auto& [v, w] : vertices) largest.push_back({-w, v});
        std::sort(largest.begin(), largest.end());
        pixel.vertex_count = std::min(largest.size(), OpeningView::most);
        double sum = 0;
        for (std::size_t k = 0; k < pixel.vertex_count; ++k) sum -= largest[k].first;
        for (std::size_t k = 0; k < pixel.vertex_count; ++k)
          pixel.vertices[k] = {largest[k].second, -largest[k].first / sum};
      } else {
        pixel.share = 0;
      }
      const std::array<double, 6>& e = pose.eye_from_frame;
      pixel.eye_place = {e[0] * here[0] + e[1] * here[1] + e[4], e[2] * here[0] + e[3] * here[1] + e[5]};
      pixel.eye = eye_light(pixel.eye_place);
      pixel.grey = grey_of(pixel.share * pixel.skin + (1 - pixel.share) * pixel.eye);
    }
  return view;
}

}  // namespace face::transfer
