// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/region_pca.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numeric>

#include "nodes/base/pose.h"
#include "nodes/base/random.h"
#include "nodes/model/join_takes.h"
#include "nodes/model/measure_leakage.h"
#include "nodes/model/sample_scan.h"
#include "nodes/phantom/make_head.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::model;

class Heard : public engine::Progress {
 public:
  void warn(const std::string& text) override { texts.push_back(text); }
  std::vector<std::string> texts;
};

// Random shapes of V points, of rank `rank`.
std::vector<MeshPoints> random_shapes(int count, int vertices, int rank, std::uint64_t seed = 1) {
  Random random(seed);
  std::vector<std::vector<double>> modes;
  for (int k = 0; k < rank; ++k) {
    modes.emplace_back();
    for (int i = 0; i < 3 * vertices; ++i) modes.back().push_back(random.normal());
  }
  std::vector<MeshPoints> out;
  for (int j = 0; j < count; ++j) {
    std::vector<double> x(static_cast<std::size_t>(3 * vertices), 5);
    for (int k = 0; k < rank; ++k) {
      const double a = random.normal() * (rank - k);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += a * modes[static_cast<std::size_t>(k)][i];
    }
    out.emplace_back();
    for (std::size_t v = 0; v < static_cast<std::size_t>(vertices); ++v)
      out.back().points_mm.push_back(
          {static_cast<float>(x[3 * v]), static_cast<float>(x[3 * v + 1]), static_cast<float>(x[3 * v + 2])});
  }
  return out;
}

std::vector<double> numbers(const MeshPoints& shape) {
  std::vector<double> out;
  for (const Vec3f& p : shape.points_mm)
    for (const float x : p) out.push_back(static_cast<double>(x));
  return out;
}

}  // namespace

TEST(RegionPca, ReproducesItsExamplesAtFullRank) {
  const std::vector<MeshPoints> shapes = random_shapes(30, 200, 40);
  Matrix weights{200, 1, std::vector<double>(200, 0.0)};
  for (std::size_t v = 20; v < 90; ++v) weights.values[v] = 0.2 + 0.01 * static_cast<double>(v);
  for (const Matrix* w : {static_cast<const Matrix*>(nullptr), static_cast<const Matrix*>(&weights)}) {
    const ShapeModel model = region_pca(engine::Seq<MeshPoints>(shapes), w, {.components = 100});
    EXPECT_EQ(model.size(), 29u);
    for (const MeshPoints& shape : shapes) {
      const std::vector<double> x = numbers(shape), y = shape_of(model, coefficients_of(model, x));
      for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(x[i], y[i], 1e-9);
    }
  }
}

TEST(RegionPca, IsPlainPcaWithoutWeights) {
  const std::vector<MeshPoints> shapes = random_shapes(50, 100, 5);
  const ShapeModel model = region_pca(engine::Seq<MeshPoints>(shapes), nullptr, {.components = 5});
  ASSERT_EQ(model.size(), 5u);
  EXPECT_EQ(model.modes, model.projections);
  for (std::size_t a = 0; a < 5; ++a)
    for (std::size_t b = 0; b < 5; ++b) {
      double product = 0;
      for (std::size_t i = 0; i < 300; ++i) product += model.modes[a * 300 + i] * model.modes[b * 300 + i];
      EXPECT_NEAR(product, a == b ? 1 : 0, 1e-10);
    }
  // Deviations are those of the coefficients.
  for (std::size_t k = 0; k < 5; ++k) {
    double square = 0;
    for (const MeshPoints& s : shapes) square += std::pow(coefficients_of(model, numbers(s))[k], 2);
    EXPECT_NEAR(std::sqrt(square / 50), model.sigmas_mm[k], 1e-9 * model.sigmas_mm[0]);
  }
}

TEST(RegionPca, RegressesTheFaceOnTheRegionOnNoisyData) {
  // What lies outside the region follows it linearly: one component predicts all of it.
  std::vector<MeshPoints> shapes;
  Random random(3);
  for (int j = 0; j < 40; ++j) {
    const auto a = static_cast<float>(random.normal());
    shapes.push_back({{{a, 0, 0}, {0, 2 * a, 0}, {0, 0, -3 * a}}});
  }
  const Matrix weights{3, 1, {1, 0, 0}};
  const ShapeModel model = region_pca(engine::Seq<MeshPoints>(shapes), &weights, {.components = 1});
  const MeshPoints rebuilt = rebuild_shape(model, project_shape(model, shapes[7]));
  for (std::size_t v = 0; v < 3; ++v)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(rebuilt.points_mm[v][k], shapes[7].points_mm[v][k], 1e-5);
}

