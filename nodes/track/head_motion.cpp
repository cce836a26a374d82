// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/head_motion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "nodes/base/find_landmark.h"

namespace face::track {
namespace {

using Place = std::complex<double>;
using Numbers = Eigen::Matrix<double, 6, 1>;

// The raster, in distances of the inner corners of the eyes from the middle between them: x to the right in the
// picture, y down.
constexpr int columns = 49, rows = 35;
constexpr double left = -1.6, top = -0.9, step = 3.2 / (columns - 1);

// How far a face stands out before the inner corners of the eyes, in their distance: the neutral head of ICT-FaceKit
// (Li et al., Learning Formation of Physically-Based Face Attributes, CVPR 2020), at 0, 0.2, ... 1.6 to the side, rows
// from 0.9 above the eyes to 1.35 below, 0.15 apart.
constexpr std::size_t depth_columns = 9, depth_rows = 16;
constexpr double depth_left_step = 0.2, depth_top = -0.9, depth_row_step = 0.15;
constexpr std::array<std::array<double, depth_columns>, depth_rows> depths = {{
    {0.39, 0.40, 0.38, 0.34, 0.26, 0.14, -0.01, -0.20, -0.48},  // forehead
    {0.42, 0.42, 0.40, 0.37, 0.32, 0.23, 0.08, -0.11, -0.42},
    {0.42, 0.41, 0.41, 0.36, 0.30, 0.23, 0.14, -0.04, -0.42},
    {0.40, 0.38, 0.32, 0.29, 0.20, 0.17, 0.09, -0.05, -0.34},
    {0.38, 0.32, 0.21, 0.15, 0.13, 0.12, 0.02, -0.10, -0.36},
    {0.40, 0.32, 0.09, 0.08, 0.08, 0.06, 0.00, -0.20, -0.41},
    {0.50, 0.31, 0.08, 0.08, 0.08, 0.04, -0.08, -0.28, -0.49},  // eyes
    {0.60, 0.45, 0.12, 0.07, 0.09, 0.07, -0.04, -0.23, -0.44},
    {0.71, 0.58, 0.25, 0.11, 0.08, 0.04, -0.05, -0.16, -0.34},
    {0.87, 0.72, 0.40, 0.16, 0.11, 0.04, -0.04, -0.13, -0.33},
    {0.96, 0.87, 0.42, 0.23, 0.16, 0.09, 0.03, -0.05, -0.28},
    {1.03, 0.96, 0.68, 0.27, 0.19, 0.13, 0.07, -0.06, -0.23},  // tip of the nose
    {1.04, 0.97, 0.74, 0.28, 0.22, 0.17, 0.08, -0.07, -0.28},
    {0.90, 0.56, 0.56, 0.28, 0.23, 0.19, 0.10, -0.07, -0.33},
    {0.65, 0.57, 0.41, 0.35, 0.26, 0.18, 0.05, -0.07, -0.47},
    {0.63, 0.63, 0.50, 0.36, 0.28, 0.19, 0.07, -0.20, -0.50},  // upper lip
}};
constexpr double tip_below = 0.77;  // of the same head: how far its tip of the nose is below the eyes

double depth_at(double x, double y) {
  const double u = std::clamp(std::abs(x) / depth_left_step, 0.0, depth_columns - 1.001);
  const double v = std::clamp((y - depth_top) / depth_row_step, 0.0, depth_rows - 1.001);
  const auto i = static_cast<std::size_t>(u), j = static_cast<std::size_t>(v);
  const double p = u - std::floor(u), q = v - std::floor(v);
  return (1 - q) * ((1 - p) * depths[j][i] + p * depths[j][i + 1]) +
         q * ((1 - p) * depths[j + 1][i] + p * depths[j + 1][i + 1]);
}

// Cheeks below the outer corners of the eyes move when one smiles, the hair hangs over temples, and lids and eyes move
// by themselves.
bool is_solid(double x, double y) {
  constexpr double eye_x = 0.87, eye_y = -0.04, half_width = 0.45, half_height = 0.28;
  if (std::hypot((std::abs(x) - eye_x) / half_width, (y - eye_y) / half_height) < 1) return false;
  const double low = std::max(0.0, y - 0.3), high = std::max(0.0, -0.5 - y);
  return std::abs(x) + 0.75 * low + 0.8 * high <= 1.6;
}

// Where the start has the raster.
struct Frame {
  Place middle, across;  // of the inner corners of the eyes; from the one on the left to the other, px
  double stretch = 1;    // of what is below the eyes: noses differ in length
  bool valid = false;
};

Frame frame_of(const Landmarks& start) {
  const Landmark* right = find_landmark(start, "eye_inner_r");
  const Landmark* left_eye = find_landmark(start, "eye_inner_l");
  const Landmark* tip = find_landmark(start, "nose_tip");
  if (right == nullptr || left_eye == nullptr || tip == nullptr) return {};
  const Place a(right->x_px, right->y_px), b(left_eye->x_px, left_eye->y_px), middle = (a + b) / 2.0;
  constexpr double least_px = 4;
  if (std::abs(b - a) < least_px) return {};
  const double below = ((Place(tip->x_px, tip->y_px) - middle) / (b - a)).imag();
  return {middle, b - a, std::clamp(below / tip_below, 0.8, 1.3), true};
}

// A place of the raster at rest, px: of the start's picture, and towards the viewer.
struct Knot {
  std::size_t index = 0;  // in the raster
  Eigen::Vector3d place;
};

std::vector<Knot> knots_of(const Frame& frame, int stride) {
  std::vector<Knot> knots;
  for (int row = 0; row < rows; row += stride)
    for (int column = 0; column < columns; column += stride) {
      const double x = left + step * column, y = top + step * row;
      const Place at = frame.across * Place(x, y);
      knots.push_back({static_cast<std::size_t>(row * columns + column),
                       {at.real(), at.imag(), depth_at(x, y > 0 ? y / frame.stretch : y) * std::abs(frame.across)}});
    }
  return knots;
}

// Each pixel the mean of `times` x `times`.
Grey reduced(const Grey& grey, int times) {
  if (times <= 1) return grey;
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
  Grey grey;
  int times = 1;
  double at(Place place) const {
    const double shift = (times - 1) / 2.0;
    return static_cast<double>(grey.at((place.real() - shift) / times, (place.imag() - shift) / times));
  }
  double unit() const { return times; }
};

Level level_of(const Grey& grey, double step_px) {
  const int times = std::max(1, static_cast<int>(std::lround(step_px)));
  return {reduced(grey, times), times};
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
  std::vector<bool> solid;
};

Scale scale_of(const Grey& grey, const Frame& frame, const Image& learnt, int stride) {
  Scale scale;
  scale.level = level_of(grey, stride * step * std::abs(frame.across));
  scale.knots = knots_of(frame, stride);
  scale.width = (columns + stride - 1) / stride;
  scale.reach = std::max(2, 6 / stride);
  std::vector<double> values(learnt.pixels.begin(), learnt.pixels.end());
  if (stride > 1) values = local_means(values, columns, stride / 2);
  std::vector<double> taken;
  for (const Knot& knot : scale.knots) {
    taken.push_back(values[knot.index]);
    const int row = static_cast<int>(knot.index) / columns, column = static_cast<int>(knot.index) % columns;
    scale.solid.push_back(is_solid(left + step * column, top + step * row));
  }
  scale.wanted = normalised(taken, scale.width, scale.reach, nullptr);
  return scale;
}

Numbers numbers_of(const HeadPose& pose) {
  Numbers numbers;
  numbers << pose.nod, pose.turn, pose.tilt, pose.log_scale, pose.x_px, pose.y_px;
  return numbers;
}

HeadPose pose_of(const Numbers& n) { return {n[0], n[1], n[2], n[3], n[4], n[5]}; }

// The solid's origin is the middle between the eyes: knots are counted from there.
SolidHead solid_of(const Numbers& numbers) { return solid_head(pose_of(numbers), {0, 0, 0}); }

Place seen(const SolidHead& head, const Knot& knot) {
  return head.seen({knot.place.x(), knot.place.y()}, knot.place.z());
}

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
    if (!scale.solid[i]) continue;
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
      if (!scale.solid[i]) continue;
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
    const double far_px = std::abs(scale.knots.back().place.x()) + scale.level.unit();
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
  const Frame frame = frame_of(start);
  if (!frame.valid) return {0, 0, 1, {}};
  const Level level = level_of(grey, step * std::abs(frame.across));
  Image learnt{columns, rows, 1, {}};
  for (const Knot& knot : knots_of(frame, 1))
    learnt.pixels.push_back(static_cast<std::uint8_t>(
        std::lround(std::clamp(level.at(frame.middle + Place(knot.place.x(), knot.place.y())), 0.0, 255.0))));
  return learnt;
}

HeadSight find_head(const Grey& grey, const Landmarks& start, const Image& learnt, const HeadPose& from) {
  const Frame frame = frame_of(start);
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

HeadPose start_pose(const Landmarks& start) {
  const Frame frame = frame_of(start);
  return {0, 0, 0, 0, frame.middle.real(), frame.middle.imag()};
}

SolidHead head_at(const HeadPose& pose, const Landmarks& start) {
  const Frame frame = frame_of(start);
  return solid_head(pose, {frame.middle.real(), frame.middle.imag(), 0});
}

}  // namespace face::track
