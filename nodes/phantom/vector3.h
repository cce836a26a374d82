// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>

#include "nodes/types/vec.h"

namespace face::phantom {

// A point or a direction while a head is being built, in mm.
struct Vector3 {
  double x = 0, y = 0, z = 0;
};

inline Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector3 operator*(Vector3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vector3 operator*(double s, Vector3 a) { return a * s; }
inline Vector3& operator+=(Vector3& a, Vector3 b) { return a = a + b; }
inline double dot(Vector3 a, Vector3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double length(Vector3 a) { return std::sqrt(dot(a, a)); }
inline Vector3 unit(Vector3 a) { return a * (1 / std::max(length(a), 1e-12)); }
inline Vector3 cross(Vector3 a, Vector3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vector3 lerp(Vector3 a, Vector3 b, double t) { return a + (b - a) * t; }
inline Vector3 mirrored(Vector3 a) { return {-a.x, a.y, a.z}; }
inline Vec3f to_float(Vector3 a) { return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)}; }

inline double lerp(double a, double b, double t) { return a + (b - a) * t; }
inline double square(double x) { return x * x; }
// 0 below low, 1 above high, with a continuous slope. low > high gives a falling step.
inline double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}
// 1 at the centre, exp(-1) at one radius.
inline double bell(double x, double radius) { return std::exp(-square(x / radius)); }

}  // namespace face::phantom
