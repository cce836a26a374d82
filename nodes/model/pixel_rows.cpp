// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/pixel_rows.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "nodes/model/light_model.h"
#include "nodes/phantom/cast_shadow.h"
#include "nodes/render/camera.h"
#include "nodes/render/rasterize.h"
#include "nodes/render/rgb_image.h"
#include "nodes/render/triangulate.h"

namespace face::model {
namespace {

using Vec3 = Eigen::Vector3d;
using Rows3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double blur_px = 0.7;
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

Vec3 vec(const Vec3f& v) { return {v[0], v[1], v[2]}; }

}  // namespace

PictureLevel make_level(const Image& picture, double factor, double exposure) {
  const Image rgb = render::rgb_image(picture);
  cv::Mat source(rgb.height, rgb.width, CV_8UC3, const_cast<std::uint8_t*>(rgb.pixels.data())), small;
  PictureLevel level;
  level.width = std::max(8, static_cast<int>(std::lround(rgb.width * factor)));
  level.height = std::max(8, static_cast<int>(std::lround(rgb.height * factor)));
  level.factor = static_cast<double>(level.width) / rgb.width;
  source.convertTo(small, CV_32FC3, 1.0 / (255.0 * exposure));
  cv::resize(small, small, {level.width, level.height}, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(small, small, {0, 0}, blur_px);
  level.samples.resize(static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height));
  const auto at = [&](int x, int y) {
    return small.at<cv::Vec3f>(std::clamp(y, 0, level.height - 1), std::clamp(x, 0, level.width - 1));
  };
  for (int y = 0; y < level.height; ++y)
    for (int x = 0; x < level.width; ++x) {
      auto& s = level.samples[static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width) +
                              static_cast<std::size_t>(x)];
      const cv::Vec3f here = at(x, y), right = at(x + 1, y), left = at(x - 1, y), down = at(x, y + 1),
                      up = at(x, y - 1);
      for (int c = 0; c < 3; ++c) {
        s[static_cast<std::size_t>(c)] = here[c];
        s[static_cast<std::size_t>(3 + c)] = 0.5f * (right[c] - left[c]);
        s[static_cast<std::size_t>(6 + c)] = 0.5f * (down[c] - up[c]);
      }
    }
  return level;
}

std::array<float, 9> sample_at(const PictureLevel& level, double x_px, double y_px) {
  const double x = std::clamp(x_px, 0.0, level.width - 1.001), y = std::clamp(y_px, 0.0, level.height - 1.001);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const auto fx = static_cast<float>(x - x0), fy = static_cast<float>(y - y0);
  const std::array<float, 9>* row = level.samples.data() +
                                    static_cast<std::size_t>(y0) * static_cast<std::size_t>(level.width) +
                                    static_cast<std::size_t>(x0);
  const std::array<float, 9>* below = row + level.width;
  std::array<float, 9> result;
  for (std::size_t i = 0; i < 9; ++i)
    result[i] = (1 - fy) * ((1 - fx) * row[0][i] + fx * row[1][i]) + fy * ((1 - fx) * below[0][i] + fx * below[1][i]);
  return result;
}

std::array<double, shading_parameters> shading_at(const std::array<double, 3>& normal_in_camera) {
  const auto [x, y, z] = normal_in_camera;
  return {1, x, y, z, x * y, x * z, y * z, x * x - y * y, 3 * z * z - 1};
}

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
  const Vec3 d = vec(light.direction);
  const auto [first, second] = tangents(d);
  const Vec3 turned = (d + step[6] * first + step[7] * second).normalized();
  for (int k = 0; k < 3; ++k) result.direction[static_cast<std::size_t>(k)] = static_cast<float>(turned[k]);
  return result;
}

DrawnSkin draw_skin(const SkinBasis& basis, const std::vector<Vec3f>& posed_mm, const FacePose& pose,
                    const PictureLevel& level) {
  DrawnSkin drawn;
  drawn.screen = render::project(camera_of(scaled(pose, level.factor)), posed_mm);
  render::RasterOptions options;
  options.width_px = level.width;
  options.height_px = level.height;
  drawn.raster = render::rasterize(drawn.screen, basis.triangles, options);
  return drawn;
}

std::vector<SkinPoint> choose_points(const SkinBasis& basis, const std::vector<Vec3f>& posed_mm, const FacePose& pose,
                                     const PictureLevel& level, std::size_t points, Random& random,
                                     std::size_t& visible) {
  return choose_points(basis, draw_skin(basis, posed_mm, pose, level), points, random, visible);
}

