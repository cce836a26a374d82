// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/image_points.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/mmm/check_picture.h"

namespace face::mmm {
namespace {

using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Means of grey over the cells of a grid.
void thumbnail(const Image& image, int width, int height, float* values) {
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const int x0 = i * image.width / width, x1 = (i + 1) * image.width / width;
      const int y0 = j * image.height / height, y1 = (j + 1) * image.height / height;
      int sum = 0;
      for (int y = y0; y < y1; ++y)
        for (int x = 3 * x0 + 3 * y * image.width; x < 3 * x1 + 3 * y * image.width; ++x)
          sum += image.pixels[static_cast<std::size_t>(x)];
      *values++ = static_cast<float>(sum) / static_cast<float>(3 * (x1 - x0) * (y1 - y0));
    }
}

}  // namespace

Matrix image_points(const engine::Seq<Image>& images, const ImagePointsOptions& options) {
  check(!images.empty(), "there are no images, expected at least one");
  RowMajor all;
  Image first;
  int width = 0, height = 0;
  Eigen::Index row = 0;
  for (const Image& image : images) {
    const std::string name = "image " + images.id(static_cast<std::size_t>(row));
    if (row == 0) {
      check_picture(image, name);
      first = {image.width, image.height, 3, {}};
      width = static_cast<int>(std::min<std::int64_t>(options.thumbnail_px, image.width));
      height = std::clamp(image.height * width / image.width, 1, image.height);
      all.resize(static_cast<Eigen::Index>(images.size()), width * height);
    }
    check_size(image, name, first, "the first one");
    thumbnail(image, width, height, all.row(row++).data());
  }
  all.rowwise() -= all.colwise().mean().eval();
  const Eigen::MatrixXd covariance = (all.transpose() * all).cast<double>() / static_cast<double>(all.rows());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(covariance);
  const double largest = std::max(parts.eigenvalues().tail(1)[0], 0.0);
  Eigen::Index count = 0;
  const Eigen::Index most = std::min<Eigen::Index>(options.components, covariance.rows());
  // Directions of less than a millionth of the largest variance are rounding.
  while (count < most && parts.eigenvalues()[covariance.rows() - 1 - count] > 1e-6 * largest) ++count;
  count = std::max<Eigen::Index>(count, 1);
  Matrix points{static_cast<std::size_t>(all.rows()), static_cast<std::size_t>(count), {}};
  points.values.resize(points.rows * points.columns);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index from = covariance.rows() - 1 - k;
    Eigen::VectorXd mode = parts.eigenvectors().col(from);
    Eigen::Index at = 0;
    mode.cwiseAbs().maxCoeff(&at);
    if (mode[at] < 0) mode = -mode;
    const double variance = parts.eigenvalues()[from];
    if (options.whiten && variance > 0) mode /= std::sqrt(variance);
    const Eigen::VectorXf scores = all * mode.cast<float>();
    for (Eigen::Index t = 0; t < all.rows(); ++t)
      points.at(static_cast<std::size_t>(t), static_cast<std::size_t>(k)) = static_cast<double>(scores[t]);
  }
  return points;
}

}  // namespace face::mmm
