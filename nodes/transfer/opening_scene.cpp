// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/opening_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "nodes/base/srgb.h"
#include "nodes/render/rasterize.h"
#include "nodes/transfer/pixel_lens.h"

namespace face::transfer {
namespace {

constexpr int sure_px = 8;  // so far from a view's border a pixel is within the sheet's rim

double light_of(double grey) { return linear_of(std::clamp(grey, 0.0, 255.0) / 255); }
double grey_of(double light) { return 255 * srgb_of(std::max(light, 0.0)); }

// Draws a pose step by step.
class ViewDrawer {
 public:
  ViewDrawer(const OpeningScene& scene, const OpeningLayers& layers, const OpeningPose& pose)
      : scene_(scene), sheet_(scene.sheet()), layers_(layers), pose_(pose) {}

  OpeningView view() {
    frame_sheet();
    rasterize_parts();
    const std::vector<double> by_rows = skin_by_rows();
    for (int y = 0; y < view_.height; ++y)
      for (int x = 0; x < view_.width; ++x) {
        if (!within_sheet(x, y)) continue;
        OpeningView::Pixel& pixel = view_.pixels[static_cast<std::size_t>(y * view_.width + x)];
        pixel.drawn = true;
        pixel.share = skin_share(by_rows, x, y);
        see_skin(pixel, x, y);
        see_eye(pixel, x, y);
        pixel.grey = grey_of(pixel.share * pixel.skin + (1 - pixel.share) * pixel.eye);
      }
    return std::move(view_);
  }

 private:
  void frame_sheet() {
    for (const std::uint32_t v : sheet_.rim) rim_.corners.push_back(pose_.vertices[v]);
    const Box box = box_of(rim_);
    view_.left = static_cast<int>(std::floor(box.left)) - 2;
    view_.top = static_cast<int>(std::floor(box.top)) - 2;
    view_.width = static_cast<int>(std::ceil(box.right)) + 3 - view_.left;
    view_.height = static_cast<int>(std::ceil(box.bottom)) + 3 - view_.top;
    view_.pixels.resize(static_cast<std::size_t>(view_.width) * static_cast<std::size_t>(view_.height));
  }

  void rasterize_parts() {
    for (const Place& p : pose_.vertices)
      screen_.push_back({static_cast<float>((p[0] - view_.left + 0.5) * parts_per_px - 0.5),
                         static_cast<float>((p[1] - view_.top + 0.5) * parts_per_px - 0.5), 1});
    view_.parts = render::rasterize(screen_, sheet_.triangles,
                                    {.width_px = parts_per_px * view_.width,
                                     .height_px = parts_per_px * view_.height,
                                     .near_mm = 0.5f,
                                     .culling = render::Culling::none});
  }

  std::int32_t triangle_at(int part_x, int part_y) const {
    return view_.parts.triangles[view_.parts.index(part_x, part_y)];
  }

  // The skin's share of what each pixel's column of parts sees, for every row of parts.
  std::vector<double> skin_by_rows() const {
    const int columns = view_.parts.width_px, rows = view_.parts.height_px;
    std::vector<double> by_rows(static_cast<std::size_t>(view_.width) * static_cast<std::size_t>(rows), 0);
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < view_.width; ++x)
        for (int i = 0; i < lens_window; ++i)
          if (triangle_at(std::clamp(first_part(x) + i, 0, columns - 1), y) >= 0)
            by_rows[static_cast<std::size_t>(y * view_.width + x)] += lens_weights()[static_cast<std::size_t>(i)];
    return by_rows;
  }

  double skin_share(const std::vector<double>& by_rows, int x, int y) const {
    double share = 0;
    for (int j = 0; j < lens_window; ++j) {
      const int row = std::clamp(first_part(y) + j, 0, view_.parts.height_px - 1);
      share += lens_weights()[static_cast<std::size_t>(j)] * by_rows[static_cast<std::size_t>(row * view_.width + x)];
    }
    return share;
  }

  bool within_sheet(int x, int y) const {
    if (x >= sure_px && y >= sure_px && x < view_.width - sure_px && y < view_.height - sure_px) return true;
    return rim_.distance(place_of(x, y)) < -1;
  }
  Place place_of(int x, int y) const {
    return {static_cast<double>(view_.left + x), static_cast<double>(view_.top + y)};
  }

