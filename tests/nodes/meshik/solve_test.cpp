// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/solve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/meshik/blend_jacobian.h"
#include "nodes/meshik/mesh_triangles.h"
#include "nodes/meshik/prepare.h"
#include "nodes/meshik/reconstruct.h"
#include "tests/nodes/meshik/bent_sheet.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::meshik;

MeshSpace space_of(std::size_t examples) {
  const test::BentSheet sheet = test::bent_sheet(15, 13, examples);
  return prepare_triangles(sheet.reference_mm, sheet.triangles, sheet.examples_mm);
}

// x and y of every `every`-th vertex.
VertexTargets targets_of(const std::vector<double>& vertices_mm, std::size_t every, double scale = 1) {
  VertexTargets targets;
  for (std::size_t v = 0; v < vertices_mm.size() / 3; v += every)
    targets.targets.push_back(
        {static_cast<std::uint32_t>(v), scale * vertices_mm[3 * v], scale * vertices_mm[3 * v + 1], 0, false});
  return targets;
}

SolveOptions exact() {
  SolveOptions options;
  options.tolerance = 1e-8;
  return options;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

TEST(Solve, FindsTheWeightsThatMadeTheTargets) {
  const MeshSpace space = space_of(6);
  const std::vector<double> weights = {0.3, 0.1, 0.7, 0, 0.2, 0.5};
  const std::vector<double> vertices = reconstruct_vertices(space, weights);
  const VertexTargets targets = targets_of(vertices, 7);
  SolveOptions options;
  options.restraint = 0;
  options.tolerance = 1e-7;
  const VertexSolution found =
      MeshIkSolver(space, targets).solve_vertices(targets, std::vector<double>(6, 0.0), options);
  EXPECT_TRUE(found.converged);
  EXPECT_LE(found.iterations, 25);
  // The blend of several examples is no mesh's own gradients, so that other weights may explain its vertices better.
  EXPECT_LE(found.energy, MeshIkSolver(space, targets).energy(targets, weights, nullptr));
  EXPECT_LT(largest_difference(found.weights, weights), 0.05);
  EXPECT_LT(largest_difference(found.vertices_mm, vertices), 1.5);
}

TEST(Solve, FindsAnExampleExactly) {
  const test::BentSheet sheet = test::bent_sheet(15, 13, 4);
  const MeshSpace space = prepare_triangles(sheet.reference_mm, sheet.triangles, sheet.examples_mm);
  const VertexTargets targets = targets_of(sheet.examples_mm[2], 5);
  SolveOptions options;
  options.restraint = 0;
  options.tolerance = 1e-7;
  const VertexSolution found =
      MeshIkSolver(space, targets).solve_vertices(targets, std::vector<double>(4, 0.0), options);
  EXPECT_TRUE(found.converged);
  EXPECT_LT(largest_difference(found.weights, {0, 0, 1, 0}), 1e-5);  // the tolerance of the last step
  std::vector<double> z_free = found.vertices_mm, expected = sheet.examples_mm[2];
  EXPECT_LT(largest_difference(z_free, expected), 1e-3);
}

TEST(Solve, PutsTheTargetsExactlyWhereTheyHaveToBe) {
  const MeshSpace space = space_of(5);
  VertexTargets targets = targets_of(reconstruct_vertices(space, {0.2, 0.4, 0, 0.1, 0.3}), 9);
  for (std::size_t i = 0; i < targets.targets.size(); ++i) {
    targets.targets[i].x_mm += 3 * std::sin(static_cast<double>(i));
    if (i % 3 == 0) {
      targets.targets[i].has_z = true;
      targets.targets[i].z_mm = 30 + std::cos(static_cast<double>(i));
    }
  }
  const VertexSolution found = MeshIkSolver(space, targets).solve_vertices(targets, std::vector<double>(5, 0.0), {});
  for (const VertexTarget& target : targets.targets) {
    // 1e-6 of the sheet's diagonal (280 mm) is the bar; the equations are exact.
    EXPECT_NEAR(found.vertices_mm[3 * target.vertex], target.x_mm, 1e-9);
    EXPECT_NEAR(found.vertices_mm[3 * target.vertex + 1], target.y_mm, 1e-9);
    if (target.has_z) {
      EXPECT_NEAR(found.vertices_mm[3 * target.vertex + 2], target.z_mm, 1e-9);
    }
  }
}

TEST(Solve, UncertainTargetsGiveWayToTheExamples) {
  const MeshSpace space = space_of(4);
  const std::vector<double> truth = reconstruct_vertices(space, {0, 0, 0.8, 0});
  VertexTargets targets = targets_of(truth, 3);
  for (std::size_t i = 0; i < targets.targets.size(); ++i)
    targets.targets[i].x_mm += i % 2 == 0 ? 2 : -2, targets.targets[i].y_mm += i % 3 == 0 ? 2 : -1;
  const auto off_mm = [&](double give_mm2) {
    const std::vector<double> found = MeshIkSolver(space, targets, give_mm2)
                                          .solve_vertices(targets, std::vector<double>(4, 0.0), exact())
                                          .vertices_mm;
    double sum = 0;
    for (std::size_t i = 0; i < found.size(); ++i) sum += std::pow(found[i] - truth[i], 2);
    return std::sqrt(sum / static_cast<double>(space.vertex_count));
  };
  EXPECT_LT(off_mm(1000), 0.2 * off_mm(0));
  EXPECT_NEAR(off_mm(1e-9), off_mm(0), 1e-3);
}

void expect_the_gradient_of_differences(double give_mm2) {
  const MeshSpace space = space_of(5);
  const VertexTargets targets = targets_of(reconstruct_vertices(space, {0.9, 0.2, 0.5, 0, 0.3}), 11, 1.05);
  const MeshIkSolver solver(space, targets, give_mm2);
  const std::vector<double> at = {0.4, 1.1, -0.3, 0.8, 0.6};
  std::vector<double> gradient;
  const double energy = solver.energy(targets, at, &gradient);
  for (std::size_t k = 0; k < at.size(); ++k) {
    constexpr double step = 1e-5;
    std::vector<double> up = at, down = at;
    up[k] += step;
    down[k] -= step;
    const double slope = (solver.energy(targets, up, nullptr) - solver.energy(targets, down, nullptr)) / (2 * step);
    EXPECT_NEAR(gradient[k], slope, 1e-6 * energy) << "example " << k;
  }
}

TEST(Solve, HasTheGradientThatDifferencesHave) { expect_the_gradient_of_differences(0); }

TEST(Solve, HasTheGradientThatDifferencesHaveAlsoWithTargetsThatGiveWay) { expect_the_gradient_of_differences(20); }

// What is left of the middle stays at rest, or nearly so: then no triangle is left out.
test::BentSheet half_still(double nudge_mm) {
  test::BentSheet sheet = test::bent_sheet(15, 13, 4);
  for (std::vector<double>& pose : sheet.examples_mm)
    for (std::size_t i = 0; i < pose.size(); i += 3)
      if (sheet.reference_mm[i] <= 0)
        for (std::size_t d = 0; d < 3; ++d)
          pose[i + d] = sheet.reference_mm[i + d] + nudge_mm * std::sin(static_cast<double>(2 * i + d));
  return sheet;
}

TEST(Solve, TrianglesThatNoExampleMovesAreNotBlendedAndCount) {
  const auto space_of = [](const test::BentSheet& sheet) {
    return prepare_triangles(sheet.reference_mm, sheet.triangles, sheet.examples_mm);
  };
  const MeshSpace still = space_of(half_still(0)), all = space_of(half_still(1e-7));
  EXPECT_LT(moving_tile_count(still), tile_count(still) * 6 / 10);
  EXPECT_EQ(moving_tile_count(all), tile_count(all));
  const VertexTargets targets = targets_of(reconstruct_vertices(all, {0.5, 0.1, 0.3, 0.4}), 9, 1.02);
  const auto solve = [&](const MeshSpace& space) {
    return MeshIkSolver(space, targets).solve_vertices(targets, std::vector<double>(4, 0.0), exact());
  };
  const VertexSolution quick = solve(still), whole = solve(all);
  EXPECT_LT(largest_difference(quick.weights, whole.weights), 1e-5);
  EXPECT_LT(largest_difference(quick.vertices_mm, whole.vertices_mm), 1e-4);
  EXPECT_NEAR(quick.energy, whole.energy, 1e-5 * whole.energy);
}

TEST(BlendJacobian, IsWhatDifferencesAre) {
  const MeshSpace space = space_of(3);
  for (const double scale : {0.0, 1e-4, 0.7, 6.0}) {  // up to turns that leave the series
    const std::vector<double> at = {0.5 * scale, -0.3 * scale, 0.8 * scale};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t tile = 0; tile < tile_count(space); tile += 7) {
        BlendTile blend, up, down;
        double derivative[2][3][tile_lanes];
        blend_tile(space, tile, at.data(), blend);
        blend_derivative(space, tile, k, blend, derivative);
        constexpr double step = 1e-5;
        std::vector<double> moved = at;
        moved[k] = at[k] + step;
        blend_tile(space, tile, moved.data(), up);
        moved[k] = at[k] - step;
        blend_tile(space, tile, moved.data(), down);
        for (std::size_t v = 0; v < 2; ++v)
          for (std::size_t d = 0; d < 3; ++d)
            for (std::size_t l = 0; l < tile_lanes; ++l)
              ASSERT_NEAR(derivative[v][d][l], (up.blended[v][d][l] - down.blended[v][d][l]) / (2 * step), 1e-6);
      }
  }
}

