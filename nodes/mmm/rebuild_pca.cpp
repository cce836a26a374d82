// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/rebuild_pca.h"

#include <Eigen/Dense>
#include <algorithm>

#include "nodes/base/check.h"
#include "nodes/base/sample_image.h"
#include "nodes/mmm/check_picture.h"

namespace face::mmm {

void rebuild_pca(const engine::Seq<Image>& examples, const engine::Seq<Image>& pictures,
                 engine::SeqWriter<Image>& rebuilt, const RebuildPcaOptions& options) {
  check(!examples.empty(), "there are no examples, expected at least one");
  const Image first = *examples.at(0);
  check_picture(first, "example " + examples.id(0));
  const auto size = static_cast<Eigen::Index>(first.pixels.size());
  const auto row = [size](const Image& image) {
    return Eigen::Map<const Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 1>>(image.pixels.data(), size).cast<float>();
  };
  Eigen::MatrixXf all(size, static_cast<Eigen::Index>(examples.size()));
  Eigen::Index column = 0;
  for (const Image& example : examples) {
    check_size(example, "example " + examples.id(static_cast<std::size_t>(column)), first, "the first one");
    all.col(column++) = row(example);
  }
  const Eigen::VectorXf mean = all.rowwise().mean();
  all.colwise() -= mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts((all.transpose() * all).cast<double>());
  const double largest = std::max(parts.eigenvalues().tail(1)[0], 0.0);
  Eigen::Index count = 0;
  const Eigen::Index most = std::min<Eigen::Index>(options.components, all.cols());
  while (count < most && parts.eigenvalues()[all.cols() - 1 - count] > 1e-7 * largest) ++count;
  Eigen::MatrixXf modes(size, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index from = all.cols() - 1 - k;
    modes.col(k) = all * parts.eigenvectors().col(from).cast<float>();
    modes.col(k).normalize();
  }
  std::size_t at = 0;
  for (const Image& picture : pictures) {
    const std::string id = pictures.id(at++);
    check_size(picture, "picture " + id, first, "the first example");
    const Eigen::VectorXf values = mean + modes * (modes.transpose() * (row(picture) - mean));
    Image made{first.width, first.height, 3, {}};
    for (const float value : values) made.pixels.push_back(to_byte(static_cast<double>(value)));
    rebuilt.push(id, std::move(made));
  }
}

}  // namespace face::mmm
