// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/reconstruct.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "nodes/meshik/deformation.h"
#include "nodes/meshik/mesh_triangles.h"
#include "nodes/meshik/prepare.h"
#include "nodes/meshik/reconstruct_matrix.h"
#include "tests/nodes/meshik/bent_sheet.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::meshik;
using Points = std::vector<double>;

MeshSpace space_of(const test::BentSheet& sheet) {
  return prepare_triangles(sheet.reference_mm, sheet.triangles, sheet.examples_mm);
}

double largest_difference(const Points& a, const Points& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

Points turned(const Points& points, const Vec3d& rotation, const Vec3d& shift) {
  const Mat3d r = rotation_matrix(rotation);
  Points moved(points.size());
  for (std::size_t i = 0; i < points.size(); i += 3)
    for (std::size_t d = 0; d < 3; ++d)
      moved[i + d] = r[3 * d] * points[i] + r[3 * d + 1] * points[i + 1] + r[3 * d + 2] * points[i + 2] + shift[d];
  return moved;
}

Eigen::Matrix3d matrix(const Mat3d& m) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(m.data());
}

// As the papers have it: fourth vertices as unknowns, matrix exponential and logarithm, dense least squares.
Points reconstruct_densely(const test::BentSheet& sheet, const std::vector<double>& weights) {
  const auto vertices = static_cast<Eigen::Index>(sheet.reference_mm.size() / 3);
  const auto triangles = static_cast<Eigen::Index>(sheet.triangles.size() / 3);
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(3 * triangles, vertices + triangles), m(3 * triangles, 3);
  const auto corners = [&](const Points& points, Eigen::Index j) {
    std::array<Vec3d, 3> found;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t d = 0; d < 3; ++d)
        found[c][d] = points[3 * sheet.triangles[3 * static_cast<std::size_t>(j) + c] + d];
    return found;
  };
  for (Eigen::Index j = 0; j < triangles; ++j) {
    const auto at = corners(sheet.reference_mm, j);
    Eigen::Vector3d p[3];
    for (std::size_t c = 0; c < 3; ++c) p[c] = {at[c][0], at[c][1], at[c][2]};
    const Eigen::Vector3d n = (p[1] - p[0]).cross(p[2] - p[0]);
    Eigen::Matrix3d frame;
    frame << p[1] - p[0], p[2] - p[0], n / std::sqrt(n.norm());
    const Eigen::Matrix3d inverse = frame.inverse();
    for (Eigen::Index c = 0; c < 3; ++c) {
      const std::uint32_t* corner = &sheet.triangles[3 * static_cast<std::size_t>(j)];
      g(3 * j + c, corner[1]) += inverse(0, c);
      g(3 * j + c, corner[2]) += inverse(1, c);
      g(3 * j + c, vertices + j) += inverse(2, c);
      g(3 * j + c, corner[0]) -= inverse.col(c).sum();
    }
    Eigen::Matrix3d log = Eigen::Matrix3d::Zero(), stretch = Eigen::Matrix3d::Identity();
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const Eigen::Matrix3d f = matrix(deformation_gradient(at, corners(sheet.examples_mm[k], j)));
      const Eigen::Matrix3d s = (f.transpose() * f).sqrt();
      log += weights[k] * (f * s.inverse()).log();
      stretch += weights[k] * (s - Eigen::Matrix3d::Identity());
    }
    m.middleRows(3 * j, 3) = (log.exp() * stretch).transpose();
  }
  Eigen::MatrixXd x = g.completeOrthogonalDecomposition().solve(m).topRows(vertices);
  Points result(sheet.reference_mm.size());
  for (Eigen::Index d = 0; d < 3; ++d) {
    const auto centroid = [&](const Points& points) {
      double sum = 0;
      for (std::size_t i = static_cast<std::size_t>(d); i < points.size(); i += 3) sum += points[i];
      return sum / static_cast<double>(vertices);
    };
    double place = centroid(sheet.reference_mm);
    for (std::size_t k = 0; k < weights.size(); ++k)
      place += weights[k] * (centroid(sheet.examples_mm[k]) - centroid(sheet.reference_mm));
    x.col(d).array() += place - x.col(d).mean();
    for (Eigen::Index v = 0; v < vertices; ++v) result[static_cast<std::size_t>(3 * v + d)] = x(v, d);
  }
  return result;
}

TEST(Reconstruct, IsTheDenseSolutionWithFourthVertices) {
  const test::BentSheet sheet = test::bent_sheet(7, 6, 3, 9);
  const MeshSpace space = space_of(sheet);
  for (const std::vector<double>& weights : {std::vector<double>{0.3, 0.6, 0.2}, {1.3, -0.4, 0.5}, {0, 0, 0}})
    // The dense solution is good to 1e-13 of 200 mm times the condition of G.
    EXPECT_LT(largest_difference(reconstruct_vertices(space, weights), reconstruct_densely(sheet, weights)), 1e-8);
}