TEST(Solve, MovesWithItsTargets) {
  const MeshSpace space = space_of(4);
  VertexTargets targets = targets_of(reconstruct_vertices(space, {0.4, 0.1, 0.2, 0.6}), 7);
  const VertexSolution here =
      MeshIkSolver(space, targets).solve_vertices(targets, std::vector<double>(4, 0.0), exact());
  for (VertexTarget& target : targets.targets) {
    target.x_mm += 400;
    target.y_mm -= 90;
  }
  const VertexSolution there =
      MeshIkSolver(space, targets).solve_vertices(targets, std::vector<double>(4, 0.0), exact());
  EXPECT_LT(largest_difference(here.weights, there.weights), 1e-7);
  for (std::size_t v = 0; v < space.vertex_count; ++v) {
    EXPECT_NEAR(there.vertices_mm[3 * v], here.vertices_mm[3 * v] + 400, 1e-6);
    EXPECT_NEAR(there.vertices_mm[3 * v + 1], here.vertices_mm[3 * v + 1] - 90, 1e-6);
    EXPECT_NEAR(there.vertices_mm[3 * v + 2], here.vertices_mm[3 * v + 2], 1e-6);
  }
}

TEST(Solve, EndsAtTheSameWeightsFromAnyStart) {
  const MeshSpace space = space_of(6);
  const VertexTargets targets = targets_of(reconstruct_vertices(space, {0.3, 0.1, 0.7, 0, 0.2, 0.5}), 7);
  const MeshIkSolver solver(space, targets);
  const VertexSolution cold = solver.solve_vertices(targets, std::vector<double>(6, 0.0), exact());
  const VertexSolution warm = solver.solve_vertices(targets, {0.32, 0.08, 0.68, 0.03, 0.2, 0.5}, exact());
  EXPECT_LT(largest_difference(cold.weights, warm.weights), 1e-5);
  EXPECT_LE(warm.iterations, cold.iterations);
}

