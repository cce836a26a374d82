// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/read_opening.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/find_landmark.h"
#include "nodes/mmm/check_picture.h"

namespace face::mmm {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double opening_px(const Landmarks& landmarks, const std::string& frame, const ReadOpeningOptions& options) {
  const Landmark *upper = find_landmark(landmarks, options.upper), *lower = find_landmark(landmarks, options.lower);
  check(upper != nullptr, "frame ", frame, " has no landmark ", options.upper);
  check(lower != nullptr, "frame ", frame, " has no landmark ", options.lower);
  const double opening = lower->y_px - upper->y_px;
  check(std::isfinite(opening), "frame ", frame, " is open by ", opening, " px, expected a finite number");
  return opening;
}

// Grey means over cells, as one row.
VectorXd small_picture(const Image& image, int width) {
  const int height = std::max(1, width * image.height / image.width);
  VectorXd values(width * height);
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const int left = i * image.width / width, right = std::max(left + 1, (i + 1) * image.width / width);
      const int top = j * image.height / height, bottom = std::max(top + 1, (j + 1) * image.height / height);
      double sum = 0;
      for (int y = top; y < bottom; ++y)
        for (int x = 3 * left; x < 3 * right; ++x)
          sum += image.pixels[static_cast<std::size_t>(3 * y * image.width + x)];
      values[j * width + i] = sum / (3.0 * (right - left) * (bottom - top));
    }
  return values;
}

struct Reader {
  VectorXd mean, weights;
  double middle_px = 0;
  double operator()(const VectorXd& picture) const { return middle_px + weights.dot(picture - mean); }
};

// By the pictures' products with each other: there are fewer of them than pixels. rows: those that count.
Reader learn(const MatrixXd& pictures, const VectorXd& opening, const std::vector<Index>& rows, double restraint) {
  Reader reader;
  reader.mean = VectorXd::Zero(pictures.cols());
  for (const Index row : rows) {
    reader.mean += pictures.row(row).transpose() / static_cast<double>(rows.size());
    reader.middle_px += opening[row] / static_cast<double>(rows.size());
  }
  MatrixXd centred(static_cast<Index>(rows.size()), pictures.cols());
  VectorXd wanted(centred.rows());
  for (Index i = 0; i < centred.rows(); ++i) {
    const Index row = rows[static_cast<std::size_t>(i)];
    centred.row(i) = pictures.row(row) - reader.mean.transpose();
    wanted[i] = opening[row] - reader.middle_px;
  }
  MatrixXd products = centred * centred.transpose();
  products.diagonal().array() += restraint;
  reader.weights = centred.transpose() * products.ldlt().solve(wanted);
  return reader;
}

struct Likeness {
  double r = nothing, slope = nothing, error_px = nothing;
};

Likeness compare(const std::vector<double>& read, const std::vector<double>& truth) {
  const auto count = static_cast<double>(read.size());
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0, error = 0;
  for (std::size_t i = 0; i < read.size(); ++i) a += read[i] / count, b += truth[i] / count;
  for (std::size_t i = 0; i < read.size(); ++i) {
    aa += (read[i] - a) * (read[i] - a), bb += (truth[i] - b) * (truth[i] - b), ab += (read[i] - a) * (truth[i] - b);
    error += (read[i] - truth[i]) * (read[i] - truth[i]) / count;
  }
  Likeness out;
  if (!read.empty()) out.error_px = std::sqrt(error);
  if (bb > 1e-12) out.slope = ab / bb;
  if (aa > 1e-12 && bb > 1e-12) out.r = ab / std::sqrt(aa * bb);
  return out;
}

}  // namespace

ReadOpeningResult read_opening(const engine::Seq<Image>& known, const engine::Seq<Landmarks>& known_truth,
                               const engine::Seq<Image>& images, const engine::Seq<Landmarks>& truth,
                               const ReadOpeningOptions& options) {
  check(known.size() == known_truth.size(), "there are ", known.size(), " known pictures and ", known_truth.size(),
        " landmarks of them, expected as many");
  check(images.size() == truth.size(), "there are ", images.size(), " pictures and ", truth.size(),
        " true landmarks, expected as many");
  check(known.size() >= 4, "there are ", known.size(), " known pictures, expected at least 4");
  check(options.pictures >= 4, "pictures is ", options.pictures, ", expected at least 4");
  const std::size_t count = std::min(known.size(), static_cast<std::size_t>(options.pictures));
  const auto first = known.at(0);
  check_picture(*first, "known picture " + known.id(0));
  const int width = static_cast<int>(std::clamp<std::int64_t>(options.width_px, 1, first->width));
  MatrixXd pictures;
  VectorXd opening(static_cast<Index>(count));
  std::vector<Index> all, even, odd;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = i * known.size() / count;
    const auto row = static_cast<Index>(i);
    const auto image = known.at(at);
    check_size(*image, "known picture " + known.id(at), *first, "the first one");
    const VectorXd picture = small_picture(*image, width);
    if (i == 0) pictures.resize(opening.size(), picture.size());
    pictures.row(row) = picture.transpose();
    opening[row] = opening_px(*known_truth.at(at), known_truth.id(at), options);
    all.push_back(row);
    (i % 2 == 0 ? even : odd).push_back(row);
  }
  const Reader half = learn(pictures, opening, even, options.restraint);
  std::vector<double> read, wanted;
  for (const Index row : odd) read.push_back(half(pictures.row(row).transpose())), wanted.push_back(opening[row]);
  const double reader_r = compare(read, wanted).r;

  const Reader reader = learn(pictures, opening, all, options.restraint);
  ReadOpeningResult result;
  result.frames.columns = {"read_px", "true_px"};
  read.clear(), wanted.clear();
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto image = images.at(i);
    check_size(*image, "picture " + images.id(i), *first, "the known ones");
    read.push_back(reader(small_picture(*image, width)));
    wanted.push_back(opening_px(*truth.at(i), truth.id(i), options));
    result.frames.rows.push_back({images.id(i), {read.back(), wanted.back()}});
  }
  const Likeness alike = compare(read, wanted);
  result.table = {{"reader_r", "r", "amplitude", "error_px"},
                  {{"all", {reader_r, alike.r, alike.slope, alike.error_px}}}};
  return result;
}

}  // namespace face::mmm