TEST(Reconstruct, GivesBackTheReferenceAndEveryExample) {
  const test::BentSheet sheet = test::bent_sheet(15, 13, 4);
  const MeshSpace space = space_of(sheet);
  EXPECT_LT(largest_difference(reconstruct_vertices(space, {0, 0, 0, 0}), sheet.reference_mm), 1e-9);
  for (std::size_t k = 0; k < 4; ++k) {
    std::vector<double> weights(4, 0.0);
    weights[k] = 1;
    EXPECT_LT(largest_difference(reconstruct_vertices(space, weights), sheet.examples_mm[k]), 1e-9);
  }
}

TEST(Reconstruct, TurnsHalfwayRigidlyWhereALinearBlendShrinks) {
  test::BentSheet sheet = test::bent_sheet(9, 9, 0);
  const Vec3d turn = {0, 0, 2};
  sheet.examples_mm = {turned(sheet.reference_mm, turn, {0, 0, 0})};
  const MeshSpace space = space_of(sheet);
  // 200 mm x 1e-12.
  EXPECT_LT(largest_difference(reconstruct_vertices(space, {0.5}), turned(sheet.reference_mm, {0, 0, 1}, {0, 0, 0})),
            1e-9);
  EXPECT_LT(
      largest_difference(reconstruct_vertices(space, {-0.25}), turned(sheet.reference_mm, {0, 0, -0.5}, {0, 0, 0})),
      1e-9);
}

TEST(Reconstruct, MovesAndGrowsWithItsMeshes) {
  const test::BentSheet sheet = test::bent_sheet(9, 8, 3);
  const std::vector<double> weights = {0.4, 0.3, 0.6};
  const Points here = reconstruct_vertices(space_of(sheet), weights);
  test::BentSheet moved = sheet;
  const auto place = [](const Points& points) {
    Points grown = turned(points, {0.3, -0.8, 0.4}, {10, -400, 25});
    for (double& value : grown) value *= 1000;
    return grown;
  };
  moved.reference_mm = place(sheet.reference_mm);
  for (Points& example : moved.examples_mm) example = place(example);
  EXPECT_LT(largest_difference(reconstruct_vertices(space_of(moved), weights), place(here)), 1e-5);  // of 4e5 mm
}

TEST(Reconstruct, PlacesEveryPartOfAMeshOnItsOwn) {
  // Two sheets, of which the second only moves, and a vertex without a triangle.
  test::BentSheet sheet = test::bent_sheet(5, 5, 2);
  const std::size_t count = sheet.reference_mm.size() / 3;
  const std::vector<std::uint32_t> first = sheet.triangles;
  for (const std::uint32_t v : first) sheet.triangles.push_back(v + static_cast<std::uint32_t>(count));
  const Points copy = sheet.reference_mm;
  const auto add = [&](Points& points, double shift) {
    for (std::size_t i = 0; i < copy.size(); ++i) points.push_back(copy[i] + (i % 3 == 0 ? 500 + shift : 0));
    points.insert(points.end(), {shift, 2 * shift, 7});
  };
  add(sheet.reference_mm, 0);
  add(sheet.examples_mm[0], 10);
  add(sheet.examples_mm[1], -4);
  const Points found = reconstruct_vertices(space_of(sheet), {0.5, 1});
  for (std::size_t v = 0; v < count; ++v) EXPECT_NEAR(found[3 * (count + v)], copy[3 * v] + 500 + 5 - 4, 1e-9);
  EXPECT_NEAR(found[6 * count], 1, 1e-12);
  EXPECT_NEAR(found[6 * count + 1], 2, 1e-12);
  EXPECT_NEAR(found[6 * count + 2], 7, 1e-12);
}

TEST(Reconstruct, LeavesOutTrianglesWithoutArea) {
  test::BentSheet sheet = test::bent_sheet(7, 6, 2);
  const Points expected = reconstruct_vertices(space_of(sheet), {0.4, 0.8});
  sheet.triangles.insert(sheet.triangles.end(), {3, 3, 9, 5, 5, 5});
  EXPECT_EQ(reconstruct_vertices(space_of(sheet), {0.4, 0.8}), expected);
}

TEST(Reconstruct, BlendsAMeshOfQuadsWithAShortListOfWeights) {
  const test::BentSheet sheet = test::bent_sheet(6, 5, 2);
  Mesh mesh;
  mesh.points_mm = points_of(sheet.reference_mm);
  for (std::uint32_t y = 0; y < 4; ++y)
    for (std::uint32_t x = 0; x < 5; ++x) {
      mesh.polygon_starts.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
      mesh.corners.insert(mesh.corners.end(), {y * 6 + x, y * 6 + x + 1, y * 6 + x + 7, y * 6 + x + 6});
    }
  mesh.polygon_starts.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  Mesh one = mesh, two = mesh;
  one.points_mm = points_of(sheet.examples_mm[0]);
  two.points_mm = points_of(sheet.examples_mm[1]);
  const MeshSpace space = prepare(mesh, engine::Seq<Mesh>({one, two}));
  EXPECT_EQ(space.triangles.size(), 3 * 40u);
  const MeshPoints found = reconstruct(space, {{1.0f}});
  for (std::size_t v = 0; v < mesh.points_mm.size(); ++v)
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_NEAR(static_cast<double>(found.points_mm[v][d]), static_cast<double>(one.points_mm[v][d]), 1e-4);
}

