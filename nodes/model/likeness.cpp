// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/likeness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "nodes/base/quantile.h"
#include "nodes/model/light_model.h"
#include "nodes/render/camera.h"
#include "nodes/render/rasterize.h"
#include "nodes/render/triangulate.h"

namespace face::model {
namespace {

constexpr double finest = 3.0 / 55, coarsest = 9.0 / 55;  // of what is compared, over the distance of the eyes
constexpr float ambient = 0.5f, parallel = 0.7f;          // of the plain face's light
constexpr Vec3f light = {0.0f, 0.5f, 0.866f};             // in the head's frame
constexpr float dark_share = 0.35f;                       // of eyes over skin
constexpr double black = 0.05;         // what is darker counts as this dark: logarithms of it would be noise
constexpr double usual_contrasts = 2;  // from which a contrast is cut off, over the median one
constexpr int least_pixels = 100;

struct Plain {
  cv::Mat value;   // of the plain face, 0 to 1; 32F
  cv::Mat inside;  // of its outline, eyes among it
  cv::Mat region;  // of it, what is compared
};

// What every vertex looks like, 0 to 1; between them as light and albedo are, all but linear.
std::vector<float> shades(const LikenessFace& face, const std::vector<Vec3f>& normals) {
  std::vector<float> shade(normals.size());
  if (face.colours == nullptr) {
    for (std::size_t v = 0; v < normals.size(); ++v) {
      const Vec3f &n = normals[v], &albedo = face.model.mean_albedo[face.basis.vertices[v]];
      const float cosine = n[0] * light[0] + n[1] * light[1] + n[2] * light[2];
      shade[v] = static_cast<float>(luma[0] * albedo[0] + luma[1] * albedo[1] + luma[2] * albedo[2]) *
                 (ambient + parallel * std::max(0.0f, cosine));
    }
    return shade;
  }
  const PictureState& state = face.state;
  Vec3f towards{};  // the light, in the head's frame
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t row = 0; row < 3; ++row)
      towards[k] += static_cast<float>(state.pose.rotation[3 * row + k]) * state.light.direction[row];
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const Vec3f& n = normals[v];
    const double cosine = (state.seen.empty() ? 1.0 : static_cast<double>(state.seen[v])) *
                          static_cast<double>(n[0] * towards[0] + n[1] * towards[1] + n[2] * towards[2]);
    std::array<double, 3> lit{};
    for (std::size_t c = 0; c < 3; ++c)
      lit[c] = light_at(state.light, c, cosine) * std::max(1e-4, static_cast<double>((*face.colours)[v][c]));
    const std::array<double, 3> value = shown(state.light, lit);
    shade[v] = static_cast<float>(luma[0] * value[0] + luma[1] * value[1] + luma[2] * value[2]);
  }
  return shade;
}

// Of the holes in the skin those below the nose: between the lips are teeth, tongue or hollow, bright or dark.
cv::Mat mouth_of(const LikenessFace& face, const PictureLevel& level, const cv::Mat& holes) {
  cv::Mat mouth(holes.size(), CV_8U, cv::Scalar(0));
  const std::vector<std::uint32_t>& marks = face.model.landmarks68;
  if (marks.size() != 68) return mouth;
  const std::vector<Vec3f>& mean = face.model.mean.points_mm;
  const std::vector<render::ScreenPoint> nose = render::project(
      camera_of(scaled(face.state.pose, level.factor)), {mean[marks[27]], mean[marks[33]]});  // its root and its base
  const cv::Point2f root(nose[0].x_px, nose[0].y_px), base(nose[1].x_px, nose[1].y_px);
  for (int y = 0; y < holes.rows; ++y)
    for (int x = 0; x < holes.cols; ++x) {
      const cv::Point2f place(static_cast<float>(x), static_cast<float>(y));
      if ((place - base).dot(root - base) < 0) mouth.at<std::uint8_t>(y, x) = holes.at<std::uint8_t>(y, x);
    }
  return mouth;
}