TEST(RegionPca, GivesTheSameBitsForAnyNumberOfThreads) {
  const std::vector<MeshPoints> shapes = random_shapes(600, 900, 30, 4);
  Matrix weights{900, 1, std::vector<double>(900, 0.0)};
  for (std::size_t v = 100; v < 700; ++v) weights.values[v] = 0.1 + 0.001 * static_cast<double>(v);
  const auto with_threads = [&](std::size_t count) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, count);
    return region_pca(engine::Seq<MeshPoints>(shapes), &weights, {.components = 20});
  };
  const ShapeModel one = with_threads(1), four = with_threads(4);
  EXPECT_EQ(one.mean_mm, four.mean_mm);
  EXPECT_EQ(one.sigmas_mm, four.sigmas_mm);
  EXPECT_EQ(one.modes, four.modes);
  EXPECT_EQ(one.projections, four.projections);
}

// A head that speaks and blinks, every third vertex of its face, with a scanner's noise: as many frames as a corpus.
TEST(RegionPca, LeavesBlinksOutOfTheMouthsComponents) {
  const Rig head = phantom::make_head({.with_hair = false});
  std::vector<std::uint32_t> picked;
  for (std::uint32_t v = 0; v < head.neutral.points_mm.size(); v += 3)
    if (head.neutral.points_mm[v][2] > 20) picked.push_back(v);
  Random random(8);
  std::vector<MeshPoints> shapes;
  std::vector<Weights> truth;
  for (int t = 0; t < 2000; ++t) {
    Weights weights;
    const double blink = t % 97 < 8 ? 1.0 : 0.0;
    const double open = 0.25 * (1 + std::sin(0.9 * t)), pucker = 0.4 * (1 + std::sin(0.37 * t));
    for (const Shape& s : head.shapes)
      weights.values.push_back(s.name.starts_with("eyeBlink")     ? static_cast<float>(blink)
                               : s.name == "jawOpen"              ? static_cast<float>(open)
                               : s.name == "mouthPucker"          ? static_cast<float>(pucker)
                               : s.name.starts_with("mouthSmile") ? static_cast<float>(0.3 * random.uniform())
                                                                  : 0.0f);
    const std::vector<Vec3f> posed = pose_points(head, weights);
    shapes.emplace_back();
    for (const std::uint32_t v : picked) {
      shapes.back().points_mm.push_back(posed[v]);
      for (float& x : shapes.back().points_mm.back()) x += static_cast<float>(0.05 * random.normal());
    }
    truth.push_back(std::move(weights));
  }
  Matrix weights{picked.size(), 1, {}};
  for (const std::uint32_t v : picked) {
    const Vec3f& p = head.neutral.points_mm[v];
    weights.values.push_back(p[1] < -10 && p[1] > -70 && p[2] > 40 && std::fabs(p[0]) < 40 ? 1 : 0);
  }
  const engine::Seq<MeshPoints> all(shapes);
  const auto leakage = [&](const Matrix* region) {
    const ShapeModel model = region_pca(all, region, {.components = 15});
    std::vector<Weights> coefficients;
    for (const MeshPoints& shape : shapes) coefficients.push_back(project_shape(model, shape));
    return measure_leakage(engine::Seq<Weights>(coefficients), engine::Seq<Weights>(truth)).rows[0].values;
  };
  EXPECT_GE(leakage(nullptr)[0], 90);  // it is one of the leading components
  const std::vector<double> region = leakage(&weights);
  EXPECT_LE(region[0], 2);
  EXPECT_LT(region[1], 2);
  EXPECT_EQ(region[3], 2000);
}

