// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/blend_jacobian.h"

#include <algorithm>
#include <cmath>

namespace face::meshik {
namespace {

constexpr std::size_t n = tile_lanes;
using Lanes [[gnu::vector_size(64), gnu::aligned(8)]] = double;

const Lanes& lanes(const double* from) { return *reinterpret_cast<const Lanes*>(from); }

struct Vector {
  Lanes x, y, z;
};
Vector vector(const double (&from)[3][n]) { return {lanes(from[0]), lanes(from[1]), lanes(from[2])}; }
Vector vector(const double* from) { return {lanes(from), lanes(from + n), lanes(from + 2 * n)}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vector sum(const Vector& a, const Lanes& s, const Vector& b) { return {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z}; }
// total += a . b (a vector of this length is not returned: its place depends on the processor).
void add_dot(const Vector& a, const Vector& b, Lanes& total) { total += a.x * b.x + a.y * b.y + a.z * b.z; }

// (angle - sin angle) / angle^3
void third_coefficient(const BlendTile& blend, Lanes& c) {
  for (std::size_t l = 0; l < n; ++l) {
    const double s = blend.rotation[0][l] * blend.rotation[0][l] + blend.rotation[1][l] * blend.rotation[1][l] +
                     blend.rotation[2][l] * blend.rotation[2][l];
    // By its series where the difference cancels.
    c[l] = s > 0.01 ? (1 - blend.sine[l]) / s : 1.0 / 6 * (1 - s / 20 * (1 - s / 42 * (1 - s / 72)));
  }
}

// v + sine w x v + cosine w x (w x v): exp[w]x v, and with the next coefficients the left Jacobian; a minus in front of
// the odd term transposes either.
Vector rotate(const Vector& v, const Vector& w, const Lanes& first, const Lanes& second) {
  const Vector c = cross(w, v);
  return sum(sum(v, first, c), second, cross(w, c));
}

}  // namespace

void blend_derivative(const MeshSpace& space, std::size_t tile, std::size_t k, const BlendTile& blend,
                      TileVectors& derivative) {
  const double* parts = &space.blends[(tile * static_cast<std::size_t>(space.example_count) + k) * 9 * n];
  const Vector w = vector(blend.rotation);
  const Lanes sine = lanes(blend.sine), cosine = lanes(blend.cosine);
  Lanes third;
  third_coefficient(blend, third);
  const Vector turn = rotate(vector(parts), w, cosine, third);
  for (std::size_t v = 0; v < 2; ++v) {
    const Vector turned = cross(turn, vector(blend.blended[v]));
    const Vector stretched = rotate(vector(parts + (3 + 3 * v) * n), w, sine, cosine);
    *reinterpret_cast<Lanes*>(derivative[v][0]) = turned.x + stretched.x;
    *reinterpret_cast<Lanes*>(derivative[v][1]) = turned.y + stretched.y;
    *reinterpret_cast<Lanes*>(derivative[v][2]) = turned.z + stretched.z;
  }
}

void add_blend_gradient(const MeshSpace& space, std::size_t tile, const BlendTile& blend, const TileVectors& residual,
                        double* gradient) {
  const auto examples = static_cast<std::size_t>(space.example_count);
  const Vector w = vector(blend.rotation);
  const Lanes sine = lanes(blend.sine), cosine = lanes(blend.cosine);
  Lanes third;
  third_coefficient(blend, third);
  // [J w_k]x p . r = w_k . J' (p x r);  R d . r = d . R' r.
  const Vector r0 = vector(residual[0]), r1 = vector(residual[1]);
  const Vector moment = sum(cross(vector(blend.blended[0]), r0), Lanes{} + 1.0, cross(vector(blend.blended[1]), r1));
  const Vector along[3] = {rotate(moment, w, -cosine, third), rotate(r0, w, -sine, cosine),
                           rotate(r1, w, -sine, cosine)};
  const double* parts = space.blends.data() + tile * examples * 9 * n;
  for (std::size_t k = 0; k < examples; ++k, parts += 9 * n) {
    Lanes terms = {};
    for (std::size_t c = 0; c < 3; ++c) add_dot(vector(parts + 3 * c * n), along[c], terms);
    double total = 0;
    for (std::size_t l = 0; l < n; ++l) total += terms[l];
    gradient[k] += total;
  }
}

}  // namespace face::meshik
