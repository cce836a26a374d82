// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/pixel_rows.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "nodes/base/eigen_vector.h"
#include "nodes/model/light_model.h"
#include "nodes/phantom/cast_shadow.h"
#include "nodes/render/camera.h"
#include "nodes/render/triangulate.h"

namespace face::model {
namespace {

using Vec3 = Eigen::Vector3d;
using Rows3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr float shadow_edge_mm = 4;
constexpr double least_facing = 0.12;  // cosine of normal and line of sight below which a point is not compared
constexpr double least_reflectance = 1e-4;
constexpr double end_of_scale = 0.985, all_but_black = 0.03;

// Two unit vectors that make a right-handed frame with d.
std::array<Vec3, 2> tangents(const Vec3& d) {
  const Vec3 helper = std::abs(d.y()) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
  const Vec3 first = helper.cross(d).normalized();
  return {first, d.cross(first)};
}

// The modes of scattered vertices are waited for longer than they are worked on: they are asked for this many points
// ahead.
constexpr std::size_t fetched_ahead = 2, cache_line = 64;
void fetch(const float* from, std::size_t bytes) {
  const char* const start = reinterpret_cast<const char*>(from);
  for (std::size_t i = 0; i < bytes; i += cache_line) __builtin_prefetch(start + i);
}

// Adds to the three targets what one component of displacement or albedo weighs in each, column by column.
void add_mode(const float* __restrict mode, std::size_t count, const Vec3f& weights, float* const targets[3]) {
  float* __restrict a = targets[0], * __restrict b = targets[1], * __restrict c = targets[2];
  for (std::size_t k = 0; k < count; ++k) {
    const float m = mode[k];
    a[k] += weights[0] * m;
    b[k] += weights[1] * m;
    c[k] += weights[2] * m;
  }
}

}  // namespace

FaceLight moved(const FaceLight& light, const double* step) {
  FaceLight result = light;
  for (std::size_t c = 0; c < 3; ++c) {
    result.ambient[c] = std::max(0.0f, light.ambient[c] + static_cast<float>(step[c]));
    result.parallel[c] = std::max(0.0f, light.parallel[c] + static_cast<float>(step[3 + c]));
    result.gain[c] = std::max(0.05f, light.gain[c] + static_cast<float>(step[9 + c]));
    result.offset[c] = light.offset[c] + static_cast<float>(step[12 + c]);
  }
  for (std::size_t k = 0; k < light.mirror.size(); ++k)
    result.mirror[k] = std::max(0.0f, light.mirror[k] + static_cast<float>(step[first_mirror + k]));
  result.contrast = std::max(0.05f, light.contrast + static_cast<float>(step[8]));
  const Vec3 d = vector_of(light.direction);
  const auto [first, second] = tangents(d);
  const Vec3 turned = (d + step[6] * first + step[7] * second).normalized();
  for (int k = 0; k < 3; ++k) result.direction[static_cast<std::size_t>(k)] = static_cast<float>(turned[k]);
  return result;
}

std::vector<float> shadow_of(const SkinBasis& basis, const std::vector<double>& identity, const PictureState& state) {
  const std::vector<Vec3f> points = posed_skin(basis, identity, state.expression);
  const Vec3 light = Eigen::Map<const Rows3>(state.pose.rotation.data()).transpose() * vector_of(state.light.direction);
  return phantom::cast_shadow(points, render::vertex_normals(points, basis.triangles), basis.triangles, float_of(light),
                              shadow_edge_mm);
}

PixelRows pixel_rows(const SkinBasis& basis, const std::vector<double>& identity, const std::vector<Vec3f>& albedo,
                     const PictureState& state, const PictureLevel& level, const PixelColumns& columns,
                     std::size_t points, Random& random) {
  const std::vector<Vec3f> posed_mm = posed_skin(basis, identity, state.expression);
  std::size_t visible = 0;
  const std::vector<SkinPoint> chosen = choose_points(basis, posed_mm, state.pose, level, points, random, visible);
  PixelRows rows = rows_at(chosen, basis, posed_mm, albedo, state, level, columns);
  rows.visible = visible;
  return rows;
}

namespace {

// What is the same for all points of a picture; in the model's frame where the camera's is not named.
struct LitView {
  LitView(const PictureState& picture, const PictureLevel& level)
      : state(picture),
        pose(scaled(picture.pose, level.factor)),
        rotation(Eigen::Map<const Rows3>(pose.rotation.data())),
        light_in_camera(vector_of(picture.light.direction)),
        light(rotation.transpose() * light_in_camera),
        light_turns(tangents(light_in_camera)),
        eye(vector_of(camera_of(pose).position_mm)) {
    const Vec3 forward = rotation.row(2);
    eye_by_focal = -forward.dot(Vec3(pose.centre_mm[0], pose.centre_mm[1], pose.centre_mm[2]) - eye) * forward;
  }

