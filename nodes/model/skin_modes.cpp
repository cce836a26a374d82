// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/skin_modes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "nodes/phantom/face_places.h"
#include "nodes/phantom/person_skin.h"
#include "nodes/render/shade.h"

namespace face::model {
namespace {

// How much a component of one standard deviation changes reflectance, as a share of it.
constexpr float tone_sigma = 0.22f, feature_sigma = 0.2f, wave_sigma = 0.08f;
constexpr int wave_columns = 5, wave_rows = 6;

struct Colour {
  const char* name;
  Vec3f share;  // of the vertex's reflectance per channel
};
constexpr std::array<Colour, 3> colours = {
    {{"light", {1, 1, 1}}, {"red", {0.3f, -0.3f, -0.25f}}, {"yellow", {0.2f, 0.1f, -0.5f}}}};

float distance(const Vec3f& a, const Vec3f& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

using Pattern = std::function<float(const Vec3f&)>;

// Near the polyline of these points: 1 on it, falling to 0 as a bell of this width.
Pattern near_points(std::vector<Vec3f> points, float width_mm) {
  return [points = std::move(points), width_mm](const Vec3f& p) {
    float nearest = 1e9f;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3f& a = points[i];
      const Vec3f& b = points[std::min(i + 1, points.size() - 1)];
      for (int step = 0; step < 4; ++step) {
        const float t = 0.25f * static_cast<float>(step);
        nearest = std::min(nearest,
                           distance(p, {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])}));
      }
    }
    const float u = nearest / width_mm;
    return std::exp(-u * u);
  };
}

}  // namespace

std::vector<Vec3f> vertex_albedo(const Mesh& mesh) {
  const render::SrgbTable srgb;
  std::vector<Vec3f> albedo(mesh.points_mm.size(), Vec3f{0.6f, 0.6f, 0.6f});
  for (const Part& part : mesh.parts)
    for (std::size_t c = mesh.polygon_starts[part.first_polygon];
         c < mesh.polygon_starts[part.first_polygon + part.polygon_count]; ++c)
      for (std::size_t k = 0; k < 3; ++k) albedo[mesh.corners[c]][k] = srgb.linear(part.albedo_srgb[k]);
  if (mesh.colors_srgb.size() == albedo.size())
    for (std::size_t v = 0; v < albedo.size(); ++v)
      for (std::size_t k = 0; k < 3; ++k) albedo[v][k] *= srgb.linear(mesh.colors_srgb[v][k]);
  return albedo;
}

std::vector<bool> skin_vertices(const Mesh& mesh) {
  std::vector<bool> skin(mesh.points_mm.size(), false);
  bool any = false;
  for (const Part& part : mesh.parts) {
    if (part.name != "face") continue;
    any = true;
    for (std::size_t c = mesh.polygon_starts[part.first_polygon];
         c < mesh.polygon_starts[part.first_polygon + part.polygon_count]; ++c)
      skin[mesh.corners[c]] = true;
  }
  if (!any) skin.assign(skin.size(), true);
  return skin;
}

