// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/relax.h"

#include <algorithm>
#include <array>

namespace face::flow {
namespace {

// The pixels of one colour, side by side: neighbours are then contiguous in the other colour, and a sweep is vector
// code. Pixel i of row y is column 2 i + (y + colour) % 2 of the area; a row and a column of zeros stand around.
struct Colour {
  int stride = 0;
  std::vector<float> u, v;
  // inverse of the 2 x 2 matrix, right side, links to the left, right, above, below
  std::vector<float> iaa, iab, ibb, ra, rb, left, right, up, down;

  void resize(int half_width, int height) {
    stride = half_width + 2;
    const std::size_t count = static_cast<std::size_t>(stride) * static_cast<std::size_t>(height + 2);
    for (auto* plane : {&u, &v, &iaa, &iab, &ibb, &ra, &rb, &left, &right, &up, &down}) plane->assign(count, 0.0f);
  }
  std::size_t at(int y, int i) const { return static_cast<std::size_t>((y + 1) * stride + i + 1); }
};

void sweep_row(Colour& mine, const Colour& other, int y, int count, bool odd, float omega) {
  const std::size_t start = mine.at(y, 0);
  const std::size_t before = start - (odd ? 0 : 1), after = before + 1;
  const auto stride = static_cast<std::size_t>(mine.stride);
  float* __restrict__ u = mine.u.data() + start;
  float* __restrict__ v = mine.v.data() + start;
  const float *ul = other.u.data() + before, *ur = other.u.data() + after, *ua = other.u.data() + start - stride,
              *ub = other.u.data() + start + stride;
  const float *vl = other.v.data() + before, *vr = other.v.data() + after, *va = other.v.data() + start - stride,
              *vb = other.v.data() + start + stride;
  const float *l = mine.left.data() + start, *r = mine.right.data() + start, *a = mine.up.data() + start,
              *b = mine.down.data() + start;
  const float *iaa = mine.iaa.data() + start, *iab = mine.iab.data() + start, *ibb = mine.ibb.data() + start;
  const float *ra = mine.ra.data() + start, *rb = mine.rb.data() + start;
  for (int i = 0; i < count; ++i) {
    const float su = ra[i] + l[i] * ul[i] + r[i] * ur[i] + a[i] * ua[i] + b[i] * ub[i];
    const float sv = rb[i] + l[i] * vl[i] + r[i] * vr[i] + a[i] * va[i] + b[i] * vb[i];
    u[i] += omega * (iaa[i] * su + iab[i] * sv - u[i]);
    v[i] += omega * (iab[i] * su + ibb[i] * sv - v[i]);
  }
}

}  // namespace

void relax(const FlowEnergy& energy, const RelaxArea& area, int sweeps, float over_relaxation, Plane& u, Plane& v) {
  const int width = area.last_column - area.first_column + 1, height = area.last_row - area.first_row + 1;
  if (width <= 0 || height <= 0) return;
  std::array<Colour, 2> colours;
  for (Colour& c : colours) c.resize((width + 1) / 2, height);
  for (int y = 0; y < height; ++y) {
    const int py = area.first_row + y;
    for (int x = 0; x < width; ++x) {
      Colour& c = colours[static_cast<std::size_t>((x + y) & 1)];
      const std::size_t n = c.at(y, x / 2);
      const std::size_t i = static_cast<std::size_t>(py) * static_cast<std::size_t>(u.width) +
                            static_cast<std::size_t>(area.first_column + x);
      c.u[n] = u.values[i];
      c.v[n] = v.values[i];
      c.left[n] = x > 0 ? energy.right.values[i - 1] : 0;
      c.right[n] = x + 1 < width ? energy.right.values[i] : 0;
      c.up[n] = y > 0 ? energy.down.values[i - static_cast<std::size_t>(u.width)] : 0;
      c.down[n] = y + 1 < height ? energy.down.values[i] : 0;
      c.ra[n] = energy.ra.values[i];
      c.rb[n] = energy.rb.values[i];
      const float links = c.left[n] + c.right[n] + c.up[n] + c.down[n] + 1e-12f;
      const float aa = energy.aa.values[i] + links, ab = energy.ab.values[i], bb = energy.bb.values[i] + links;
      const float determinant = aa * bb - ab * ab;
      const bool sound = determinant > 1e-5f * aa * bb;  // else the sum of rounding alone
      c.iaa[n] = sound ? bb / determinant : 1 / aa;
      c.iab[n] = sound ? -ab / determinant : 0;
      c.ibb[n] = sound ? aa / determinant : 1 / bb;
    }
  }
  for (int s = 0; s < sweeps; ++s)
    for (std::size_t k = 0; k < 2; ++k)
      for (int y = 0; y < height; ++y) {
        // The first column of this colour in the row.
        const int first = (y + static_cast<int>(k)) & 1;
        sweep_row(colours[k], colours[1 - k], y, (width - first + 1) / 2, first == 1, over_relaxation);
      }
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Colour& c = colours[static_cast<std::size_t>((x + y) & 1)];
      const std::size_t n = c.at(y, x / 2);
      u.row(area.first_row + y)[area.first_column + x] = c.u[n];
      v.row(area.first_row + y)[area.first_column + x] = c.v[n];
    }
}

}  // namespace face::flow
