// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/head_motion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/track/head_raster.h"

namespace face::track {
namespace {

using Place = std::complex<double>;
using Numbers = Eigen::Matrix<double, 6, 1>;

// Each pixel the mean of `times` x `times`.
Grey reduced(const Grey& grey, int times) {
  Grey small{std::max(1, grey.width / times), std::max(1, grey.height / times), {}};
  small.values.reserve(static_cast<std::size_t>(small.width) * static_cast<std::size_t>(small.height));
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      float sum = 0;
      for (int v = y * times; v < std::min((y + 1) * times, grey.height); ++v)
        for (int u = x * times; u < std::min((x + 1) * times, grey.width); ++u)
          sum += grey.values[static_cast<std::size_t>(v * grey.width + u)];
      small.values.push_back(sum / static_cast<float>(times * times));
    }
  return small;
}

// A picture of which one pixel is about as large as the raster's step.
struct Level {
  const Grey* whole = nullptr;  // outlives the level
  Grey small;                   // where `times` is more than 1
  int times = 1;
  double at(Place place) const {
    const double shift = (times - 1) / 2.0;
    const Grey& grey = times > 1 ? small : *whole;
    return static_cast<double>(grey.at((place.real() - shift) / times, (place.imag() - shift) / times));
  }
  double unit() const { return times; }
};

Level level_of(const Grey& grey, double step_px) {
  const int times = std::max(1, static_cast<int>(std::lround(step_px)));
  return {&grey, times > 1 ? reduced(grey, times) : Grey{}, times};
}

// Means over squares of a raster of `width` columns.
std::vector<double> local_means(const std::vector<double>& values, int width, int reach) {
  const int height = static_cast<int>(values.size()) / width;
  std::vector<double> sums(static_cast<std::size_t>((width + 1) * (height + 1)), 0.0), means(values.size());
  const auto sum = [&](int x, int y) -> double& { return sums[static_cast<std::size_t>(y * (width + 1) + x)]; };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      sum(x + 1, y + 1) = values[static_cast<std::size_t>(y * width + x)] + sum(x, y + 1) + sum(x + 1, y) - sum(x, y);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int x0 = std::max(0, x - reach), x1 = std::min(width, x + reach + 1);
      const int y0 = std::max(0, y - reach), y1 = std::min(height, y + reach + 1);
      means[static_cast<std::size_t>(y * width + x)] =
          (sum(x1, y1) - sum(x0, y1) - sum(x1, y0) + sum(x0, y0)) / ((x1 - x0) * (y1 - y0));
    }
  return means;
}

// Freed from local brightness and contrast; `scales`, where given, becomes what differences were multiplied by.
std::vector<double> normalised(std::vector<double> values, int width, int reach, std::vector<double>* scales) {
  constexpr double noise = 4;  // grey levels; less contrast than that is not made more
  const std::vector<double> means = local_means(values, width, reach);
  std::vector<double> squares;
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] -= means[i];
    squares.push_back(values[i] * values[i]);
  }
  const std::vector<double> variances = local_means(squares, width, reach);
  if (scales != nullptr) scales->clear();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double scale = 1 / std::sqrt(variances[i] + noise * noise);
    values[i] *= scale;
    if (scales != nullptr) scales->push_back(scale);
  }
  return values;
}

// One size of the picture, with what was learnt at that size.
struct Scale {
  Level level;
  std::vector<Knot> knots;
  int width = 0;  // columns of knots
  int reach = 0;  // of normalising, knots
  std::vector<double> wanted;
};

Scale scale_of(const Grey& grey, const RasterFrame& frame, const Image& learnt, int stride) {
  Scale scale;
  scale.level = level_of(grey, stride * raster_step * std::abs(frame.across));
  scale.knots = raster_knots(frame, stride);
  scale.width = (raster_columns + stride - 1) / stride;
  scale.reach = std::max(2, 6 / stride);
  std::vector<double> values(learnt.pixels.begin(), learnt.pixels.end());
  if (stride > 1) values = local_means(values, raster_columns, stride / 2);
  std::vector<double> taken;
  for (const Knot& knot : scale.knots) {
    taken.push_back(values[knot.index]);
  }
  scale.wanted = normalised(taken, scale.width, scale.reach, nullptr);
  return scale;
}