TEST(MeasureLeakage, TellsWhatCoefficientsExplain) {
  Random random(2);
  std::vector<Weights> coefficients, truth;
  for (int t = 0; t < 5000; ++t) {
    const auto a = static_cast<float>(random.normal()), b = static_cast<float>(random.normal());
    coefficients.push_back({{a, 1}});
    truth.push_back({{3 * a + 4 * b + 7}});  // 9 of 25 of the variance
  }
  const engine::Seq<Weights> all(truth);
  const Table table = measure_leakage(engine::Seq<Weights>(coefficients), all, {.components = 1});
  EXPECT_EQ(table.rows[0].name, "eyeBlinkLeft");
  EXPECT_NEAR(table.rows[0].values[0], 36, 4);
  EXPECT_NEAR(table.rows[0].values[4], 36, 4);
  coefficients[7] = {};
  EXPECT_EQ(measure_leakage(engine::Seq<Weights>(coefficients), all).rows[0].values[3], 4999);
  for (Weights& w : truth) w.values[0] = 1;
  EXPECT_TRUE(
      std::isnan(measure_leakage(engine::Seq<Weights>(coefficients), engine::Seq<Weights>(truth)).rows[0].values[0]));
  EXPECT_THROW_TEXT(measure_leakage(engine::Seq<Weights>(coefficients), all, {.shape = "blink"}),
                    "shape is \"blink\", expected a name of ARKit's, as eyeBlinkLeft");
}

// 15 coefficients and a movement, each the running mean of `last` frames of noise, independent but for `known`.
std::vector<double> leakage_of_slow_movements(std::size_t last, double known) {
  Random random(4);
  const auto slow = [&] {
    std::vector<double> noise(2000 + last), mean(2000);
    for (double& value : noise) value = random.normal();
    for (std::size_t t = 0; t < mean.size(); ++t)
      mean[t] = std::accumulate(noise.begin() + static_cast<std::ptrdiff_t>(t),
                                noise.begin() + static_cast<std::ptrdiff_t>(t + last), 0.0);
    return mean;
  };
  const std::vector<double> movement = slow();
  std::vector<Weights> coefficients(movement.size()), truth;
  for (const double value : movement) truth.push_back({{static_cast<float>(value)}});
  for (int k = 0; k < 15; ++k) {
    const std::vector<double> own = slow();
    for (std::size_t t = 0; t < own.size(); ++t)
      coefficients[t].values.push_back(static_cast<float>(own[t] + (k == 3 ? known * movement[t] : 0)));
  }
  return measure_leakage(engine::Seq<Weights>(coefficients), engine::Seq<Weights>(truth)).rows[0].values;
}

TEST(MeasureLeakage, TellsCoincidenceFromKnowledge) {
  const std::vector<double> fast = leakage_of_slow_movements(1, 0), slow = leakage_of_slow_movements(40, 0),
                            known = leakage_of_slow_movements(40, 2);
  EXPECT_NEAR(fast[1], 0.75, 0.05);  // 15 coefficients of noise, 2,000 frames
  EXPECT_LT(fast[0], fast[2]);
  EXPECT_NEAR(slow[1], 20, 4);  // as many as 75 independent frames: 2,000 over 40 * 2 / 3
  EXPECT_LT(slow[0], slow[2]);
  EXPECT_GT(known[0], 75);  // 4 of 5 of the variance of one coefficient
  EXPECT_GT(known[0], known[2] + 30);
  EXPECT_LT(fast[4], 0);  // what coincidence teaches is wrong elsewhere
  EXPECT_LT(slow[4], 0);
  EXPECT_GT(known[4], 70);
}

TEST(ProjectShape, GivesNoCoefficientsToALostFrame) {
  const std::vector<MeshPoints> shapes = random_shapes(6, 5, 2);
  const ShapeModel model = region_pca(engine::Seq<MeshPoints>(shapes), nullptr);
  const bool known = true, lost = false;
  EXPECT_EQ(project_shape(model, shapes[0], &known).values, project_shape(model, shapes[0]).values);
  EXPECT_TRUE(project_shape(model, shapes[0], &lost).values.empty());
}