TEST(ReconstructMatrix, TakesOneFrameAsAColumnAndManyAsRows) {
  const test::BentSheet sheet = test::bent_sheet(6, 5, 3);
  Matrix reference{30, 3, sheet.reference_mm}, examples{3, 90, {}}, faces{40, 3, {}};
  for (const Points& example : sheet.examples_mm)
    examples.values.insert(examples.values.end(), example.begin(), example.end());
  for (const std::uint32_t v : sheet.triangles) faces.values.push_back(v);
  const Matrix many = reconstruct_matrix(reference, examples, faces, {2, 3, {0.1, 0.2, 0.3, 0, 0.5, 0}});
  const Matrix one = reconstruct_matrix(reference, examples, faces, {3, 1, {0, 0.5, 0}});
  EXPECT_EQ(many.rows, 2u);
  EXPECT_EQ(one.rows, 1u);
  EXPECT_EQ(one.values, Points(many.values.begin() + 90, many.values.end()));
  EXPECT_EQ(one.values, reconstruct_vertices(space_of(sheet), {0, 0.5, 0}));
  EXPECT_THROW_TEXT(reconstruct_matrix(reference, examples, faces, {2, 2, {0, 0, 0, 0}}),
                    "weights is 2 x 2, expected T x 3 as there are examples");
  EXPECT_THROW_TEXT(reconstruct_matrix(reference, examples, faces, {2, 3, {}}),
                    "weights holds 0 numbers, expected 2 x 3");
  faces.values[4] = 30;
  EXPECT_THROW_TEXT(reconstruct_matrix(reference, examples, faces, {1, 3, {0, 0, 0}}),
                    "face 1 has vertex 30, expected a whole number from 0 to 29");
}

TEST(Prepare, RejectsExamplesOfAnotherMesh) {
  test::BentSheet sheet = test::bent_sheet(6, 5, 2);
  sheet.examples_mm[1].resize(87);
  EXPECT_THROW_TEXT(space_of(sheet), "example 1 has 29 vertices, expected 30");
  sheet = test::bent_sheet(6, 5, 2);
  sheet.examples_mm[0][10] = std::nan("");
  EXPECT_THROW_TEXT(space_of(sheet), "example 0 has a coordinate of nan at vertex 3, expected finite numbers");
  sheet.triangles[7] = 30;
  EXPECT_THROW_TEXT(prepare_triangles(sheet.reference_mm, sheet.triangles, {}),
                    "triangle 2 has vertex 30, expected one below 30");
  EXPECT_THROW_TEXT(reconstruct_vertices(prepare_triangles(sheet.reference_mm, {0, 1, 2}, {}), {1}),
                    "there are 1 weights, expected 0, one per example");
}

TEST(Deformation, PolarPartsMakeUpTheGradientEvenWhereItMirrors) {
  for (const Mat3d& f : {Mat3d{1.2, 0.3, -0.1, 0, 0.7, 0.5, 0.2, -0.4, 1}, Mat3d{-1, 0.1, 0, 0, 1.3, 0, 0, 0.2, 0.9}}) {
    const PolarParts parts = polar_parts(f);
    const Eigen::Matrix3d made = matrix(rotation_matrix(parts.rotation)) * matrix(parts.stretch);
    EXPECT_LT((made - matrix(f)).norm(), 1e-12);
    EXPECT_LT((matrix(parts.stretch) - matrix(parts.stretch).transpose()).norm(), 1e-12);
  }
}

TEST(Deformation, LeftJacobianIsWhatDifferencesAre) {
  for (const Vec3d& w : {Vec3d{0, 0, 0}, Vec3d{1e-3, 2e-3, -1e-3}, Vec3d{0.05, -0.09, 0.02}, Vec3d{1.2, -0.7, 2}}) {
    const Mat3d j = left_jacobian(w);
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr double step = 1e-6;
      Vec3d up = w, down = w;
      up[k] += step;
      down[k] -= step;
      const Eigen::Matrix3d slope = (matrix(rotation_matrix(up)) - matrix(rotation_matrix(down))) / (2 * step);
      const Eigen::Matrix3d spin = slope * matrix(rotation_matrix(w)).transpose();  // [J e_k]x
      EXPECT_NEAR(spin(2, 1), j[k], 1e-8);
      EXPECT_NEAR(spin(0, 2), j[3 + k], 1e-8);
      EXPECT_NEAR(spin(1, 0), j[6 + k], 1e-8);
    }
  }
}

}  // namespace