Plain draw(const LikenessFace& face, const PictureLevel& level) {
  const SkinBasis& basis = face.basis;
  const std::vector<Vec3f> points = posed_skin(basis, face.identity, face.state.expression);
  const std::vector<render::ScreenPoint> screen =
      render::project(camera_of(scaled(face.state.pose, level.factor)), points);
  render::RasterOptions options;
  options.width_px = level.width;
  options.height_px = level.height;
  const render::Raster raster = render::rasterize(screen, basis.triangles, options);
  const std::vector<float> shade = shades(face, render::vertex_normals(points, basis.triangles));
  const std::vector<std::uint32_t>& marks = face.model.landmarks68;
  const auto height = [&](std::size_t mark) { return face.model.mean.points_mm[marks[mark]][1]; };
  const float top = marks.size() == 68 ? std::min(height(19), height(24)) : 1e9f;
  Plain plain;
  const cv::Size size(level.width, level.height);
  plain.value = cv::Mat(size, CV_32F, cv::Scalar(0));
  plain.inside = cv::Mat(size, CV_8U, cv::Scalar(0));
  plain.region = cv::Mat(size, CV_8U, cv::Scalar(0));
  cv::Mat skin(size, CV_8U, cv::Scalar(0));
  std::vector<float> values;
  for (int y = 0; y < level.height; ++y)
    for (int x = 0; x < level.width; ++x) {
      const std::int32_t found = raster.triangles[raster.index(x, y)];
      if (found < 0) continue;
      const auto& triangle = basis.triangles[static_cast<std::size_t>(found)];
      const Vec3f b = render::barycentrics_at(screen, triangle, static_cast<float>(x), static_cast<float>(y));
      float value = 0, up = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        value += b[i] * shade[triangle[i]];
        up += b[i] * face.model.mean.points_mm[basis.vertices[triangle[i]]][1];
      }
      skin.at<std::uint8_t>(y, x) = 255;
      plain.value.at<float>(y, x) = value;
      if (up <= top) plain.region.at<std::uint8_t>(y, x) = 255;
      values.push_back(value);
    }
  if (values.empty()) return plain;
  if (face.skin_alone) {
    plain.inside = skin;
    return plain;
  }
  // Eyes and mouth are the holes in the skin.
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(skin, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::drawContours(plain.inside, outlines, -1, cv::Scalar(255), cv::FILLED);
  cv::Mat holes = plain.inside & ~skin;
  const cv::Mat mouth = mouth_of(face, level, holes);
  plain.inside &= ~mouth;
  holes &= ~mouth;
  plain.value.setTo(dark_share * median(values), holes);
  plain.region |= holes;
  return plain;
}

// Logarithm without what is finer or coarser than the parts of a face; weights: of pixels, 0 or 1. Nothing outside
// counts.
cv::Mat band(const cv::Mat& values, const cv::Mat& weights, double eyes_px) {
  cv::Mat logs = values + black;
  logs = cv::max(logs, black);
  cv::log(logs, logs);
  logs = logs.mul(weights);
  const auto smooth = [&](double sigma) {
    cv::Mat sum, count;
    cv::GaussianBlur(logs, sum, {0, 0}, sigma, sigma, cv::BORDER_CONSTANT);
    cv::GaussianBlur(weights, count, {0, 0}, sigma, sigma, cv::BORDER_CONSTANT);
    cv::Mat mean;
    cv::divide(sum, cv::max(count, 1e-3), mean);
    return mean;
  };
  return smooth(finest * eyes_px) - smooth(coarsest * eyes_px);
}

}  // namespace

double likeness(const LikenessFace& face, const PictureLevel& level) {
  const Plain plain = draw(face, level);
  if (cv::countNonZero(plain.region) < least_pixels) return 0;
  cv::Mat picture(plain.value.size(), CV_32F), weights;
  for (std::size_t i = 0; i < level.colours.size(); ++i)
    reinterpret_cast<float*>(picture.data)[i] = static_cast<float>(
        luma[0] * level.colours[i][0] + luma[1] * level.colours[i][1] + luma[2] * level.colours[i][2]);
  plain.inside.convertTo(weights, CV_32F, 1.0 / 255.0);
  const double eyes_px = face.eyes_px * level.factor;
  const cv::Mat seen = band(picture, weights, eyes_px), expected = band(plain.value, weights, eyes_px);
  std::vector<float> a, b, sizes;
  for (int y = 0; y < level.height; ++y)
    for (int x = 0; x < level.width; ++x) {
      if (plain.region.at<std::uint8_t>(y, x) == 0) continue;
      a.push_back(seen.at<float>(y, x));
      b.push_back(expected.at<float>(y, x));
      sizes.push_back(std::abs(a.back()));
    }
  const double usual = usual_contrasts * static_cast<double>(median(sizes));
  if (usual < 1e-6) return 0;
  double mean_a = 0, mean_b = 0, both = 0, squares_a = 0, squares_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = static_cast<float>(std::tanh(static_cast<double>(a[i]) / usual));
    mean_a += static_cast<double>(a[i]) / static_cast<double>(a.size());
    mean_b += static_cast<double>(b[i]) / static_cast<double>(a.size());
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double da = static_cast<double>(a[i]) - mean_a, db = static_cast<double>(b[i]) - mean_b;
    both += da * db;
    squares_a += da * da;
    squares_b += db * db;
  }
  return squares_a > 0 && squares_b > 0 ? both / std::sqrt(squares_a * squares_b) : 0;
}

}  // namespace face::model