TEST(ProjectShape, CountsInDeviationsWhereAsked) {
  const std::vector<MeshPoints> shapes = random_shapes(40, 30, 3);
  ShapeModel model = region_pca(engine::Seq<MeshPoints>(shapes), nullptr);
  double square = 0;
  for (const MeshPoints& shape : shapes) {
    const Weights a = project_shape(model, shape, nullptr, {.in_sigmas = true});
    square += std::pow(static_cast<double>(a.values[2]), 2) / 40;
    const MeshPoints back = rebuild_shape(model, a, {.in_sigmas = true});
    for (std::size_t v = 0; v < 30; ++v) EXPECT_NEAR(back.points_mm[v][1], shape.points_mm[v][1], 1e-3);
  }
  EXPECT_NEAR(square, 1, 1e-5);
  model.sigmas_mm[1] = 0;
  EXPECT_THROW_TEXT(project_shape(model, shapes[0], nullptr, {.in_sigmas = true}),
                    "the model has a deviation of 0, expected more than 0");
}

TEST(RegionPca, AmplifiesDeparturesFromTheMean) {
  const std::vector<MeshPoints> shapes = random_shapes(20, 30, 3);
  const ShapeModel model = region_pca(engine::Seq<MeshPoints>(shapes), nullptr, {.components = 3});
  const Weights a = project_shape(model, shapes[0]);
  const MeshPoints once = rebuild_shape(model, a), thrice = rebuild_shape(model, a, {.amplify = 3});
  for (std::size_t v = 0; v < 30; ++v)
    EXPECT_NEAR(thrice.points_mm[v][0] - model.mean_mm[3 * v], 3 * (once.points_mm[v][0] - model.mean_mm[3 * v]), 1e-3);
}

TEST(RegionPca, DropsComponentsOfNoDeviation) {
  EXPECT_EQ(region_pca(engine::Seq<MeshPoints>(random_shapes(25, 60, 4)), nullptr, {.components = 20}).size(), 4u);
  const std::vector<MeshPoints> same(4, random_shapes(1, 10, 1)[0]);
  EXPECT_EQ(region_pca(engine::Seq<MeshPoints>(same), nullptr).size(), 0u);
}

TEST(RegionPca, RejectsWhatDoesNotFit) {
  std::vector<MeshPoints> shapes = random_shapes(3, 10, 2);
  EXPECT_THROW_TEXT(region_pca(engine::Seq<MeshPoints>({shapes[0]}), nullptr),
                    "shapes has 1 examples, expected at least 2");
  Matrix weights{9, 1, std::vector<double>(9, 1)};
  EXPECT_THROW_TEXT(region_pca(engine::Seq<MeshPoints>(shapes), &weights),
                    "weights has 9 values, shapes have 10 points");
  weights = {10, 1, std::vector<double>(10, -1)};
  EXPECT_THROW_TEXT(region_pca(engine::Seq<MeshPoints>(shapes), &weights), "weights has -1, expected none below 0");
  shapes[2].points_mm.pop_back();
  EXPECT_THROW_TEXT(region_pca(engine::Seq<MeshPoints>(shapes), nullptr), "shape 2 has 9 points, 0 has 10");
}

TEST(ModelRig, PosesAsTheModelDoes) {
  const std::vector<MeshPoints> shapes = random_shapes(20, 30, 3);
  const ShapeModel model = region_pca(engine::Seq<MeshPoints>(shapes), nullptr, {.components = 3});
  Mesh mesh;
  mesh.points_mm.resize(30);
  const Rig rig = model_rig(model, mesh);
  const Weights a = project_shape(model, shapes[4]);
  const std::vector<Vec3f> posed = pose_points(rig, a);
  for (std::size_t v = 0; v < 30; ++v) EXPECT_NEAR(posed[v][1], shapes[4].points_mm[v][1], 1e-3);
  EXPECT_EQ(rig.shapes[2].name, "pc_3");
}

