// SPDX-License-Identifier: Apache-2.0
// An opening that lids shut, as two layers: a sheet of skin with a hole, and the eye behind it.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "nodes/base/grey_spline.h"
#include "nodes/render/rasterize.h"
#include "nodes/types/image.h"

namespace face::transfer {

using Place = std::array<double, 2>;  // x, y in a picture, pixels

// A closed curve, by its corners.
struct Outline {
  std::vector<Place> corners;
  // How far a place is from the curve, negative inside; nearest: on the curve.
  double distance(const Place& place, Place* nearest = nullptr) const;
};

// An opening's own directions: along it, from corner to corner, to the right, and across it, downwards. Lengths about
// an opening are shares of its own, so that they mean the same in a picture of any size.
struct OpeningAxis {
  Place middle{}, along = {1, 0};
  double length = 0;  // pixels
  // A place as x along and y across from the middle, and back.
  Place own(const Place& place) const;
  Place picture(const Place& own) const;
};
// By the second moments of the outline's corners.
OpeningAxis opening_axis(const Outline& outline);

// The skin about an opening in the reference's picture: a grid of vertices, every 2 pixels, and those where its lines
// meet the outline. No triangle lies inside.
struct OpeningSheet {
  struct Line {  // second difference: first - (1 + share) * middle + share * last is kept small
    std::array<std::uint32_t, 3> vertices;
    double share;
    bool along_outline;
  };
  std::vector<Place> places;
  std::vector<render::Triangle> triangles;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::vector<Line> lines;
  std::vector<std::uint32_t> rim;  // the outermost vertices, in order about the sheet
  int left = 0, top = 0, columns = 0, rows = 0;
  double light_px = 0;  // distance of the places where light is told
};
OpeningSheet opening_sheet(const Outline& outline);

// A picture's two layers. A pixel at the outline sees both; each layer is freed of the other's light, and goes on
// below the other as at its own edge. Laid on each other as in the picture they are the picture.
struct OpeningLayers {
  GreySpline skin, eye;
};
OpeningLayers opening_layers(const Image& picture, const Outline& outline);

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
  const Pixel& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y - top) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x - left)];
  }
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