TEST(Solve, IsTheReferenceWhereNothingIsAskedFor) {
  const test::BentSheet sheet = test::bent_sheet(7, 6, 3);
  const MeshSpace space = prepare_triangles(sheet.reference_mm, sheet.triangles, sheet.examples_mm);
  const SolveResult found = solve(space, {}, nullptr);
  EXPECT_TRUE(found.converged);
  for (std::size_t v = 0; v < space.vertex_count; ++v)
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_NEAR(static_cast<double>(found.points.points_mm[v][d]), sheet.reference_mm[3 * v + d], 1e-4);
}

TEST(Solve, KnowsNothingOfAFrameThatWasLost) {
  const test::BentSheet sheet = test::bent_sheet(7, 6, 3);
  const MeshSpace space = prepare_triangles(sheet.reference_mm, sheet.triangles, sheet.examples_mm);
  const Weights lost;
  const SolveResult found = solve(space, {}, &lost);
  EXPECT_TRUE(found.weights.values.empty());
  EXPECT_TRUE(found.points.points_mm.empty());
  EXPECT_FALSE(found.converged);
}

TEST(Solve, RejectsTargetsThatAreNoVertexOrTheSameOne) {
  const MeshSpace space = space_of(2);
  EXPECT_THROW_TEXT(solve(space, {{{195, 0, 0, 0, false}}}, nullptr), "target 0 is vertex 195, expected one below 195");
  EXPECT_THROW_TEXT(solve(space, {{{4, 0, 0, 0, false}, {4, 1, 0, 0, false}}}, nullptr),
                    "vertex 4 is a target twice, expected every vertex at most once");
  EXPECT_THROW_TEXT(solve(space, {{{4, std::nan(""), 0, 0, false}}}, nullptr),
                    "target 0 is at nan mm, expected finite numbers");
}

}  // namespace