std::vector<SkinPoint> choose_points(const SkinBasis& basis, const DrawnSkin& drawn, std::size_t points, Random& random,
                                     std::size_t& visible) {
  const render::Raster& raster = drawn.raster;
  std::vector<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < raster.triangles.size(); ++i)
    if (raster.triangles[i] >= 0) seen.push_back(i);
  visible = seen.size();
  std::vector<SkinPoint> chosen(std::min(points, seen.size()));
  for (std::size_t n = 0; n < chosen.size(); ++n) {
    // A partial shuffle (Durstenfeld, Algorithm 235: Random Permutation, 1964).
    const std::size_t pick = n + static_cast<std::size_t>(random.uniform() * static_cast<double>(seen.size() - n));
    std::swap(seen[n], seen[pick]);
    const auto width = static_cast<std::uint32_t>(raster.width_px);
    chosen[n].triangle = static_cast<std::uint32_t>(raster.triangles[seen[n]]);
    chosen[n].weights =
        render::barycentrics_at(drawn.screen, basis.triangles[chosen[n].triangle], static_cast<float>(seen[n] % width),
                                static_cast<float>(seen[n] / width));
  }
  // Neighbours after each other share what they read of modes and picture, which is most of the time they take.
  std::sort(chosen.begin(), chosen.end(),
            [](const SkinPoint& a, const SkinPoint& b) { return a.triangle < b.triangle; });
  return chosen;
}

