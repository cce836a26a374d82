// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/extract.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "nodes/model/pose_model.h"
#include "nodes/model/skin_atlas.h"
#include "nodes/render/camera.h"
#include "nodes/render/shade.h"
#include "nodes/texture/posed_face.h"
#include "tests/nodes/texture/drawn_face.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::texture;
using namespace test;

namespace {

// A face as true_fit(0) has it, with lips' colour all over.
struct LipsEverywhere {
  LipsEverywhere() {
    fit.lip_gap_mm = 6;
    AlbedoMap map = striped_map();
    std::fill(map.albedo.begin(), map.albedo.end(), Vec3f{0.4f, 0.15f, 0.12f});
    picture = drawn(fit, map, rest());
    screen = render::project(fit.camera, model.mean.points_mm);
  }
  void paint(int x, int y, std::uint8_t grey) {
    for (std::size_t c = 0; c < 3; ++c) picture.pixels[static_cast<std::size_t>(3 * (y * 320 + x)) + c] = grey;
  }

  const MorphableModel& model = test::head_model();
  FaceFit fit = true_fit(0);
  Image picture;
  std::vector<render::ScreenPoint> screen;  // of the model's vertices
};

// Of a map of 512 x 512.
const Vec3f& texel_at(const AlbedoMap& map, const Vec2f& uv) {
  return map.albedo[static_cast<std::size_t>((1 - uv[1]) * 511) * 512 + static_cast<std::size_t>(uv[0] * 511)];
}

TEST(Extract, GetsBackTheColoursThatWereDrawn) {
  const FaceFit fit = true_fit(10);
  const AlbedoMap truth = striped_map();
  const AlbedoMap found = extract(test::head_model(), drawn(fit, truth, rest()), fit, {.size_px = 512});
  std::vector<double> errors;
  for (std::size_t i = 0; i < found.weight.size(); ++i)
    if (found.weight[i] > 0.5f)
      for (std::size_t c = 0; c < 3; ++c) errors.push_back(std::abs(found.albedo[i][c] - truth.albedo[i][c]));
  ASSERT_GT(errors.size(), 3000u);
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.012);  // 8 bits and one resampling
}

TEST(Extract, TakesWhatIsNotSeenFromTheModel) {
  const FaceFit fit = true_fit(40);
  const AlbedoMap found = extract(test::head_model(), drawn(fit, striped_map(), rest()), fit, {.size_px = 256});
  std::size_t seen = 0, hidden = 0;
  for (std::size_t i = 0; i < found.weight.size(); ++i) {
    if (found.weight[i] > 0.1f) ++seen;
    if (found.weight[i] == 0 && found.albedo[i][0] > 0) {
      ++hidden;
      EXPECT_TRUE(std::isfinite(found.albedo[i][0]));
    }
  }
  EXPECT_GT(seen, 1000u);
  EXPECT_GT(hidden, 1000u);
}

TEST(Extract, RejectsAPictureOfAnotherSize) {
  EXPECT_THROW_TEXT(extract(test::head_model(), test::blank(10, 10), true_fit(0)),
                    "the picture is 10 x 10 pixels, the fit was made on 320 x 320");
}

// A fit that is a pixel or two off paints teeth on the lips; at rest they would stay there as a pale line.
TEST(Extract, ReadsNoTeethOnLips) {
  LipsEverywhere face;
  const auto place = [&](std::size_t mark) { return face.screen[face.model.landmarks68[mark]]; };
  // As wide as the inner lips, and into the lower lip.
  const int top = static_cast<int>(place(66).y_px), bottom = top + 3;
  const int right = static_cast<int>(place(61).x_px), left = static_cast<int>(place(63).x_px);
  for (int y = top; y <= bottom; ++y)
    for (int x = right; x <= left; ++x) face.paint(x, y, 200);
  const AlbedoMap found = extract(face.model, face.picture, face.fit, {.size_px = 512});
  const model::SkinAtlas atlas = model::make_skin_atlas(face.model.mean);
  double palest = 0;
  for (std::size_t t = 0; t < atlas.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const render::ScreenPoint& at = face.screen[atlas.triangles[t][i]];
      if (at.x_px < right + 1 || at.x_px > left - 1 || at.y_px < top || at.y_px > bottom) continue;
      const Vec3f& colour = texel_at(found, atlas.uvs[atlas.corners[t][i]]);
      if (colour[0] > 0) palest = std::max(palest, static_cast<double>(colour[1] / colour[0]));
    }
  EXPECT_GT(palest, 0);
  EXPECT_LT(palest, 0.6);  // the lips' is 0.375, the teeth's 1
}

