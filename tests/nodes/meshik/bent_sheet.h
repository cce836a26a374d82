// SPDX-License-Identifier: Apache-2.0
// A sheet of triangles with holes, the size of the papers' face, bent, twisted and stretched into smooth poses.
#pragma once
#include <cmath>
#include <cstdint>
#include <vector>

#include "nodes/base/random.h"

namespace test {

struct BentSheet {
  std::vector<double> reference_mm;
  std::vector<std::uint32_t> triangles;
  std::vector<std::vector<double>> examples_mm;
};

// columns x rows vertices; every `hole`-th triangle is left out (0: none).
inline BentSheet bent_sheet(std::size_t columns, std::size_t rows, std::size_t examples, std::size_t hole = 0) {
  BentSheet sheet;
  const double size = 200.0;  // mm
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t x = 0; x < columns; ++x) {
      const double u = size * static_cast<double>(x) / static_cast<double>(columns - 1) - size / 2;
      const double v = size * static_cast<double>(y) / static_cast<double>(rows - 1) - size / 2;
      sheet.reference_mm.insert(sheet.reference_mm.end(), {u, v, 60 - 0.004 * (u * u + 0.6 * v * v)});
    }
  std::size_t count = 0;
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    if (hole > 0 && count++ % hole == hole - 1) return;
    for (const std::size_t v : {a, b, c}) sheet.triangles.push_back(static_cast<std::uint32_t>(v));
  };
  for (std::size_t y = 0; y + 1 < rows; ++y)
    for (std::size_t x = 0; x + 1 < columns; ++x) {
      const std::size_t a = y * columns + x;
      add(a, a + 1, a + columns);
      add(a + 1, a + columns + 1, a + columns);
    }
  face::Random random(7);
  for (std::size_t k = 0; k < examples; ++k) {
    // Turns about an axis by an angle that varies over the sheet, and a stretch that varies too.
    const double axis[3] = {random.normal(), random.normal(), 0.3 * random.normal()};
    const double norm = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    const double cu = random.uniform(-60, 60), cv = random.uniform(-60, 60), width = random.uniform(40, 90);
    const double turn = random.uniform(0.3, 0.8), grow = random.uniform(-0.2, 0.3);
    std::vector<double> pose = sheet.reference_mm;
    for (std::size_t i = 0; i < pose.size(); i += 3) {
      const double u = pose[i] - cu, v = pose[i + 1] - cv;
      const double near = std::exp(-(u * u + v * v) / (2 * width * width)), angle = turn * near;
      const double p[3] = {u * (1 + grow * near), v, pose[i + 2] - 30};
      double a[3];
      for (std::size_t d = 0; d < 3; ++d) a[d] = axis[d] / norm;
      const double dot = a[0] * p[0] + a[1] * p[1] + a[2] * p[2];
      const double cross[3] = {a[1] * p[2] - a[2] * p[1], a[2] * p[0] - a[0] * p[2], a[0] * p[1] - a[1] * p[0]};
      for (std::size_t d = 0; d < 3; ++d) {
        const double shift[3] = {cu, cv, 30};
        pose[i + d] =
            shift[d] + p[d] * std::cos(angle) + cross[d] * std::sin(angle) + a[d] * dot * (1 - std::cos(angle));
      }
    }
    sheet.examples_mm.push_back(pose);
  }
  return sheet;
}

}  // namespace test