LinearSpace skin_modes(const Mesh& mesh, const std::vector<Vec3f>& albedo,
                       const std::vector<std::uint32_t>& landmarks68, std::size_t count) {
  const std::vector<Vec3f>& points = mesh.points_mm;
  struct Named {
    std::string name;
    Pattern pattern;
    float sigma;
  };
  std::vector<Named> patterns = {{"tone", [](const Vec3f&) { return 1.0f; }, tone_sigma}};
  Vec3f low = {-80, -90, 0}, high = {80, 90, 0};
  if (landmarks68.size() == 68) {
    const auto mark = [&](std::size_t i) { return points[landmarks68[i]]; };
    const auto marks = [&](std::size_t first, std::size_t last) {
      std::vector<Vec3f> result;
      for (std::size_t i = first; i <= last; ++i) result.push_back(mark(i));
      return result;
    };
    const auto middle = [&](std::size_t a, std::size_t b, float share) {
      Vec3f result;
      for (std::size_t k = 0; k < 3; ++k) result[k] = mark(a)[k] + share * (mark(b)[k] - mark(a)[k]);
      return result;
    };
    const auto both = [](Pattern a, Pattern b) {
      return [a = std::move(a), b = std::move(b)](const Vec3f& p) { return std::max(a(p), b(p)); };
    };
    patterns.push_back({"lips", near_points(marks(60, 67), 5), feature_sigma});
    patterns.push_back({"brows", both(near_points(marks(17, 21), 5), near_points(marks(22, 26), 5)), feature_sigma});
    std::vector<Vec3f> beard = marks(4, 12);
    for (const std::size_t i : {48u, 50u, 52u, 54u, 56u, 58u, 8u}) beard.push_back(mark(i));
    patterns.push_back({"beard", near_points(beard, 16), feature_sigma});
    patterns.push_back({"cheeks",
                        both(near_points({middle(31, 2, 0.45f)}, 20), near_points({middle(35, 14, 0.45f)}, 20)),
                        feature_sigma});
    patterns.push_back(
        {"eye_sockets", both(near_points(marks(36, 41), 9), near_points(marks(42, 47), 9)), feature_sigma});
    low = {mark(0)[0], mark(8)[1], 0};
    high = {mark(16)[0], mark(8)[1] + 1.45f * (mark(27)[1] - mark(8)[1]), 0};
  }
  for (int row = 0; row < wave_rows; ++row)
    for (int column = 0; column < wave_columns; ++column)
      if (row + column > 0)
        patterns.push_back({"wave_" + std::to_string(column) + "_" + std::to_string(row),
                            [=](const Vec3f& p) {
                              const float x = std::clamp((p[0] - low[0]) / (high[0] - low[0]), 0.0f, 1.0f);
                              const float y = std::clamp((p[1] - low[1]) / (high[1] - low[1]), 0.0f, 1.0f);
                              constexpr auto pi = std::numbers::pi_v<float>;
                              return std::cos(pi * x * static_cast<float>(column)) *
                                     std::cos(pi * y * static_cast<float>(row));
                            },
                            wave_sigma});
  const std::vector<bool> skin = skin_vertices(mesh);
  LinearSpace space;
  for (const Named& named : patterns) {
    std::vector<float> strength(points.size(), 0.0f);
    for (std::size_t v = 0; v < points.size(); ++v)
      if (skin[v]) strength[v] = named.pattern(points[v]) * named.sigma;
    for (const Colour& colour : colours) {
      if (space.size() == count) return space;
      space.names.push_back(named.name + "_" + colour.name);
      space.sigmas.push_back(1);
      for (std::size_t v = 0; v < points.size(); ++v)
        space.modes.push_back({albedo[v][0] * strength[v] * colour.share[0],
                               albedo[v][1] * strength[v] * colour.share[1],
                               albedo[v][2] * strength[v] * colour.share[2]});
    }
  }
  return space;
}

SkinSpace learn_skins(const Rig& rig, std::size_t skins, std::size_t count, std::int64_t seed) {
  SkinSpace space;
  const std::vector<bool> skin = skin_vertices(rig.neutral);
  const phantom::FacePlaces places(rig);
  const std::size_t vertices = rig.neutral.points_mm.size();
  const auto n = static_cast<Eigen::Index>(skins);
  Eigen::MatrixXf rows(n, static_cast<Eigen::Index>(3 * vertices));
  for (std::size_t i = 0; i < skins; ++i) {
    Mesh person = rig.neutral;
    phantom::color_person(rig.neutral, places, {seed + static_cast<std::int64_t>(i), 0.25}, person);
    const std::vector<Vec3f> albedo = vertex_albedo(person);
    rows.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::RowVectorXf>(albedo.data()->data(), static_cast<Eigen::Index>(3 * vertices));
  }
  const Eigen::RowVectorXf mean = rows.colwise().mean();
  rows.rowwise() -= mean;
  for (std::size_t v = 0; v < vertices; ++v)
    if (!skin[v]) rows.middleCols(static_cast<Eigen::Index>(3 * v), 3).setZero();
  space.mean.resize(vertices);
  Eigen::Map<Eigen::RowVectorXf>(space.mean.data()->data(), mean.size()) = mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen((rows * rows.transpose()).cast<double>());
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(n - 1, static_cast<Eigen::Index>(count)); ++k) {
    const Eigen::Index column = n - 1 - k;
    if (eigen.eigenvalues()[column] <= 1e-7 * eigen.eigenvalues()[n - 1]) break;
    Eigen::VectorXf weights = eigen.eigenvectors().col(column).cast<float>() / std::sqrt(static_cast<float>(n));
    Eigen::Index largest = 0;
    weights.cwiseAbs().maxCoeff(&largest);
    if (weights[largest] < 0) weights = -weights;
    const Eigen::RowVectorXf mode = weights.transpose() * rows;
    const std::size_t first = space.modes.modes.size();
    space.modes.modes.resize(first + vertices);
    Eigen::Map<Eigen::RowVectorXf>(space.modes.modes[first].data(), mode.size()) = mode;
    space.modes.names.push_back("skin_" + std::to_string(k));
    space.modes.sigmas.push_back(1);
  }
  return space;
}

}  // namespace face::model