  const PictureState& state;
  FacePose pose;  // in pixels of the level
  Rows3 rotation;
  Vec3 light_in_camera, light;
  std::array<Vec3, 2> light_turns;  // in the camera's frame
  Vec3 eye;
  Vec3 eye_by_focal;  // by the logarithm of the focal length: away, so that the head stays as large
};

// A point of skin as it is posed, mm.
struct PosedPoint {
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero(), reflectance = Vec3::Zero(), to_eye = Vec3::Zero();
  double share = 1;  // of the parallel light that falls on it
};

PosedPoint posed_point(const SkinPoint& chosen, const std::array<std::uint32_t, 3>& triangle,
                       const std::vector<Vec3f>& posed, const std::vector<Vec3f>& normals,
                       const std::vector<Vec3f>& albedo, const LitView& view) {
  PosedPoint at;
  const Vec3f& bary = chosen.weights;
  for (std::size_t i = 0; i < 3; ++i) {
    at.point += bary[i] * vector_of(posed[triangle[i]]);
    at.normal += bary[i] * vector_of(normals[triangle[i]]);
    at.reflectance += bary[i] * vector_of(albedo[triangle[i]]);
  }
  if (chosen.albedo) at.reflectance = vector_of(*chosen.albedo);
  at.reflectance = at.reflectance.cwiseMax(least_reflectance);
  at.normal.normalize();
  at.to_eye = (view.eye - at.point).normalized();
  if (!view.state.seen.empty()) {
    at.share = 0;
    for (std::size_t i = 0; i < 3; ++i) at.share += static_cast<double>(bary[i]) * view.state.seen[triangle[i]];
  }
  return at;
}

// The parallel light as a point mirrors it, before its colour.
struct Mirrored {
  double value = 0, slope = 0;  // by the cosine of normal and halfway
  Lobes lobes;                  // what each adds for a weight of 1
  Vec3 halfway = Vec3::Zero();  // between the light and the eye
  double half_length = 0;       // of the sum of the two directions
};

Mirrored mirrored_at(const PosedPoint& at, const LitView& view, bool mirrors) {
  Mirrored mirrored;
  mirrored.half_length = std::max(1e-9, (view.light + at.to_eye).norm());
  if (!mirrors || !(at.normal.dot(view.light) > 0)) return mirrored;
  mirrored.halfway = (view.light + at.to_eye) / mirrored.half_length;
  mirrored.lobes = lobes_at(at.normal.dot(mirrored.halfway));
  for (std::size_t k = 0; k < mirrored.lobes.value.size(); ++k) {
    const auto weight = static_cast<double>(view.state.light.mirror[k]);
    mirrored.lobes.value[k] *= at.share;
    mirrored.value += weight * mirrored.lobes.value[k];
    mirrored.slope += weight * at.share * mirrored.lobes.slope[k];
  }
  return mirrored;
}

// The colour of a point in the picture, value_c = gain_c mix(srgb(L albedo))_c + offset_c, and its derivatives.
struct Shade {
  std::array<double, 3> value{}, encoded{}, strength{};  // of the picture; before mixing; of the light
  double grey = 0;                                       // luma of encoded
  Rows3 by_lit = Rows3::Zero();                          // by the lit albedo; row: channel
  Vec3 by_cosine = Vec3::Zero();                         // of normal and light
  Vec3 by_mirrored = Vec3::Zero();                       // by the mirrored share of the light
  Vec3 by_halfway = Vec3::Zero();                        // by the cosine of normal and halfway
};

Shade shade_at(const PosedPoint& at, const Mirrored& mirrored, const LitView& view) {
  const FaceLight& light = view.state.light;
  const double cosine = at.normal.dot(view.light);
  Shade shade;
  std::array<double, 3> slope;
  for (std::size_t c = 0; c < 3; ++c) {
    shade.strength[c] = light_at(light, c, at.share * cosine);
    const double lit = shade.strength[c] * at.reflectance[static_cast<Eigen::Index>(c)] +
                       mirrored.value * static_cast<double>(light.parallel[c]);
    shade.encoded[c] = srgb_of(lit);
    slope[c] = srgb_slope(lit, shade.encoded[c]);
    shade.grey += luma[c] * shade.encoded[c];
  }
  shade.value = mixed(light, shade.encoded);
  for (Eigen::Index c = 0; c < 3; ++c)
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto ci = static_cast<std::size_t>(c), ki = static_cast<std::size_t>(k);
      shade.by_lit(c, k) =
          light.gain[ci] * ((c == k ? light.contrast : 0.0f) + (1.0 - light.contrast) * luma[ki]) * slope[ki];
    }
  for (Eigen::Index k = 0; k < 3; ++k) {
    const float parallel = light.parallel[static_cast<std::size_t>(k)];
    if (cosine > 0) shade.by_cosine += shade.by_lit.col(k) * (at.share * at.reflectance[k] * parallel);
    shade.by_mirrored += shade.by_lit.col(k) * static_cast<double>(parallel);
  }
  shade.by_halfway = mirrored.slope * shade.by_mirrored;
  return shade;
}

// How the cosines of the normal with the light and (half) with halfway change.
struct CosineSlopes {
  Vec3 normal_in_camera;
  Vec3 by_turn, half_by_turn;                 // of the head, about the camera's axes
  Vec3 half_by_light;                         // by the light's direction, in the camera's frame
  Vec3 half_by_eye;                           // by the eye's place
  std::array<Vec3, 2> by_edge, half_by_edge;  // by what moves the far end of an edge of the triangle
};

CosineSlopes cosine_slopes(const PosedPoint& at, const Mirrored& mirrored, const std::array<std::uint32_t, 3>& triangle,
                           const std::vector<Vec3f>& posed, const LitView& view) {
  CosineSlopes slopes;
  slopes.normal_in_camera = view.rotation * at.normal;
  const Vec3 halfway_in_camera = view.rotation * mirrored.halfway;
  slopes.by_turn = slopes.normal_in_camera.cross(view.light_in_camera);
  slopes.half_by_turn = slopes.normal_in_camera.cross(halfway_in_camera);
  slopes.half_by_light =
      (slopes.normal_in_camera - at.normal.dot(mirrored.halfway) * halfway_in_camera) / mirrored.half_length;
  const Vec3 by_view = view.rotation.transpose() * slopes.half_by_light;
  slopes.half_by_eye = (by_view - by_view.dot(at.to_eye) * at.to_eye) / (view.eye - at.point).norm();

  const Vec3 edge1 = vector_of(posed[triangle[1]]) - vector_of(posed[triangle[0]]);
  const Vec3 edge2 = vector_of(posed[triangle[2]]) - vector_of(posed[triangle[0]]);
  const double g11 = edge1.dot(edge1), g12 = edge1.dot(edge2), g22 = edge2.dot(edge2);
  const double det = g11 * g22 - g12 * g12;
  std::array<Vec3, 2> dual = {Vec3::Zero(), Vec3::Zero()};  // basis in the triangle's plane
  if (det > 1e-9 * g11 * g22) dual = {(g22 * edge1 - g12 * edge2) / det, (g11 * edge2 - g12 * edge1) / det};
  for (std::size_t i = 0; i < 2; ++i) {
    slopes.by_edge[i] = -view.light.dot(dual[i]) * at.normal;
    slopes.half_by_edge[i] = -mirrored.halfway.dot(dual[i]) * at.normal;
  }
  return slopes;
}

// One channel of a residual at a point.
struct PixelSlopes {
  const PoseView& seen;  // where it is seen, and how that moves
  double gx, gy;         // of the picture there, per pixel of the level
};

// Derivatives by the pose's parameters.
void pose_columns(float* row, std::size_t channel, const PixelSlopes& pixel, const Shade& shade,
                  const CosineSlopes& slopes, const LitView& view, double factor) {
  const auto c = static_cast<Eigen::Index>(channel);
  for (std::size_t k = 0; k < FacePose::size; ++k)
    row[k] = static_cast<float>(pixel.gx * pixel.seen.by_pose[0][k] + pixel.gy * pixel.seen.by_pose[1][k]);
  for (std::size_t k = 3; k < 5; ++k) row[k] *= static_cast<float>(factor);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    row[k] -=
        static_cast<float>(shade.by_cosine[c] * slopes.by_turn[axis] + shade.by_halfway[c] * slopes.half_by_turn[axis]);
  }
  row[6] -= static_cast<float>(shade.by_halfway[c] * slopes.half_by_eye.dot(view.eye_by_focal));
}

