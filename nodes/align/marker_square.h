// SPDX-License-Identifier: Apache-2.0
// The square of a picture about a marker, and where it is found again.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/types/image.h"

namespace face::align {

// A picture in grey, with one access rule: outside, the nearest pixel's.
struct GreyPicture {
  int width, height;
  std::vector<std::uint8_t> values;  // height x width
  int at(int x, int y) const;
  double at(double x, double y) const;  // bilinear
};
GreyPicture grey_of(const Image& picture);

struct Place {
  double x = 0, y = 0;  // px
};

inline bool is_near(const Place& a, const Place& b, double reach_px) {
  return (a.x > b.x ? a.x - b.x : b.x - a.x) < reach_px && (a.y > b.y ? a.y - b.y : b.y - a.y) < reach_px;
}

// How a square lies in a picture, rows of a 2 x 2 matrix: a point u of the square is at the marker's place +
// bend (u - the marker's point in the square).
using Bend = std::array<double, 4>;
inline constexpr Bend straight = {1, 0, 0, 1};

struct MarkerMatch {
  Place at;  // the marker's
  Bend bend = straight;
  double likeness = -1;  // correlation of the bent square with the picture, in [-1, 1]
  double score = -1;     // that of whole pixels, less what its distance from the forecast costs
};

struct MarkerSearch {
  Place forecast;                     // where the marker should be
  Bend bend = straight;               // how it should lie
  int reach_px = 10;                  // how far it is looked for, along x and y
  double cost = 0;                    // of likeness, at that distance; it grows with the distance's square
  const std::vector<Place>* taken{};  // markers that others have: none within half a side of them; null = none
};

class MarkerSquare {
 public:
  // templates: grey squares of side x side pixels side by side. marker: its point in the square of this index.
  MarkerSquare(const Image& templates, std::size_t index, int side, const Place& marker);

  // Finds the square: on whole pixels, by zero-mean normalised correlation (the sum of squared differences that is left
  // once gain and offset of light are taken out; its sums are exact integers), then between them with the bend.
  MarkerMatch find(const GreyPicture& grey, const MarkerSearch& search) const;

 private:
  // Whole pixels.
  MarkerMatch look(const GreyPicture& grey, const MarkerSearch& search) const;
  void fit(const GreyPicture& grey, MarkerMatch& match) const;
  double value(int x, int y) const { return static_cast<double>(values_[static_cast<std::size_t>(y * side_ + x)]); }

  int side_;
  Place marker_;
  std::vector<std::int16_t> values_;  // side x side
};

}  // namespace face::align