  // What a pixel sees of the skin: the mean of its own parts that show skin, or of those that the lens brings to it.
  void see_skin(OpeningView::Pixel& pixel, int x, int y) const {
    std::map<std::uint32_t, double> vertices;
    double weights = 0;
    const auto take = [&](int part_x, int part_y, double weight) {
      if (part_x < 0 || part_y < 0 || part_x >= view_.parts.width_px || part_y >= view_.parts.height_px) return;
      const std::int32_t triangle = triangle_at(part_x, part_y);
      if (triangle < 0) return;
      const render::Triangle& corners = sheet_.triangles[static_cast<std::size_t>(triangle)];
      const Vec3f b = render::barycentrics_at(screen_, corners, static_cast<float>(part_x), static_cast<float>(part_y));
      Place place{};
      for (std::size_t k = 0; k < 3; ++k) {
        place = place + static_cast<double>(b[k]) * sheet_.places[corners[k]];
        vertices[corners[k]] += weight * static_cast<double>(b[k]);
      }
      pixel.skin_place = pixel.skin_place + weight * place;
      pixel.skin += weight * light_of(layers_.skin.at(place[0], place[1]));
      weights += weight;
    };
    for (int j = 0; j < parts_per_px; ++j)
      for (int i = 0; i < parts_per_px; ++i) take(parts_per_px * x + i, parts_per_px * y + j, 1);
    if (weights == 0 && pixel.share > no_share)
      for (int j = -parts_per_px; j < 2 * parts_per_px; ++j)
        for (int i = -parts_per_px; i < 2 * parts_per_px; ++i) {
          const double away = std::hypot(i - 0.5 * (parts_per_px - 1), j - 0.5 * (parts_per_px - 1)) / parts_per_px;
          take(parts_per_px * x + i, parts_per_px * y + j, std::exp(-0.5 * std::pow(away / lens_px, 2)));
        }
    if (weights == 0) {
      pixel.share = 0;
      return;
    }
    pixel.skin /= weights;
    pixel.skin_place = (1 / weights) * pixel.skin_place;
    double gain = 0;
    for (const auto& [i, w] : scene_.light_at(pixel.skin_place)) gain += w * pose_.light[i];
    pixel.skin *= std::exp(gain);
    keep_largest(vertices, pixel);
  }

  static void keep_largest(const std::map<std::uint32_t, double>& vertices, OpeningView::Pixel& pixel) {
    std::vector<std::pair<double, std::uint32_t>> largest;
    for (const auto& [v, w] : vertices) largest.push_back({-w, v});
    std::sort(largest.begin(), largest.end());
    pixel.vertex_count = std::min(largest.size(), OpeningView::most);
    double sum = 0;
    for (std::size_t k = 0; k < pixel.vertex_count; ++k) sum -= largest[k].first;
    for (std::size_t k = 0; k < pixel.vertex_count; ++k)
      pixel.vertices[k] = {largest[k].second, -largest[k].first / sum};
  }

  void see_eye(OpeningView::Pixel& pixel, int x, int y) const {
    const std::array<double, 6>& e = pose_.eye_from_frame;
    const Place here = place_of(x, y);
    pixel.eye_place = {e[0] * here[0] + e[1] * here[1] + e[4], e[2] * here[0] + e[3] * here[1] + e[5]};
    pixel.eye = scene_.eye_light(pixel.eye_place);
  }

  const OpeningScene& scene_;
  const OpeningSheet& sheet_;
  const OpeningLayers& layers_;
  const OpeningPose& pose_;
  Outline rim_;
  std::vector<render::ScreenPoint> screen_;
  OpeningView view_;
};

}  // namespace

OpeningScene::OpeningScene(const OpeningSheet& sheet, const OpeningLayers& layers)
    : sheet_(sheet),
      layers_(layers),
      light_columns_(static_cast<int>(sheet_stride_px * sheet.columns / sheet.light_px) + 2),
      light_rows_(static_cast<int>(sheet_stride_px * sheet.rows / sheet.light_px) + 2) {}

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

OpeningView OpeningScene::view(const OpeningPose& pose) const { return ViewDrawer(*this, layers_, pose).view(); }

}  // namespace face::transfer
