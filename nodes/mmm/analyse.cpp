// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/analyse.h"

#include <Eigen/Dense>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/base/nnls.h"
#include "nodes/mmm/check_picture.h"
#include "nodes/mmm/morph.h"

namespace face::mmm {

AnalyseResult analyse(const Mmm& model, const Image& image, const AnalyseOptions& options) {
  check_model(model);
  check(model.prototypes.size() <= 63, "the model has ", model.prototypes.size(), " prototypes, expected at most 63");
  check_size(image, "image", model.prototypes[0].image, "the model");
  const auto reference = static_cast<std::size_t>(model.reference);
  const std::size_t n = model.prototypes.size();
  const auto size = static_cast<Eigen::Index>(n);
  const int stride = static_cast<int>(options.stride_px);

  // alpha
  const std::vector<Vec2f> flow = follow_mouth(model.prototypes[reference].image, image);
  std::vector<std::size_t> seen;
  for (int y = 0; y < image.height; y += stride)
    for (int x = 0; x < image.width; x += stride)
      seen.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  Eigen::MatrixXf flows(static_cast<Eigen::Index>(2 * seen.size()), size);
  Eigen::VectorXf wanted(flows.rows());
  for (std::size_t s = 0; s < seen.size(); ++s)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto row = static_cast<Eigen::Index>(2 * s + axis);
      wanted[row] = flow[seen[s]][axis];
      for (std::size_t i = 0; i < n; ++i)
        flows(row, static_cast<Eigen::Index>(i)) =
            static_cast<float>(model.prototypes[i].flow_64th_px[2 * seen[s] + axis]) / 64;
    }
  Eigen::MatrixXd normal = (flows.transpose() * flows).cast<double>();
  const double mean_square = normal.trace() / static_cast<double>(n);
  normal.diagonal().array() += options.restraint * mean_square + 1e-9;
  const Eigen::VectorXd alpha = normal.ldlt().solve((flows.transpose() * wanted).cast<double>());
  AnalyseResult result;
  for (const double a : alpha) result.parameters.values.push_back(static_cast<float>(a));

  // beta
  const std::vector<Vec2f> inverse =
      invert_flow(mix_flows(model, result.parameters.values.data()), image.width, image.height);
  Matrix basis{3 * seen.size(), n, std::vector<double>(3 * seen.size() * n)};
  for (std::size_t i = 0; i < n; ++i) {
    const std::vector<float> morphed = morph_prototype(model, i, inverse, stride);
    for (std::size_t r = 0; r < basis.rows; ++r) basis.at(r, i) = static_cast<double>(morphed[r]);
  }
  std::vector<double> target;
  for (const std::size_t p : seen)
    for (std::size_t c = 0; c < 3; ++c) target.push_back(image.pixels[3 * p + c]);
  std::vector<double> beta(n);
  NonNegativeLeastSquares(basis, options.sum_to_one).solve(target.data(), beta.data());
  double squares = 0;
  for (std::size_t r = 0; r < basis.rows; ++r) {
    double left = target[r];
    for (std::size_t i = 0; i < n; ++i) left -= beta[i] * basis.at(r, i);
    squares += left * left;
  }
  result.rms = std::sqrt(squares / static_cast<double>(basis.rows));
  for (const double b : beta) result.parameters.values.push_back(static_cast<float>(b));
  return result;
}

}  // namespace face::mmm