Numbers numbers_of(const HeadPose& pose) { return Numbers(pose_numbers(pose).data()); }

HeadPose pose_of(const Numbers& n) { return track::pose_of({n[0], n[1], n[2], n[3], n[4], n[5]}); }

// The solid's origin is the middle between the eyes: knots are counted from there.
SolidHead solid_of(const Numbers& numbers) { return solid_head(pose_of(numbers), {0, 0, 0}); }

Place seen(const SolidHead& head, const Knot& knot) { return head.seen(knot.place_px, knot.depth_px); }

// How much a difference counts, of pictures whose contrast is about 1.
double trust(double difference) {
  constexpr double usual = 0.5;
  const double r = difference / usual;
  return 1 / (1 + r * r);
}

std::vector<double> picture_at(const Scale& scale, const SolidHead& head, std::vector<double>* scales) {
  std::vector<double> values;
  values.reserve(scale.knots.size());
  for (const Knot& knot : scale.knots) values.push_back(scale.level.at(seen(head, knot)));
  return normalised(std::move(values), scale.width, scale.reach, scales);
}

double likeness_at(const Scale& scale, const SolidHead& head) {
  // Mean square difference of pictures that have nothing in common, no difference counting more than the largest.
  constexpr double largest = 2, strangers = 1.1;
  const std::vector<double> found = picture_at(scale, head, nullptr);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!scale.knots[i].solid) continue;
    const double off = found[i] - scale.wanted[i];
    sum += std::min(off * off, largest);
    ++count;
  }
  return count > 0 ? 1 - sum / count / strangers : 0;
}

// A head does not turn by much more than this from one frame to the next; where it goes is free.
Numbers usual_change(double unit_px) {
  Numbers deviation;
  deviation << 0.1, 0.1, 0.1, 0.05, 20 * unit_px, 20 * unit_px;
  return deviation;
}

Numbers refine(const Scale& scale, const Numbers& from, Numbers numbers) {
  constexpr int most_steps = 12;
  constexpr double independent = 0.1;  // of the knots; neighbours see the same
  constexpr double error = 0.5, settled_px = 0.02;
  const Numbers deviation = usual_change(scale.level.unit());
  for (int round = 0; round < most_steps; ++round) {
    const SolidHead head = solid_of(numbers);
    std::vector<double> scales;
    const std::vector<double> found = picture_at(scale, head, &scales);
    std::array<SolidHead, 6> moved;
    constexpr double nudge = 1e-5;
    for (int k = 0; k < 6; ++k) {
      Numbers other = numbers;
      other[k] += nudge;
      moved[static_cast<std::size_t>(k)] = solid_of(other);
    }
    Eigen::Matrix<double, 6, 6> hessian = Eigen::Matrix<double, 6, 6>::Zero();
    Numbers slope = Numbers::Zero();
    const double half = 0.5 * scale.level.unit();
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!scale.knots[i].solid) continue;
      const Place at = seen(head, scale.knots[i]);
      const double dx = (scale.level.at(at + half) - scale.level.at(at - half)) / (2 * half);
      const double dy = (scale.level.at(at + Place(0, half)) - scale.level.at(at - Place(0, half))) / (2 * half);
      Numbers row;
      for (int k = 0; k < 6; ++k) {
        const Place change = (seen(moved[static_cast<std::size_t>(k)], scale.knots[i]) - at) / nudge;
        row[k] = scales[i] * (dx * change.real() + dy * change.imag());
      }
      const double off = found[i] - scale.wanted[i], w = independent * trust(off) / (error * error);
      hessian += w * row * row.transpose();
      slope -= w * off * row;
    }
    for (int k = 0; k < 6; ++k) {
      const double sure = 1 / (deviation[k] * deviation[k]);
      hessian(k, k) += sure;
      slope[k] += sure * (from[k] - numbers[k]);
    }
    const Numbers change = hessian.ldlt().solve(slope);
    if (!change.allFinite()) break;
    numbers += change;
    constexpr double most_turn = 1.0, most_scale = 0.7;
    for (int k = 0; k < 2; ++k) numbers[k] = std::clamp(numbers[k], -most_turn, most_turn);
    numbers[3] = std::clamp(numbers[3], -most_scale, most_scale);
    const double far_px = std::abs(scale.knots.back().place_px.real()) + scale.level.unit();
    if (change.head<4>().cwiseAbs().maxCoeff() * far_px < settled_px &&
        change.tail<2>().cwiseAbs().maxCoeff() < settled_px)
      break;
  }
  return numbers;
}

