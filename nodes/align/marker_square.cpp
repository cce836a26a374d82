// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/marker_square.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "nodes/base/check.h"
#include "nodes/base/luma.h"

namespace face::align {
namespace {

constexpr int lanes = 8;                            // of a register; rows of places are padded to a multiple
constexpr int fit_steps = 12;                       // most need four
constexpr double reach_of_fit_px = 1.5;             // what is farther from the best whole pixel is another minimum
constexpr double least_area = 0.15, most_area = 4;  // of the square once bent: a disc at 81 degrees, twice as near
constexpr double settled_px = 0.003, settled_bend = 0.01;
// How stiff the square is against a shift, in px^2. A round dot does not tell how far it is turned, and a dot that is a
// few pixels wide hardly how it is sheared: what noise makes of these would add up from frame to frame. 2 to 8 do the
// same; below 1 the bends of steep dots run away.
constexpr double stiffness_px2 = 4;

}  // namespace

int GreyPicture::at(int x, int y) const {
  x = std::clamp(x, 0, width - 1);
  y = std::clamp(y, 0, height - 1);
  return values[static_cast<std::size_t>(y * width + x)];
}

double GreyPicture::at(double x, double y) const {
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const double fx = x - x0, fy = y - y0;
  return (at(x0, y0) * (1 - fx) + at(x0 + 1, y0) * fx) * (1 - fy) +
         (at(x0, y0 + 1) * (1 - fx) + at(x0 + 1, y0 + 1) * fx) * fy;
}

GreyPicture grey_of(const Image& picture) {
  const std::size_t count = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  const auto channels = static_cast<std::size_t>(picture.channels);
  check(picture.pixels.size() == count * channels, "scan's picture has ", picture.pixels.size(), " bytes, expected ",
        picture.width, " x ", picture.height, " x ", picture.channels);
  GreyPicture grey{picture.width, picture.height, {}};
  if (channels == 1) {
    grey.values = picture.pixels;
    return grey;
  }
  grey.values.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* p = picture.pixels.data() + i * channels;
    grey.values[i] = static_cast<std::uint8_t>(std::lround(grey_value<double>(p, picture.channels)));
  }
  return grey;
}

MarkerSquare::MarkerSquare(const Image& templates, std::size_t index, int side, const Place& marker)
    : side_(side), marker_(marker) {
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      values_.push_back(templates.pixels[static_cast<std::size_t>(y * templates.width) +
                                         index * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)]);
}

MarkerMatch MarkerSquare::find(const GreyPicture& grey, const MarkerSearch& search) const {
  MarkerMatch match = look(grey, search);
  match.bend = search.bend;
  fit(grey, match);
  return match;
}

MarkerMatch MarkerSquare::look(const GreyPicture& grey, const MarkerSearch& search) const {
  // The square as it should lie.
  const Bend& b = search.bend;
  const double det = b[0] * b[3] - b[1] * b[2];
  std::vector<std::int32_t> own;
  std::int64_t own_sum = 0, own_square = 0;
  for (int y = 0; y < side_; ++y)
    for (int x = 0; x < side_; ++x) {
      const double dx = x - marker_.x, dy = y - marker_.y;
      const double u = std::clamp(marker_.x + (b[3] * dx - b[1] * dy) / det, 0.0, side_ - 1.0);
      const double v = std::clamp(marker_.y + (b[0] * dy - b[2] * dx) / det, 0.0, side_ - 1.0);
      const int x0 = std::min(static_cast<int>(u), side_ - 2), y0 = std::min(static_cast<int>(v), side_ - 2);
      const double fx = u - x0, fy = v - y0;
      const auto level =
          static_cast<std::int16_t>(std::lround((value(x0, y0) * (1 - fx) + value(x0 + 1, y0) * fx) * (1 - fy) +
                                                (value(x0, y0 + 1) * (1 - fx) + value(x0 + 1, y0 + 1) * fx) * fy));
      own.push_back(level);
      own_sum += level;
      own_square += level * level;
    }
  // The neighbourhood once, so that the sums run over contiguous memory.
  const int left = static_cast<int>(std::lround(search.forecast.x - marker_.x)) - search.reach_px;
  const int top = static_cast<int>(std::lround(search.forecast.y - marker_.y)) - search.reach_px;
  const int places = 2 * search.reach_px + 1, extent = side_ + places - 1, stride = extent + lanes;
  std::vector<std::int32_t> about(static_cast<std::size_t>(stride * extent), 0);
  // Sums over all that is above and to the left.
  const int corners = extent + 1;
  std::vector<std::int64_t> sums(static_cast<std::size_t>(corners * corners), 0), squares(sums);
  for (int y = 0; y < extent; ++y) {
    std::int64_t sum = 0, square = 0;
    for (int x = 0; x < extent; ++x) {
      const std::int32_t level = grey.at(left + x, top + y);
      about[static_cast<std::size_t>(y * stride + x)] = level;
      sum += level;
      square += level * level;
      const auto at = static_cast<std::size_t>((y + 1) * corners + x + 1),
                 above = at - static_cast<std::size_t>(corners);
      sums[at] = sums[above] + sum;
      squares[at] = squares[above] + square;
    }
  }
  const auto inside = [&](const std::vector<std::int64_t>& of, int x, int y) {
    const auto at = [&](int ax, int ay) { return of[static_cast<std::size_t>(ay * corners + ax)]; };
    return at(x + side_, y + side_) - at(x, y + side_) - at(x + side_, y) + at(x, y);
  };
  const std::int64_t count = side_ * side_;
  const auto own_spread = static_cast<double>(count * own_square - own_sum * own_sum);
  const double cost = search.cost / (static_cast<double>(search.reach_px) * search.reach_px);
  MarkerMatch match;
  match.at = search.forecast;
  match.score = -std::numeric_limits<double>::infinity();
  std::vector<std::int32_t> products(static_cast<std::size_t>((places + lanes - 1) / lanes * lanes));
  for (int dy = 0; dy < places; ++dy) {
    // A row of places at once.
    std::fill(products.begin(), products.end(), 0);
    for (int y = 0; y < side_; ++y)
      for (int x = 0; x < side_; ++x) {
        const std::int32_t level = own[static_cast<std::size_t>(y * side_ + x)];
        const std::int32_t* theirs = about.data() + static_cast<std::size_t>((dy + y) * stride + x);
        for (std::size_t dx = 0; dx < products.size(); dx += lanes)
          for (std::size_t k = dx; k < dx + lanes; ++k) products[k] += level * theirs[k];
      }
    for (int dx = 0; dx < places; ++dx) {
      const std::int64_t product = products[static_cast<std::size_t>(dx)];
      const std::int64_t sum = inside(sums, dx, dy);
      const auto spread = static_cast<double>(count * inside(squares, dx, dy) - sum * sum);
      if (spread <= 0 || own_spread <= 0) continue;
      const Place at{left + dx + marker_.x, top + dy + marker_.y};
      const double off_x = at.x - search.forecast.x, off_y = at.y - search.forecast.y;
      const double likeness = static_cast<double>(count * product - own_sum * sum) / std::sqrt(own_spread * spread);
      const double score = likeness - cost * (off_x * off_x + off_y * off_y);
      if (score <= match.score) continue;
      if (search.taken != nullptr && std::any_of(search.taken->begin(), search.taken->end(),
                                                 [&](const Place& other) { return is_near(at, other, 0.5 * side_); }))
        continue;
      match.score = score;
      match.at = at;
    }
  }
  return match;
}

