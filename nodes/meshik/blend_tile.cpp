// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/blend_tile.h"

#include <cmath>

namespace face::meshik {
namespace {

constexpr std::size_t n = tile_lanes;
using Lanes [[gnu::vector_size(64), gnu::aligned(8)]] = double;
using Four [[gnu::vector_size(32), gnu::aligned(8)]] = double;

// sin x / x and (1 - cos x) / x^2 as series in s = x^2 <= 2: the first term left out is below 1e-17 of the sum.
void series(const Lanes& s, Lanes& sine, Lanes& cosine) {
  constexpr int terms = 10;
  sine = cosine = Lanes{} + 1.0;
  for (int i = terms; i > 0; --i) {
    const double k = 2.0 * i;
    sine = 1.0 - s * sine * (1 / (k * (k + 1)));
    cosine = 1.0 - s * cosine * (1 / ((k + 1) * (k + 2)));
  }
  cosine *= 0.5;
}

}  // namespace

void blend_tile(const MeshSpace& space, std::size_t tile, const double* weights, BlendTile& blend) {
  const auto examples = static_cast<std::size_t>(space.example_count);
  const double* q = &space.frames[tile * 6 * n];
  const double* parts = space.blends.data() + tile * examples * 9 * n;
  Lanes sum[9];
  // Half of the lanes at a time: nine sums of eight numbers do not fit into the registers.
  for (std::size_t first = 0; first < n; first += 4) {
    const auto four = [&](const double* from) -> const Four& { return *reinterpret_cast<const Four*>(from + first); };
    Four part[9] = {};
    for (std::size_t c = 0; c < 6; ++c) part[3 + c] = four(q + c * n);
    for (std::size_t i = 0; i < examples; ++i)
      for (std::size_t c = 0; c < 9; ++c) part[c] += weights[i] * four(parts + (i * 9 + c) * n);
    for (std::size_t c = 0; c < 9; ++c) *reinterpret_cast<Four*>(reinterpret_cast<double*>(&sum[c]) + first) = part[c];
  }

  const Lanes& x = sum[0];
  const Lanes& y = sum[1];
  const Lanes& z = sum[2];
  const Lanes square = x * x + y * y + z * z;
  Lanes sine, cosine;
  double largest = 0;
  for (std::size_t l = 0; l < n; ++l) largest = square[l] > largest ? square[l] : largest;
  if (largest <= 2) {
    series(square, sine, cosine);
  } else {
    for (std::size_t l = 0; l < n; ++l) {
      const double angle = std::sqrt(square[l]);
      const double half = angle > 0 ? std::sin(angle / 2) / angle : 0.5;
      sine[l] = angle > 0 ? std::sin(angle) / angle : 1;
      cosine[l] = 2 * half * half;
    }
  }
  const auto put = [](double* to, const Lanes& from) { *reinterpret_cast<Lanes*>(to) = from; };
  put(blend.sine, sine);
  put(blend.cosine, cosine);
  for (std::size_t c = 0; c < 3; ++c) put(blend.rotation[c], sum[c]);
  for (std::size_t v = 0; v < 2; ++v) {
    const Lanes p[3] = {sum[3 + 3 * v], sum[4 + 3 * v], sum[5 + 3 * v]};
    const Lanes c[3] = {y * p[2] - z * p[1], z * p[0] - x * p[2], x * p[1] - y * p[0]};  // w x p
    const Lanes cc[3] = {y * c[2] - z * c[1], z * c[0] - x * c[2], x * c[1] - y * c[0]};
    for (std::size_t d = 0; d < 3; ++d) {
      put(blend.stretched[v][d], p[d]);
      put(blend.blended[v][d], p[d] + sine * c[d] + cosine * cc[d]);
    }
  }
}

}  // namespace face::meshik