// The best of the places about a pose, on a grid of a knot's distance.
Numbers search(const Scale& scale, const Numbers& from, int reach) {
  Numbers best = from;
  double most = -2;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      Numbers there = from;
      there[4] += x * scale.level.unit();
      there[5] += y * scale.level.unit();
      const double likeness = likeness_at(scale, solid_of(there));
      if (likeness > most) most = likeness, best = there;
    }
  return best;
}

}  // namespace

Image learn_head(const Grey& grey, const Landmarks& start) {
  const RasterFrame frame = raster_frame(start);
  if (!frame.valid) return {0, 0, 1, {}};
  const Level level = level_of(grey, raster_step * std::abs(frame.across));
  Image learnt{raster_columns, raster_rows, 1, {}};
  for (const Knot& knot : raster_knots(frame, 1))
    learnt.pixels.push_back(
        static_cast<std::uint8_t>(std::lround(std::clamp(level.at(frame.middle + knot.place_px), 0.0, 255.0))));
  return learnt;
}

HeadSight find_head(const Grey& grey, const Landmarks& start, const Image& learnt, const HeadPose& from) {
  const RasterFrame frame = raster_frame(start);
  if (!frame.valid || learnt.pixels.empty()) return {from, 0};
  constexpr double sure = 0.7;
  const Scale coarse = scale_of(grey, frame, learnt, 3), fine = scale_of(grey, frame, learnt, 1);
  const Numbers before = numbers_of(from);
  const auto look = [&](const Numbers& first) {
    const Numbers at = refine(fine, before, refine(coarse, before, first));
    return HeadSight{pose_of(at), likeness_at(fine, solid_of(at))};
  };
  HeadSight sight = look(before);
  if (sight.likeness >= sure) return sight;
  constexpr double other_turn = 0.2;  // rad
  std::vector<Numbers> others = {search(coarse, before, 5)};
  for (const int axis : {0, 1})
    for (const double sign : {-1.0, 1.0}) {
      others.push_back(before);
      others.back()[axis] += sign * other_turn;
    }
  for (const Numbers& first : others) {
    const HeadSight other = look(first);
    if (other.likeness > sight.likeness) sight = other;
  }
  return sight;
}

Matrix head_numbers(const HeadSight& sight) {
  const std::array<double, 6> pose = pose_numbers(sight.pose);
  Matrix head{7, 1, {pose.begin(), pose.end()}};
  head.values.push_back(sight.likeness);
  return head;
}

HeadSight head_sight(const Matrix& head) {
  check(head.rows == 7 && head.columns == 1 && head.values.size() == 7, "head is ", head.rows, " x ", head.columns,
        head.values.size() == head.rows * head.columns ? "" : " with another number of values",
        ", expected 7 x 1 as track.klt gives it");
  for (const double number : head.values)
    check(std::isfinite(number), "head has ", number, ", expected finite numbers");
  std::array<double, 6> pose;
  std::copy_n(head.values.begin(), pose.size(), pose.begin());
  return {pose_of(pose), head.values.back()};
}

HeadPose start_pose(const Landmarks& start) {
  const RasterFrame frame = raster_frame(start);
  return {0, 0, 0, 0, frame.middle.real(), frame.middle.imag()};
}

SolidHead head_at(const HeadPose& pose, const Landmarks& start) {
  const RasterFrame frame = raster_frame(start);
  return solid_head(pose, {frame.middle.real(), frame.middle.imag(), 0});
}

}  // namespace face::track