std::vector<float> shadow_of(const SkinBasis& basis, const std::vector<double>& identity, const PictureState& state) {
  const std::vector<Vec3f> points = posed_skin(basis, identity, state.expression);
  const Vec3 light = Eigen::Map<const Rows3>(state.pose.rotation.data()).transpose() * vec(state.light.direction);
  return phantom::cast_shadow(
      points, render::vertex_normals(points, basis.triangles), basis.triangles,
      {static_cast<float>(light.x()), static_cast<float>(light.y()), static_cast<float>(light.z())}, shadow_edge_mm);
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

PixelRows rows_at(const std::vector<SkinPoint>& points, const SkinBasis& basis, const std::vector<Vec3f>& posed,
                  const std::vector<Vec3f>& albedo, const PictureState& state, const PictureLevel& level,
                  const PixelColumns& columns) {
  const std::vector<Vec3f> normals = render::vertex_normals(posed, basis.triangles);
  const FacePose pose = scaled(state.pose, level.factor);
  const Camera camera = camera_of(pose);
  PixelRows rows;
  rows.columns = columns.size();
  rows.jacobian.reserve(3 * points.size() * rows.columns);
  rows.residual.reserve(3 * points.size());

  const Eigen::Map<const Rows3> rotation(pose.rotation.data());
  const Vec3 light_in_camera = vec(state.light.direction);
  const Vec3 light = rotation.transpose() * light_in_camera;
  const auto light_turns = tangents(light_in_camera);
  const bool is_mirrored = columns.light || state.light.mirror != Vec2f{0, 0};
  const bool is_shaded = columns.shading || state.shading != std::array<double, shading_parameters>{};
  const Vec3 eye = vec(camera.position_mm);
  // How the eye moves with the logarithm of the focal length: away, so that the head stays as large.
  const Vec3 forward = rotation.row(2);
  const Vec3 eye_by_focal = -forward.dot(Vec3(pose.centre_mm[0], pose.centre_mm[1], pose.centre_mm[2]) - eye) * forward;
  const std::size_t shapes = basis.shapes();
  std::size_t overexposed = 0, dark = 0;
  double brightness = 0;
  std::array<std::array<float, 9>, 3> shape_weights{}, albedo_weights{};  // of a channel: of corners, x y z or R G B

  const std::size_t shape_bytes = rows.columns > FacePose::size ? 3 * shapes * sizeof(float) : 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const SkinPoint& skin_point = points[n];
    if (n + fetched_ahead < points.size())
      for (const std::uint32_t v : basis.triangles[points[n + fetched_ahead].triangle])
        fetch(basis.shape_modes.data() + 3 * v * shapes, shape_bytes);
    const auto& triangle = basis.triangles[skin_point.triangle];
    const Vec3f& bary = skin_point.weights;
    Vec3 point = Vec3::Zero(), normal = Vec3::Zero(), reflectance = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      point += bary[i] * vec(posed[triangle[i]]);
      normal += bary[i] * vec(normals[triangle[i]]);
      reflectance += bary[i] * vec(albedo[triangle[i]]);
    }
    if (skin_point.albedo) reflectance = vec(*skin_point.albedo);
    normal.normalize();
    const Vec3 to_eye = (eye - point).normalized();
    if (normal.dot(to_eye) < least_facing) continue;
    reflectance = reflectance.cwiseMax(least_reflectance);
    const PoseView at =
        view(pose, {static_cast<float>(point.x()), static_cast<float>(point.y()), static_cast<float>(point.z())});
    const std::array<float, 9> picture = sample_at(level, at.x_px, at.y_px);
    const float brightest = std::max({picture[0], picture[1], picture[2]});
    if (brightest > end_of_scale) ++overexposed;
    if (brightest < all_but_black) ++dark;
    brightness += static_cast<double>(brightest);

    // value_c = gain_c mix(srgb(L albedo))_c + offset_c; by_lit = its derivative by the lit albedo.
    double share = 1;  // of the parallel light
    if (!state.seen.empty()) {
      share = 0;
      for (std::size_t i = 0; i < 3; ++i) share += static_cast<double>(bary[i]) * state.seen[triangle[i]];
    }
    const double cosine = normal.dot(light);
    Vec3 halfway = Vec3::Zero();
    Lobes lobes;
    double mirrored = 0, mirrored_slope = 0;  // of the parallel light; by the cosine of normal and halfway
    const double half_length = std::max(1e-9, (light + to_eye).norm());
    if (is_mirrored && skin_point.mirrors && cosine > 0) {
      halfway = (light + to_eye) / half_length;
      lobes = lobes_at(normal.dot(halfway));
      for (std::size_t k = 0; k < lobes.value.size(); ++k) {
        lobes.value[k] *= share;
        mirrored += static_cast<double>(state.light.mirror[k]) * lobes.value[k];
        mirrored_slope += static_cast<double>(state.light.mirror[k]) * share * lobes.slope[k];
      }
    }
    std::array<double, 3> lit, e, slope, strength;
    double grey = 0;
    Rows3 by_lit;
    for (std::size_t c = 0; c < 3; ++c) {
      strength[c] = light_at(state.light, c, share * cosine);
      lit[c] = strength[c] * reflectance[static_cast<Eigen::Index>(c)] +
               mirrored * static_cast<double>(state.light.parallel[c]);
      e[c] = srgb_of(lit[c]);
      slope[c] = srgb_slope(lit[c], e[c]);
      grey += luma[c] * e[c];
    }
    const std::array<double, 3> value = mixed(state.light, e);
    for (Eigen::Index c = 0; c < 3; ++c)
      for (Eigen::Index k = 0; k < 3; ++k) {
        const auto ci = static_cast<std::size_t>(c), ki = static_cast<std::size_t>(k);
        by_lit(c, k) = state.light.gain[ci] *
                       ((c == k ? state.light.contrast : 0.0f) + (1.0 - state.light.contrast) * luma[ki]) * slope[ki];
      }
    Vec3 by_cosine = Vec3::Zero();
    if (cosine > 0)
      for (Eigen::Index k = 0; k < 3; ++k)
        by_cosine += by_lit.col(k) * (share * reflectance[k] * state.light.parallel[static_cast<std::size_t>(k)]);

    Vec3 by_mirrored = Vec3::Zero();
    for (Eigen::Index k = 0; k < 3; ++k)
      by_mirrored += by_lit.col(k) * static_cast<double>(state.light.parallel[static_cast<std::size_t>(k)]);
    const Vec3 by_halfway = mirrored_slope * by_mirrored;

    // Edges of the triangle and the dual basis in its plane.
    const Vec3 edge1 = vec(posed[triangle[1]]) - vec(posed[triangle[0]]);
    const Vec3 edge2 = vec(posed[triangle[2]]) - vec(posed[triangle[0]]);
    const double g11 = edge1.dot(edge1), g12 = edge1.dot(edge2), g22 = edge2.dot(edge2);
    const double det = g11 * g22 - g12 * g12;
    Vec3 dual1 = Vec3::Zero(), dual2 = Vec3::Zero();
    if (det > 1e-9 * g11 * g22) {
      dual1 = (g22 * edge1 - g12 * edge2) / det;
      dual2 = (g11 * edge2 - g12 * edge1) / det;
    }
    const Vec3 turn1 = -light.dot(dual1) * normal, turn2 = -light.dot(dual2) * normal;
    const Vec3 half_turn1 = -halfway.dot(dual1) * normal, half_turn2 = -halfway.dot(dual2) * normal;

    const std::size_t first_row = rows.jacobian.size();
    rows.jacobian.resize(first_row + 3 * rows.columns, 0.0f);
    float* const out = rows.jacobian.data() + first_row;
    const Vec3 normal_in_camera = rotation * normal;
    std::array<double, shading_parameters> shading{};
    if (is_shaded) shading = shading_at({normal_in_camera.x(), normal_in_camera.y(), normal_in_camera.z()});
    double brighter = 0;
    for (std::size_t k = 0; k < shading_parameters; ++k) brighter += state.shading[k] * shading[k];
    const Vec3 halfway_in_camera = rotation * halfway;
    const Vec3 half_swing = normal_in_camera.cross(halfway_in_camera);
    // Of the cosine of normal and halfway, by the light's direction and by the eye's place.
    const Vec3 by_light = (normal_in_camera - normal.dot(halfway) * halfway_in_camera) / half_length;
    const Vec3 by_view = rotation.transpose() * by_light;
    const Vec3 by_eye = (by_view - by_view.dot(to_eye) * to_eye) / (eye - point).norm();
    const Vec3 swing = normal_in_camera.cross(light_in_camera);  // d cosine by a turn of the head
    for (std::size_t c = 0; c < 3; ++c) {
      const auto ci = static_cast<Eigen::Index>(c);
      rows.residual.push_back(picture[c] - static_cast<float>(value[c] + brighter));
      const double gx = picture[3 + c], gy = picture[6 + c];
      float* const row = out + c * rows.columns;
      for (std::size_t k = 0; k < FacePose::size; ++k)
        row[columns.pose_first() + k] = static_cast<float>(gx * at.by_pose[0][k] + gy * at.by_pose[1][k]);
      for (std::size_t k = 3; k < 5; ++k) row[columns.pose_first() + k] *= static_cast<float>(level.factor);
      for (std::size_t k = 0; k < 3; ++k)
        row[columns.pose_first() + k] -= static_cast<float>(by_cosine[ci] * swing[static_cast<Eigen::Index>(k)] +
                                                            by_halfway[ci] * half_swing[static_cast<Eigen::Index>(k)]);
      row[columns.pose_first() + 6] -= static_cast<float>(by_halfway[ci] * by_eye.dot(eye_by_focal));
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const auto ai = static_cast<std::size_t>(axis);
        const double moving = gx * at.by_point[0][ai] + gy * at.by_point[1][ai];
        const double t1 = by_cosine[ci] * turn1[axis] + by_halfway[ci] * half_turn1[axis],
                     t2 = by_cosine[ci] * turn2[axis] + by_halfway[ci] * half_turn2[axis];
        shape_weights[c][ai] = static_cast<float>(bary[0] * moving + t1 + t2);
        shape_weights[c][3 + ai] = static_cast<float>(bary[1] * moving - t1);
        shape_weights[c][6 + ai] = static_cast<float>(bary[2] * moving - t2);
        for (std::size_t i = 0; i < 3; ++i)
          albedo_weights[c][3 * i + ai] = static_cast<float>(-by_lit(ci, axis) * strength[ai] * bary[i]);
      }
      if (columns.light) {
        float* const l = row + columns.light_first();
        for (std::size_t k = 0; k < 3; ++k) {
          const auto ki = static_cast<Eigen::Index>(k);
          l[k] = static_cast<float>(-by_lit(ci, ki) * reflectance[ki]);
          l[3 + k] = static_cast<float>(-by_lit(ci, ki) * (reflectance[ki] * std::max(0.0, share * cosine) + mirrored));
        }
        for (std::size_t k = 0; k < 2; ++k)
          l[6 + k] = static_cast<float>(-by_cosine[ci] * normal_in_camera.dot(light_turns[k]) -
                                        by_halfway[ci] * by_light.dot(light_turns[k]));
        l[8] = static_cast<float>(-state.light.gain[c] * (e[c] - grey));
        l[9 + c] = static_cast<float>(-(state.light.contrast * e[c] + (1.0 - state.light.contrast) * grey));
        l[12 + c] = -1;
        for (std::size_t k = 0; k < lobes.value.size(); ++k)
          l[first_mirror + k] = static_cast<float>(-by_mirrored[ci] * lobes.value[k]);
      }
      if (columns.shading)
        for (std::size_t k = 0; k < shading_parameters; ++k)
          row[columns.shading_first() + k] = -static_cast<float>(shading[k]);
    }
    const auto fill = [&](const std::vector<float>& from, std::size_t width, std::size_t first, std::size_t count,
                          std::size_t target, const std::array<std::array<float, 9>, 3>& weights) {
      if (count == 0) return;
      float* const targets[3] = {out + target, out + rows.columns + target, out + 2 * rows.columns + target};
      for (std::size_t i = 0; i < 9; ++i)
        add_mode(from.data() + (3 * triangle[i / 3] + i % 3) * width + first, count,
                 {weights[0][i], weights[1][i], weights[2][i]}, targets);
    };
    fill(basis.shape_modes, shapes, 0, columns.identities, 0, shape_weights);
    fill(basis.shape_modes, shapes, basis.identities, columns.expressions, columns.expression_first(), shape_weights);
    fill(basis.albedo_modes, basis.albedos, 0, columns.albedos, columns.identities, albedo_weights);
  }
  const double used = std::max<double>(1.0, static_cast<double>(rows.residual.size()) / 3.0);
  rows.overexposed = static_cast<double>(overexposed) / used;
  rows.dark = static_cast<double>(dark) / used;
  rows.brightness = brightness / used;
  return rows;
}

}  // namespace face::model