// Derivatives by the light's parameters, in the order of moved(FaceLight).
void light_columns(float* row, std::size_t channel, const PosedPoint& at, const Mirrored& mirrored, const Shade& shade,
                   const CosineSlopes& slopes, const LitView& view) {
  const auto c = static_cast<Eigen::Index>(channel);
  const FaceLight& light = view.state.light;
  const double cosine = at.normal.dot(view.light);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto ki = static_cast<Eigen::Index>(k);
    row[k] = static_cast<float>(-shade.by_lit(c, ki) * at.reflectance[ki]);
    row[3 + k] = static_cast<float>(-shade.by_lit(c, ki) *
                                    (at.reflectance[ki] * std::max(0.0, at.share * cosine) + mirrored.value));
  }
  for (std::size_t k = 0; k < 2; ++k)
    row[6 + k] = static_cast<float>(-shade.by_cosine[c] * slopes.normal_in_camera.dot(view.light_turns[k]) -
                                    shade.by_halfway[c] * slopes.half_by_light.dot(view.light_turns[k]));
  row[8] = static_cast<float>(-light.gain[channel] * (shade.encoded[channel] - shade.grey));
  row[9 + channel] =
      static_cast<float>(-(light.contrast * shade.encoded[channel] + (1.0 - light.contrast) * shade.grey));
  row[12 + channel] = -1;
  for (std::size_t k = 0; k < mirrored.lobes.value.size(); ++k)
    row[first_mirror + k] = static_cast<float>(-shade.by_mirrored[c] * mirrored.lobes.value[k]);
}