// Gauss-Newton on place and bend, in the square's own frame, so that its gradients and their matrix are made once
// (inverse compositional: Baker and Matthews, Lucas-Kanade 20 Years On, IJCV 2004, section 3.2); gain and offset are
// projected out of the gradients (section 4 of part 3). Keeps the place that is most alike.
void MarkerSquare::fit(const GreyPicture& grey, MarkerMatch& match) const {
  using Gradients = Eigen::Matrix<double, Eigen::Dynamic, 6>;
  const int count = side_ * side_;
  Eigen::VectorXd own(count), seen(count);
  Gradients gradients(count, 6);
  for (int y = 0; y < side_; ++y)
    for (int x = 0; x < side_; ++x) {
      const int x0 = std::max(x - 1, 0), x1 = std::min(x + 1, side_ - 1);
      const int y0 = std::max(y - 1, 0), y1 = std::min(y + 1, side_ - 1);
      const double gx = (value(x1, y) - value(x0, y)) / (x1 - x0), gy = (value(x, y1) - value(x, y0)) / (y1 - y0);
      const double dx = x - marker_.x, dy = y - marker_.y;
      own(y * side_ + x) = value(x, y);
      gradients.row(y * side_ + x) << gx, gy, gx * dx, gx * dy, gy * dx, gy * dy;
    }
  own.array() -= own.mean();
  const double own_square = own.squaredNorm();
  if (own_square <= 0) return;
  gradients.rowwise() -= gradients.colwise().mean();
  gradients -= own * (own.transpose() * gradients) / own_square;
  Eigen::Matrix<double, 6, 6> normal = gradients.transpose() * gradients;
  const double stiffness = stiffness_px2 * (normal(0, 0) + normal(1, 1));
  for (int k = 2; k < 6; ++k) normal(k, k) += stiffness;
  const Eigen::LLT<Eigen::Matrix<double, 6, 6>> solver(normal);
  if (solver.info() != Eigen::Success) return;

  const Eigen::Vector2d start(match.at.x, match.at.y);
  Eigen::Vector2d at = start;
  Eigen::Matrix2d bend;
  bend << match.bend[0], match.bend[1], match.bend[2], match.bend[3];
  for (int step = 0; step < fit_steps; ++step) {
    for (int y = 0; y < side_; ++y)
      for (int x = 0; x < side_; ++x) {
        const double dx = x - marker_.x, dy = y - marker_.y;
        seen(y * side_ + x) =
            grey.at(at(0) + bend(0, 0) * dx + bend(0, 1) * dy, at(1) + bend(1, 0) * dx + bend(1, 1) * dy);
      }
    seen.array() -= seen.mean();
    const double product = seen.dot(own), square = seen.squaredNorm();
    if (square <= 0) return;
    const double likeness = product / std::sqrt(own_square * square);
    if (likeness > match.likeness) {
      match.likeness = likeness;
      match.at = {at(0), at(1)};
      match.bend = {bend(0, 0), bend(0, 1), bend(1, 0), bend(1, 1)};
    }
    if (product <= 0) return;
    const Eigen::Matrix<double, 6, 1> d = solver.solve(gradients.transpose() * seen * (own_square / product));
    Eigen::Matrix2d change;
    change << 1 + d(2), d(3), d(4), 1 + d(5);
    if (change.determinant() <= 0) return;
    bend = (bend * change.inverse()).eval();
    const Eigen::Vector2d moved = -bend * d.head<2>();
    at += moved;
    const double area = bend.determinant();
    if (area < least_area || area > most_area || (at - start).norm() > reach_of_fit_px) return;
    if (moved.norm() < settled_px && d.tail<4>().cwiseAbs().sum() < settled_bend) return;
  }
}

}  // namespace face::align