TEST(SampleScan, MovesVerticesWithTheFlowAndFillsWhatIsMissing) {
  DepthScan reference;
  reference.camera.focal_px = 100;
  reference.camera.position_mm = {0, 0, 100};
  reference.camera.centre_x_px = reference.camera.centre_y_px = 15.5f;
  reference.picture = {32, 32, 1, std::vector<std::uint8_t>(32 * 32, 90)};
  reference.depth_mm.assign(32 * 32, 100);
  reference.depth_mm[0] = 0;
  DepthScan target = reference;
  std::fill(target.depth_mm.begin(), target.depth_mm.end(), 101.0f);
  target.picture.pixels.assign(32 * 32, 140);
  FlowField flow{32, 32, std::vector<Vec2f>(32 * 32, {1, 0}), std::vector<std::uint8_t>(32 * 32, 1)};
  for (int x = 10; x < 20; ++x) flow.valid[static_cast<std::size_t>(16 * 32 + x)] = 0;
  const Mesh mesh = scan_mesh(reference);
  ASSERT_EQ(mesh.points_mm.size(), 255u);
  EXPECT_EQ(mesh.polygon_count(), 15u * 15u * 2u - 1u);
  const SampleScanResult result = sample_scan(reference, target, flow);
  for (std::size_t v = 0; v < 255; ++v) {
    EXPECT_NEAR(result.shape.points_mm[v][0], (mesh.points_mm[v][0] + 1) * 1.01, 0.02);  // 1 px = 1 mm here
    EXPECT_NEAR(result.shape.points_mm[v][2], -1, 1e-3);
    EXPECT_EQ(result.texture.pixels[v], 140);
  }
  EXPECT_LT(result.sampled, 1);
}

TEST(SampleScan, RejectsAFlowOfAnotherSize) {
  DepthScan scan;
  scan.picture = {4, 4, 1, std::vector<std::uint8_t>(16, 0)};
  scan.depth_mm.assign(16, 50);
  EXPECT_THROW_TEXT(sample_scan(scan, scan, {3, 3, {}, {}}), "flow is 3 x 3 pixels, reference 4 x 4");
}

TEST(JoinTakes, PutsTakesOneAfterTheOther) {
  const Phones a{{{"AA", 0, 1, "a", 0}}, 1, true}, b{{{"B", 0, 0.5, "b", 0}}, 0.5, true};
  const Timeline ta{{0, 0.5, 1.0}, 1.5}, tb{{0, 0.25}, 0.5};
  Heard heard;
  const JoinTakesResult joined = join_takes(engine::Seq<Phones>({a, b}), engine::Seq<Timeline>({ta, tb}), heard);
  EXPECT_TRUE(heard.texts.empty());
  ASSERT_EQ(joined.phones.phones.size(), 3u);
  EXPECT_EQ(joined.phones.phones[1].label, "SIL");
  EXPECT_EQ(joined.phones.phones[2].start_s, 1.5);
  EXPECT_EQ(joined.timeline.time_s, (std::vector<double>{0, 0.5, 1.0, 1.5, 1.75}));
  EXPECT_EQ(joined.phones.duration_s, 2);
}

TEST(JoinTakes, RejectsTakesInAnotherOrder) {
  const Phones a{{{"AA", 0, 1, "a", 0}}, 1, true};
  const Timeline t{{0, 0.5}, 1};
  Heard heard;
  EXPECT_THROW_TEXT(
      join_takes(engine::Seq<Phones>({a, a}, {"2", "10"}), engine::Seq<Timeline>({t, t}, {"10", "2"}), heard),
      "phones has take 2 at 0, timelines take 10");
}

TEST(JoinTakes, NamesATakeWhoseSoundIsNotItsOwn) {
  const Phones a{{{"AA", 0, 1, "a", 0}}, 1, true};
  const Timeline short_one{{0, 0.5, 1.0}, 1.5}, long_one{{0, 0.5, 1.0, 1.5}, 2};
  Heard heard;
  join_takes(engine::Seq<Phones>({a, a}, {"one", "two"}), engine::Seq<Timeline>({short_one, long_one}, {"one", "two"}),
             heard);
  ASSERT_EQ(heard.texts.size(), 1u);
  EXPECT_EQ(heard.texts[0],
            "take two: its speech lasts 1 s, its frames 2 s, expected the same: is the sound that of this take, and "
            "rate_hz right?");
}

TEST(RegionWeights, AreOneInTheMiddleAndNoneOutside) {
  Mesh mesh;
  mesh.points_mm.resize(2);
  mesh.uvs = {{0.5f, 0.32f}, {0.1f, 0.9f}};
  const Matrix weights = region_weights(mesh);
  EXPECT_NEAR(weights.values[0], 1, 1e-9);
  EXPECT_EQ(weights.values[1], 0);
  mesh.uvs.pop_back();
  EXPECT_THROW_TEXT(region_weights(mesh), "mesh has 1 uvs, expected one for each of its 2 points");
}