using CornerWeights = std::array<float, 9>;  // x y z, or R G B, of the triangle's three corners

// Derivatives by the places of the corners.
CornerWeights place_weights(std::size_t channel, const Vec3f& bary, const PixelSlopes& pixel, const Shade& shade,
                            const CosineSlopes& slopes) {
  const auto c = static_cast<Eigen::Index>(channel);
  CornerWeights weights;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    const double moving = pixel.gx * pixel.seen.by_point[0][axis] + pixel.gy * pixel.seen.by_point[1][axis];
    const double turn1 = shade.by_cosine[c] * slopes.by_edge[0][a] + shade.by_halfway[c] * slopes.half_by_edge[0][a],
                 turn2 = shade.by_cosine[c] * slopes.by_edge[1][a] + shade.by_halfway[c] * slopes.half_by_edge[1][a];
    weights[axis] = static_cast<float>(bary[0] * moving + turn1 + turn2);
    weights[3 + axis] = static_cast<float>(bary[1] * moving - turn1);
    weights[6 + axis] = static_cast<float>(bary[2] * moving - turn2);
  }
  return weights;
}

// Derivatives by the albedo of the corners.
CornerWeights albedo_weights(std::size_t channel, const Vec3f& bary, const Shade& shade) {
  CornerWeights weights;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i)
      weights[3 * i + k] =
          static_cast<float>(-shade.by_lit(static_cast<Eigen::Index>(channel), static_cast<Eigen::Index>(k)) *
                             shade.strength[k] * bary[i]);
  return weights;
}

// Some modes of a basis: of the width columns of its rows, count from first on.
struct ModeRange {
  const std::vector<float>& modes;
  std::size_t width, first, count;
};

// Adds to the three rows of a point, columns floats apart, what the modes do to its corners.
void add_modes(float* target, std::size_t columns, const ModeRange& range, const std::array<std::uint32_t, 3>& triangle,
               const std::array<CornerWeights, 3>& weights) {
  if (range.count == 0) return;
  float* const targets[3] = {target, target + columns, target + 2 * columns};
  for (std::size_t i = 0; i < 9; ++i)
    add_mode(range.modes.data() + (3 * triangle[i / 3] + i % 3) * range.width + range.first, range.count,
             {weights[0][i], weights[1][i], weights[2][i]}, targets);
}

// How many points are at the ends of the scale.
struct Exposure {
  std::size_t overexposed = 0, dark = 0;
  double brightness = 0;  // summed

