// SPDX-License-Identifier: Apache-2.0
// Small steps between a surface that was cut from a scan and a model of shapes.
#include <gtest/gtest.h>

#include <cmath>

#include "nodes/model/head_points.h"
#include "nodes/model/mean_shape.h"
#include "nodes/model/scan_surface.h"
#include "nodes/model/shape_rig.h"
#include "nodes/model/stretch_space.h"
#include "tests/nodes/model/scans_material.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::model;

namespace {

MeshPoints skin_of(const MorphableModel& surface) {
  const auto skin = static_cast<std::ptrdiff_t>(skin_count(surface));
  return {{surface.mean.points_mm.begin(), surface.mean.points_mm.begin() + skin}};
}

TEST(MeanShape, IsTheMeanOfEveryVertex) {
  const engine::Seq<MeshPoints> shapes({{{{1, 0, 0}}}, {{{3, 2, 0}}}}, {"rest", "open"});
  EXPECT_EQ(mean_shape(shapes).points_mm[0], (Vec3f{2, 1, 0}));
  EXPECT_THROW_TEXT(mean_shape({}), "shapes is empty, expected at least 1 element");
}

TEST(ShapeRig, IsTheSurfaceInThatShapeWithoutMoves) {
  const MorphableModel& surface = test::half_open_surface();
  MeshPoints shape = skin_of(surface);
  for (Vec3f& p : shape.points_mm) p[0] += 5;
  Image texture{static_cast<int>(shape.points_mm.size()), 1, 3, {}};
  texture.pixels.assign(3 * shape.points_mm.size(), 51);
  const Rig rig = shape_rig(surface, shape, &texture);
  EXPECT_EQ(rig.neutral.points_mm, head_points(surface, shape.points_mm));
  EXPECT_EQ(rig.neutral.colors_srgb[0], (Vec3f{0.2f, 0.2f, 0.2f}));
  EXPECT_EQ(shape_rig(surface, shape, nullptr).neutral.colors_srgb, surface.mean.colors_srgb);
  EXPECT_EQ(rig.shapes.size(), arkit_count);
  EXPECT_EQ(rig.missing.size(), arkit_count);
  EXPECT_EQ(rig.landmarks68, surface.landmarks68);
  texture.pixels.pop_back();
  EXPECT_THROW_TEXT(shape_rig(surface, shape, &texture), "texture has " + std::to_string(texture.pixels.size()) +
                                                             " bytes, expected 3 for each of " +
                                                             std::to_string(shape.points_mm.size()) + " vertices");
}

TEST(StretchSpace, MovesStretchesAndBendsTheSkin) {
  const MorphableModel& surface = test::half_open_surface();
  const ShapeModel space = stretch_space(surface, {.place_mm = 8, .stretch_mm = 6, .bend_mm = 3});
  const std::size_t skin = skin_count(surface);
  EXPECT_EQ(space.vertices, skin);
  EXPECT_EQ(space.modes.size(), space.size() * 3 * skin);
  EXPECT_TRUE(std::is_sorted(space.sigmas_mm.rbegin(), space.sigmas_mm.rend()));
  // The widest three are the place: each moves every vertex alike, along one axis.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(space.sigmas_mm[axis], 8);
    for (std::size_t v = 0; v < skin; v += 97)
      for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(space.modes[(axis * skin + v) * 3 + k], k == axis ? 1 : 0);
  }
  // At one deviation no mode moves anything by more than that.
  for (const double value : space.modes) ASSERT_LE(std::abs(value), 1 + 1e-9);
}

}  // namespace
