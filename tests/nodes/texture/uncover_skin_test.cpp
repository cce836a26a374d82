// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/uncover_skin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/nodes/model/material.h"

using namespace face;
using namespace face::texture;

namespace {

struct Painted {
  const MorphableModel& model = test::head_model();
  SeenSkin seen;
  Painted() {
    seen.colour = model.mean_albedo;
    seen.sure.assign(seen.colour.size(), 1.0f);
    std::vector<bool> skin(seen.colour.size());
    for (const Part& part : model.mean.parts)
      for (std::uint32_t c = model.mean.polygon_starts[part.first_polygon];
           part.name == "face" && c < model.mean.polygon_starts[part.first_polygon + part.polygon_count]; ++c)
        skin[model.mean.corners[c]] = true;
    for (std::size_t v = 0; v < skin.size(); ++v)
      if (!skin[v]) seen.colour[v] = {0, 0, 0};
  }
  Vec3f mark(std::size_t i) const { return model.mean.points_mm[model.landmarks68[i]]; }
  template <class Share>
  void paint(Share share) {
    for (std::size_t v = 0; v < seen.colour.size(); ++v)
      for (float& value : seen.colour[v]) value *= share(model.mean.points_mm[v]);
  }
  // How dark the darkest place that `is_there` says is, over the mean's; 1 = as the mean.
  template <class Where>
  float darkest(Where is_there) const {
    const std::vector<Vec3f> skin = uncover_skin(model, test::head(), seen, 0.3);
    float least = 10;
    for (std::size_t v = 0; v < skin.size(); ++v)
      if (skin[v][0] > 0 && is_there(model.mean.points_mm[v]))
        least = std::min(least, skin[v][1] / model.mean_albedo[v][1]);
    return least;
  }
};

TEST(UncoverSkin, LeavesPlainSkinAsItIs) {
  const Painted face;
  EXPECT_GT(face.darkest([](const Vec3f&) { return true; }), 0.97f);
}

// Hair over the temples stayed as dark patches that ended at the brows' ends.
TEST(UncoverSkin, FollowsStrandsFromTheTemplesInwards) {
  Painted face;
  const float tail = face.mark(26)[0], eyes = face.mark(45)[1], outer = face.mark(45)[0];
  const auto hair = [&](const Vec3f& p) {
    return std::abs(p[0]) > (p[1] < eyes - 10 ? outer - 6 : 0.92f * tail) && p[1] > eyes - 28 && p[2] > 0;
  };
  face.paint([&](const Vec3f& p) { return hair(p) ? 0.3f : 1.0f; });
  const auto shown = [&](const Vec3f& p) {
    return hair(p) && (p[1] < eyes - 18 || std::abs(p[0]) > outer + 9) && (p[1] < eyes || p[1] > face.mark(26)[1] + 8);
  };
  EXPECT_GT(face.darkest(shown), 0.85f);
}

TEST(UncoverSkin, TakesFromTheOtherSideWhatAMicrophoneHides) {
  Painted face;
  const Vec3f cheek = face.mark(54);
  const auto is_hidden = [&](const Vec3f& p) {
    return p[2] > 0 && std::hypot(p[0] - cheek[0] - 20, p[1] - cheek[1]) < 9;
  };
  face.paint([&](const Vec3f& p) { return is_hidden(p) ? 0.1f : 1.0f; });
  EXPECT_GT(face.darkest(is_hidden), 0.85f);
}

TEST(UncoverSkin, KeepsBrowsUnderAFringe) {
  Painted face;
  const auto is_brow = [&](const Vec3f& p) {
    for (std::size_t i = 18; i < 26; ++i)
      if (std::hypot(p[0] - face.mark(i)[0], p[1] - face.mark(i)[1]) < 3 && p[2] > 0) return true;
    return false;
  };
  const float fringe = std::max(face.mark(19)[1], face.mark(24)[1]) + 4;
  face.paint([&](const Vec3f& p) { return is_brow(p) || p[1] > fringe ? 0.2f : 1.0f; });
  const std::vector<Vec3f> skin = uncover_skin(face.model, test::head(), face.seen, 0.3);
  for (std::size_t v = 0; v < skin.size(); ++v)
    if (skin[v][0] > 0 && is_brow(face.model.mean.points_mm[v])) {
      EXPECT_LT(skin[v][1], 0.5f * face.model.mean_albedo[v][1]);
    }
}

// A room has more lights than the fit's one: one cheek came out lighter than the other.
TEST(UncoverSkin, TakesAShadeFromOneSideToTheOtherForLight) {
  Painted face;
  face.paint([](const Vec3f& p) { return std::exp(0.003f * p[0]); });
  const std::vector<Vec3f> skin = uncover_skin(face.model, test::head(), face.seen, 0.3);
  const auto over_mean = [&](std::size_t i) {
    const std::uint32_t v = face.model.landmarks68[i];
    return std::log(skin[v][1] / face.model.mean_albedo[v][1]);
  };
  EXPECT_LT(std::abs(over_mean(54) - over_mean(48)), 0.35f * 0.003f * (face.mark(54)[0] - face.mark(48)[0]));
}

TEST(UncoverSkin, HidesNothingWithoutContrastOrLandmarks) {
  Painted face;
  face.paint([](const Vec3f& p) { return p[1] > 60 ? 0.1f : 1.0f; });
  EXPECT_EQ(uncover_skin(face.model, test::head(), face.seen, 0), face.seen.colour);
  Rig unmarked = test::head();
  unmarked.landmarks68.clear();
  EXPECT_EQ(uncover_skin(face.model, unmarked, face.seen, 0.3), face.seen.colour);
}

}  // namespace