// The corners of a smile are dark; a fit whose mouth is narrower paints them on the lips.
TEST(Extract, ReadsNoDarkCornersOfTheMouthOnLips) {
  LipsEverywhere face;
  const render::ScreenPoint& corner = face.screen[face.model.landmarks68[48]];
  const auto near_corner = [&](float x, float y) { return std::hypot(x - corner.x_px - 4, y - corner.y_px + 7) < 5; };
  for (int y = 0; y < 320; ++y)
    for (int x = 0; x < 320; ++x)
      if (near_corner(static_cast<float>(x), static_cast<float>(y))) face.paint(x, y, 25);
  const AlbedoMap found = extract(face.model, face.picture, face.fit, {.size_px = 512});
  const model::SkinAtlas atlas = model::make_skin_atlas(face.model.mean);
  double darkest = 1;
  for (std::size_t t = 0; t < atlas.triangles.size(); ++t) {
    const render::ScreenPoint& at = face.screen[atlas.triangles[t][0]];
    if (at.depth_mm > corner.depth_mm + 10 || !near_corner(at.x_px, at.y_px)) continue;
    const Vec3f& colour = texel_at(found, atlas.uvs[atlas.corners[t][0]]);
    if (colour[0] > 0) darkest = std::min(darkest, static_cast<double>(colour[0]));
  }
  EXPECT_LT(darkest, 1);
  EXPECT_GT(darkest, 0.05);  // the lips' is 0.4, the corner's 0.01
}

// The shadow in a smile's fold stayed on the cheek when the smile was gone, as an orange spot beside the nostril.
TEST(Extract, ReadsNoShadowInFolds) {
  FaceFit fit = true_fit(0);
  const MorphableModel& model = test::head_model();
  for (std::size_t k = 0; k < 3; ++k) fit.expression[k] = 3 * model.expression.sigmas[k];
  const std::vector<Vec3f> points = model::pose_model(model, fit.identity, fit.expression);
  const PosedFace posed = pose_face(model.mean, points, fit, 1);
  const std::vector<Vec3f> rest_normals = render::vertex_normals(model.mean.points_mm, posed.solid.triangles);
  const model::SkinAtlas atlas = model::make_skin_atlas(model.mean);
  const auto texel = [&](std::size_t t) {
    const Vec2f& uv = atlas.uvs[atlas.corners[t][0]];
    return std::array<int, 2>{static_cast<int>(uv[0] * 511), static_cast<int>((1 - uv[1]) * 511)};
  };
  const auto is_fold = [&](std::size_t t) {
    const std::uint32_t v = atlas.triangles[t][0];
    return render::dot(render::normalized(posed.normals[v]), render::normalized(rest_normals[v])) <
           0.88f;  // 28 degrees
  };
  AlbedoMap map = striped_map();
  std::fill(map.albedo.begin(), map.albedo.end(), Vec3f{0.4f, 0.3f, 0.2f});
  for (std::size_t t = 0; t < atlas.triangles.size(); ++t) {
    if (!is_fold(t)) continue;
    const auto [x, y] = texel(t);
    for (int dy = -3; dy <= 3; ++dy)
      for (int dx = -3; dx <= 3; ++dx)
        map.albedo[static_cast<std::size_t>(std::clamp(y + dy, 0, 511) * 512 + std::clamp(x + dx, 0, 511))] = {
            0.1f, 0.05f, 0.02f};
  }
  Rig person = test::head();
  person.landmarks68.clear();
  const Image paper = test::blank(320, 320, 90);
  const Image picture =
      lay_over(draw_face(person, map, points, points, fit, {.samples = 3}), paper, paper, face_mask(model, fit), 1);
  const AlbedoMap found = extract(model, picture, fit, {.size_px = 512});
  std::size_t folds = 0, dark = 0;
  for (std::size_t t = 0; t < atlas.triangles.size(); ++t) {
    if (!is_fold(t) || posed.normals[atlas.triangles[t][0]][2] < 0.3f) continue;
    const auto [x, y] = texel(t);
    ++folds;
    if (found.albedo[static_cast<std::size_t>(y * 512 + x)][0] < 0.2f) ++dark;
  }
  EXPECT_GT(folds, 30u);
  EXPECT_LT(static_cast<double>(dark), 0.25 * static_cast<double>(folds));
}

}  // namespace