  void add(const std::array<float, 9>& picture) {
    const float brightest = std::max({picture[0], picture[1], picture[2]});
    if (brightest > end_of_scale) ++overexposed;
    if (brightest < all_but_black) ++dark;
    brightness += static_cast<double>(brightest);
  }
};

}  // namespace

PixelRows rows_at(const std::vector<SkinPoint>& points, const SkinBasis& basis, const std::vector<Vec3f>& posed,
                  const std::vector<Vec3f>& albedo, const PictureState& state, const PictureLevel& level,
                  const PixelColumns& columns) {
  const std::vector<Vec3f> normals = render::vertex_normals(posed, basis.triangles);
  const LitView view(state, level);
  const bool is_mirrored = columns.light || state.light.mirror != Vec2f{0, 0};
  const bool is_shaded = columns.shading || state.shading != std::array<double, shading_parameters>{};
  PixelRows rows;
  rows.columns = columns.size();
  rows.jacobian.reserve(3 * points.size() * rows.columns);
  rows.residual.reserve(3 * points.size());
  const std::size_t shapes = basis.shapes();
  const std::size_t shape_bytes = rows.columns > FacePose::size ? 3 * shapes * sizeof(float) : 0;
  Exposure exposure;
  std::array<CornerWeights, 3> by_place, by_albedo;  // of a channel
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (n + fetched_ahead < points.size())
      for (const std::uint32_t v : basis.triangles[points[n + fetched_ahead].triangle])
        fetch(basis.shape_modes.data() + 3 * v * shapes, shape_bytes);
    const auto& triangle = basis.triangles[points[n].triangle];
    const PosedPoint at = posed_point(points[n], triangle, posed, normals, albedo, view);
    if (at.normal.dot(at.to_eye) < least_facing) continue;
    const PoseView seen = model::view(view.pose, float_of(at.point));
    const std::array<float, 9> picture = sample_at(level, seen.x_px, seen.y_px);
    exposure.add(picture);
    const Mirrored mirrored = mirrored_at(at, view, is_mirrored && points[n].mirrors);
    const Shade shade = shade_at(at, mirrored, view);
    const CosineSlopes slopes = cosine_slopes(at, mirrored, triangle, posed, view);
    const Eigen::Vector3d& facing = slopes.normal_in_camera;
    std::array<double, shading_parameters> shading{};
    if (is_shaded) shading = normal_harmonics(facing.x(), facing.y(), facing.z());
    double brighter = 0;
    for (std::size_t k = 0; k < shading_parameters; ++k) brighter += state.shading[k] * shading[k];

    const std::size_t first_row = rows.jacobian.size();
    rows.jacobian.resize(first_row + 3 * rows.columns, 0.0f);
    float* const out = rows.jacobian.data() + first_row;
    for (std::size_t c = 0; c < 3; ++c) {
      rows.residual.push_back(picture[c] - static_cast<float>(shade.value[c] + brighter));
      float* const row = out + c * rows.columns;
      const PixelSlopes pixel{seen, picture[3 + c], picture[6 + c]};
      pose_columns(row + columns.pose_first(), c, pixel, shade, slopes, view, level.factor);
      by_place[c] = place_weights(c, points[n].weights, pixel, shade, slopes);
      by_albedo[c] = albedo_weights(c, points[n].weights, shade);
      if (columns.light) light_columns(row + columns.light_first(), c, at, mirrored, shade, slopes, view);
      if (columns.shading)
        for (std::size_t k = 0; k < shading_parameters; ++k)
          row[columns.shading_first() + k] = -static_cast<float>(shading[k]);
    }
    add_modes(out, rows.columns, {basis.shape_modes, shapes, 0, columns.identities}, triangle, by_place);
    add_modes(out + columns.expression_first(), rows.columns,
              {basis.shape_modes, shapes, basis.identities, columns.expressions}, triangle, by_place);
    add_modes(out + columns.identities, rows.columns, {basis.albedo_modes, basis.albedos, 0, columns.albedos}, triangle,
              by_albedo);
  }
  const double used = std::max<double>(1.0, static_cast<double>(rows.residual.size()) / 3.0);
  rows.overexposed = static_cast<double>(exposure.overexposed) / used;
  rows.dark = static_cast<double>(exposure.dark) / used;
  rows.brightness = exposure.brightness / used;
  return rows;
}

}  // namespace face::model
