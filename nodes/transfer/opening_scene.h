// SPDX-License-Identifier: Apache-2.0
// Draws an opening's two layers as a frame shows them.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "nodes/transfer/opening_layers.h"
#include "nodes/transfer/opening_sheet.h"

namespace face::transfer {

// Where sheet and eye are in a frame.
struct OpeningPose {
  std::vector<Place> vertices;
  std::array<double, 6> eye_from_frame = {1, 0, 0, 1, 0, 0};  // x' = [0] x + [1] y + [4], y' = [2] x + [3] y + [5]
  std::vector<double> light;  // logarithm of the frame's light over the reference's, light_columns x light_rows
};

// What a frame shows of a pose, in a part of its picture.
struct OpeningView {
  static constexpr std::size_t most = 9;
  struct Pixel {
    bool drawn = false;
    double grey = 0;           // sRGB, 0 to 255
    double share = 0;          // of the skin
    double skin = 0, eye = 0;  // linear light
    Place skin_place{}, eye_place{};
    std::array<std::pair<std::uint32_t, double>, most> vertices{};  // whose skin it is
    std::size_t vertex_count = 0;
  };
  int left = 0, top = 0, width = 0, height = 0;
  std::vector<Pixel> pixels;
  render::Raster parts;  // which triangle each part of a pixel shows, -1 = none: the eye
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - top) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x - left);
  }
  const Pixel& at(int x, int y) const { return pixels[index(x, y)]; }
};

class OpeningScene {
 public:
  OpeningScene(const OpeningSheet& sheet, const OpeningLayers& layers);
  int light_columns() const { return light_columns_; }
  int light_rows() const { return light_rows_; }
  // The four values of the light's grid about a place of the reference, and their weights.
  std::array<std::pair<std::size_t, double>, 4> light_at(const Place& place) const;
  OpeningView view(const OpeningPose& pose) const;
  const OpeningSheet& sheet() const { return sheet_; }
  double eye_light(const Place& place) const;

 private:
  const OpeningSheet& sheet_;
  const OpeningLayers& layers_;
  int light_columns_, light_rows_;
};

}  // namespace face::transfer
