// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/find_components.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/mmm/morph.h"

namespace face::mmm {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int stride_px = 2;

// Mean square change of grey per unit of alpha and of beta: [a 0; 0 b], 2 N x 2 N.
MatrixXd metric(const Mmm& model) {
  const auto n = static_cast<Index>(model.prototypes.size());
  const Image& first = model.prototypes[0].image;
  std::vector<std::size_t> seen;
  for (int y = 0; y < first.height; y += stride_px)
    for (int x = 0; x < first.width; x += stride_px)
      seen.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(first.width) + static_cast<std::size_t>(x));
  const auto count = static_cast<Index>(seen.size());
  Eigen::MatrixXf flows(2 * count, n), greys(count, n);
  for (Index i = 0; i < n; ++i) {
    const MmmPrototype& prototype = model.prototypes[static_cast<std::size_t>(i)];
    for (Index s = 0; s < count; ++s) {
      const std::size_t p = seen[static_cast<std::size_t>(s)];
      flows(2 * s, i) = static_cast<float>(prototype.flow_64th_px[2 * p]) / 64;
      flows(2 * s + 1, i) = static_cast<float>(prototype.flow_64th_px[2 * p + 1]) / 64;
      const std::uint8_t* rgb = &prototype.image.pixels[3 * p];
      greys(s, i) = static_cast<float>(rgb[0] + rgb[1] + rgb[2]) / 3;
    }
  }
  const Image& reference = model.prototypes[static_cast<std::size_t>(model.reference)].image;
  double gradient = 0, pixels = 0;
  for (int y = 0; y < reference.height; ++y)
    for (int x = 0; x + 1 < reference.width; ++x) {
      const auto at = static_cast<std::size_t>(3 * (y * reference.width + x) + 1);
      gradient += std::pow(reference.pixels[at + 3] - reference.pixels[at], 2), ++pixels;
    }
  gradient = pixels > 0 ? gradient / pixels : 1;
  // beta adds up to 1: what all pictures have in common changes nothing.
  greys.colwise() -= greys.rowwise().mean().eval();
  MatrixXd both = MatrixXd::Zero(2 * n, 2 * n);
  both.topLeftCorner(n, n) = (flows.transpose() * flows).cast<double>() * gradient / static_cast<double>(count);
  both.bottomRightCorner(n, n) = (greys.transpose() * greys).cast<double>() / static_cast<double>(count);
  return both;
}

MatrixXd square_root(const MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> parts(matrix);
  return parts.eigenvectors() * parts.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() *
         parts.eigenvectors().transpose();
}

}  // namespace

Matrix find_components(const Mmm& model, const engine::Seq<Weights>& parameters, const FindComponentsOptions& options) {
  check_model(model);
  const std::size_t size = 2 * model.prototypes.size();
  const auto n = static_cast<Index>(size);
  VectorXd sum = VectorXd::Zero(n);
  MatrixXd squares = MatrixXd::Zero(n, n);
  std::size_t number = 0;
  double frames = 0;
  for (const Weights& frame : parameters) {
    const std::string id = parameters.id(number++);
    if (frame.values.empty()) continue;
    check(frame.values.size() == size, "frame ", id, " has ", frame.values.size(), " parameters, expected ", size,
          " for ", model.prototypes.size(), " prototypes");
    const VectorXd x = Eigen::Map<const Eigen::VectorXf>(frame.values.data(), n).cast<double>();
    check(x.allFinite(), "frame ", id, " has a parameter that is not a number");
    sum += x;
    squares += x * x.transpose();
    ++frames;
  }
  check(frames > 0, "no frame has parameters");
  const VectorXd mean = sum / frames;
  const MatrixXd covariance = squares / frames - mean * mean.transpose();
  const MatrixXd scale = square_root(metric(model));
  const Eigen::SelfAdjointEigenSolver<MatrixXd> parts(scale * covariance * scale);
  const double largest = std::max(parts.eigenvalues()[n - 1], 0.0);
  Index count = 0;
  // A variance of less than a millionth of the largest is rounding.
  while (count < std::min(static_cast<Index>(options.count), n) && parts.eigenvalues()[n - 1 - count] > 1e-6 * largest)
    ++count;
  Matrix result{static_cast<std::size_t>(1 + 2 * count), size, {}};
  result.values.assign(result.rows * result.columns, 0);
  const auto put = [&](Index row, const VectorXd& values) {
    for (std::size_t i = 0; i < size; ++i) result.at(static_cast<std::size_t>(row), i) = values[static_cast<Index>(i)];
  };
  put(0, mean);
  for (Index k = 0; k < count; ++k) {
    VectorXd mode = parts.eigenvectors().col(n - 1 - k);
    Index at = 0;
    mode.cwiseAbs().maxCoeff(&at);
    if (mode[at] < 0) mode = -mode;
    const VectorXd to = scale * mode / std::sqrt(parts.eigenvalues()[n - 1 - k]);
    put(1 + k, to);
    // Numbers have variance 1 and are not correlated, so that this is the regression of the parameters on them.
    put(1 + count + k, covariance * to);
  }
  return result;
}

std::size_t component_count(const Matrix& components) {
  check(components.rows % 2 == 1 && components.values.size() == components.rows * components.columns, "components are ",
        components.rows, " x ", components.columns, " with ", components.values.size(),
        " values, expected an odd number of rows");
  return (components.rows - 1) / 2;
}

}  // namespace face::mmm
