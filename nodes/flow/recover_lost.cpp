// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/recover_lost.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "nodes/flow/match_labels.h"

namespace face::flow {
namespace {

constexpr int fewest = 20;         // lost pixels that are looked for
constexpr double most_left = 0.7;  // of the pixels that differ about them, where what is found counts
constexpr int context_px = 24;     // of the target about them
constexpr int reach_y_px = 24;     // from the start
constexpr int reach_x_px = 10;     // lids, lips and jaws move up and down
constexpr int near_px = 12;        // the flow changes only so near to what was lost
constexpr float jump_px = 3;       // neighbours' displacements further apart are an edge
constexpr float same_px = 2;       // smaller changes are the flow's to know better
constexpr float hidden_px = 4;     // half a target pixel over more reference pixels: they are hidden
constexpr float smoothed_bend_px = 1;

float between(const Plane& plane, float x, float y) {
  x = std::clamp(x, 0.0f, static_cast<float>(plane.width - 1) - 0.001f);
  y = std::clamp(y, 0.0f, static_cast<float>(plane.height - 1) - 0.001f);
  const int ix = static_cast<int>(x), iy = static_cast<int>(y);
  const float fx = x - static_cast<float>(ix), fy = y - static_cast<float>(iy);
  const float *a = plane.row(iy) + ix, *b = plane.row(iy + 1) + ix;
  const float above = a[0] + fx * (a[1] - a[0]), below = b[0] + fx * (b[1] - b[0]);
  return above + fy * (below - above);
}

Plane cut(const Plane& plane, const PixelBox& box) {
  Plane out(box.right - box.left + 1, box.bottom - box.top + 1);
  for (int y = 0; y < out.height; ++y)
    std::copy(plane.row(box.top + y) + box.left, plane.row(box.top + y) + box.right + 1, out.row(y));
  return out;
}

Level cut(const Level& level, const PixelBox& box) {
  Level out;
  for (const Plane& plane : level.channels) out.channels.push_back(cut(plane, box));
  out.share = cut(level.share, box);
  return out;
}

// 255 where a channel that tells differs by more than a mismatch from where the field says.
cv::Mat mismatched(const Level& a, const Level& b, const RecoverLostOptions& options, const Plane& u, const Plane& v) {
  Level warped;
  warp(b, u, v, warped);
  cv::Mat out(a.share.height, a.share.width, CV_8U, cv::Scalar(0));
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    if (!options.tells[c]) continue;
    for (int y = 0; y < out.rows; ++y) {
      const float *here = a.channels[c].row(y), *there = warped.channels[c].row(y);
      const float *seen = a.share.row(y), *found = warped.share.row(y);
      auto* wrong = out.ptr<std::uint8_t>(y);
      for (int x = 0; x < out.cols; ++x)
        if (seen[x] * found[x] > 0 && std::fabs(here[x] - there[x]) > options.mismatches[c]) wrong[x] = 255;
    }
  }
  return out;
}

cv::Mat grown(const cv::Mat& mask, int radius_px) {
  cv::Mat out;
  cv::dilate(mask, out, cv::Mat::ones(2 * radius_px + 1, 2 * radius_px + 1, CV_8U));
  return out;
}

// A part of both pictures, in which one group of lost pixels is found again.
class Region {
 public:
  // box: of the whole picture, its corner on even pixels; search: the target's part that is looked for, in the box.
  Region(const std::vector<Level>& reference, const std::vector<Level>& target, const RecoverLostOptions& options,
         const PixelBox& box, const PixelBox& search)
      : options_(options), search_(search) {
    const PixelBox half{box.left / 2, box.top / 2, box.right / 2, box.bottom / 2};
    for (std::size_t l = 0; l < 2; ++l) {
      a_.push_back(cut(reference[l], l == 0 ? box : half));
      b_.push_back(cut(target[l], l == 0 ? box : half));
    }
    match_.weights = options.dense.weights;
    match_.caps = options.mismatches;
  }

  // The target's displacements into the reference, about a start.
  void look(Plane& u, Plane& v) {
    match_.reach_x_px = reach_x_px / 2;
    match_.reach_y_px = reach_y_px / 2;
    const PixelBox half{search_.left / 2, search_.top / 2, std::min((search_.right + 1) / 2, b_[1].share.width - 1),
                        std::min((search_.bottom + 1) / 2, b_[1].share.height - 1)};
    Plane half_u = coarser(u, 0.5f), half_v = coarser(v, 0.5f);
    match_labels(b_[1], a_[1], half, match_, half_u, half_v);
    // On the finest level every pixel takes the best of the four displacements about it.
    for (int y = search_.top; y <= search_.bottom; ++y)
      for (int x = search_.left; x <= search_.right; ++x) {
        float least = 1e30f;
        for (int dy = 0; dy <= 1; ++dy)
          for (int dx = 0; dx <= 1; ++dx) {
            const int hx = std::clamp(x / 2 + (x % 2 ? dx : -dx), half.left, half.right);
            const int hy = std::clamp(y / 2 + (y % 2 ? dy : -dy), half.top, half.bottom);
            const float to_x = 2 * half_u.row(hy)[hx], to_y = 2 * half_v.row(hy)[hx];
            float cost = 0.3f * static_cast<float>(dx + dy);
            for (int wy = -1; wy <= 1; ++wy)
              for (int wx = -1; wx <= 1; ++wx)
                cost += match_cost(b_[0], a_[0], match_, x + wx, y + wy, x + wx + static_cast<int>(to_x),
                                   y + wy + static_cast<int>(to_y));
            if (cost >= least) continue;
            least = cost;
            u.row(y)[x] = to_x;
            v.row(y)[x] = to_y;
          }
      }
    smooth(u, v);
    for (int pass = 0; pass < 2; ++pass) sharpen(u, v);
  }

  // How many pixels of the target look different at the place found.
  int unmatched(const Plane& u, const Plane& v) const {
    const cv::Mat wrong = mismatched(b_[0], a_[0], options_, u, v);
    return cv::countNonZero(
        wrong(cv::Rect(search_.left, search_.top, search_.right - search_.left + 1, search_.bottom - search_.top + 1)));
  }

  // The field turned round; known: 255 where it says something.
  void turn_round(const Plane& u, const Plane& v, Plane& forward_u, Plane& forward_v, cv::Mat& known) const {
    forward_u = forward_v = Plane(u.width, u.height);
    known = cv::Mat(u.height, u.width, CV_8U, cv::Scalar(0));
    Plane size(u.width, u.height, 1e30f);
    for (int y = search_.top; y < search_.bottom; ++y)
      for (int x = search_.left; x < search_.right; ++x) {
        lay({{{x, y}, {x + 1, y}, {x, y + 1}}}, u, v, forward_u, forward_v, known, size);
        lay({{{x + 1, y}, {x + 1, y + 1}, {x, y + 1}}}, u, v, forward_u, forward_v, known, size);
      }
  }

 private:
  void smooth(Plane& u, Plane& v) const {
    std::vector<Level> picture = {b_[0]}, other = {a_[0]};
    for (int y = 0; y < u.height; ++y)
      for (int x = 0; x < u.width; ++x)
        if (x < search_.left || x > search_.right || y < search_.top || y > search_.bottom)
          picture[0].share.row(y)[x] = 0;
    DenseFlowOptions dense = options_.dense;
    dense.search = false;
    dense.first_looseness = 1;
    dense.bend_px = smoothed_bend_px;
    dense_flow(picture, other, dense, u, v);
  }

  // Beside a jump every pixel takes the displacement among those about it with which it looks best.
  void sharpen(Plane& u, Plane& v) const {
    const Plane old_u = u, old_v = v;
    for (int y = search_.top + 2; y <= search_.bottom - 2; ++y)
      for (int x = search_.left + 2; x <= search_.right - 2; ++x) {
        if (spread(old_u, x, y) < jump_px && spread(old_v, x, y) < jump_px) continue;
        float least = 1e30f;
        for (int dy = -2; dy <= 2; ++dy)
          for (int dx = -2; dx <= 2; ++dx) {
            const float to_x = old_u.row(y + dy)[x + dx], to_y = old_v.row(y + dy)[x + dx];
            const float cost = 0.05f * static_cast<float>(dx * dx + dy * dy) + misfit(x, y, to_x, to_y);
            if (cost >= least) continue;
            least = cost;
            u.row(y)[x] = to_x;
            v.row(y)[x] = to_y;
          }
      }
  }

  static float spread(const Plane& plane, int x, int y) {
    float low = plane.row(y)[x], high = low;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        low = std::min(low, plane.row(y + dy)[x + dx]);
        high = std::max(high, plane.row(y + dy)[x + dx]);
      }
    return high - low;
  }

  // Of the pixel, and a tenth of those about it.
  float misfit(int x, int y, float to_x, float to_y) const {
    float sum = 0;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        for (std::size_t c = 0; c < match_.weights.size(); ++c) {
          const float there =
              between(a_[0].channels[c], static_cast<float>(x + dx) + to_x, static_cast<float>(y + dy) + to_y);
          const float difference = std::min(std::fabs(b_[0].channels[c].row(y + dy)[x + dx] - there), match_.caps[c]);
          sum += (dx == 0 && dy == 0 ? 1.0f : 0.1f) * std::sqrt(match_.weights[c]) * difference;
        }
    return sum;
  }

  // A triangle of the target, given by its pixels, laid on the reference; where several lie the smallest counts.
  static void lay(const std::array<std::array<int, 2>, 3>& corners, const Plane& u, const Plane& v, Plane& forward_u,
                  Plane& forward_v, cv::Mat& known, Plane& size) {
    std::array<float, 3> px, py;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [x, y] = corners[i];
      px[i] = static_cast<float>(x) + u.row(y)[x];
      py[i] = static_cast<float>(y) + v.row(y)[x];
    }
    const float area = (px[1] - px[0]) * (py[2] - py[0]) - (px[2] - px[0]) * (py[1] - py[0]);
    if (!(area > 1e-6f)) return;  // folded
    const int left = std::max(0, static_cast<int>(std::ceil(std::min({px[0], px[1], px[2]}))));
    const int right = std::min(u.width - 1, static_cast<int>(std::floor(std::max({px[0], px[1], px[2]}))));
    const int top = std::max(0, static_cast<int>(std::ceil(std::min({py[0], py[1], py[2]}))));
    const int bottom = std::min(u.height - 1, static_cast<int>(std::floor(std::max({py[0], py[1], py[2]}))));
    for (int y = top; y <= bottom; ++y)
      for (int x = left; x <= right; ++x) {
        const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
        std::array<float, 3> w;
        w[0] = ((px[1] - fx) * (py[2] - fy) - (px[2] - fx) * (py[1] - fy)) / area;
        w[1] = ((px[2] - fx) * (py[0] - fy) - (px[0] - fx) * (py[2] - fy)) / area;
        w[2] = 1 - w[0] - w[1];
        if (std::min({w[0], w[1], w[2]}) < -1e-4f || area >= size.row(y)[x]) continue;
        if (area > hidden_px) w = {1.0f / 3, 1.0f / 3, 1.0f / 3};
        size.row(y)[x] = area;
        known.at<std::uint8_t>(y, x) = 255;
        float to_x = 0, to_y = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          to_x += w[i] * static_cast<float>(corners[i][0]);
          to_y += w[i] * static_cast<float>(corners[i][1]);
        }
        forward_u.row(y)[x] = to_x - fx;
        forward_v.row(y)[x] = to_y - fy;
      }
  }

  const RecoverLostOptions& options_;
  PixelBox search_;
  std::vector<Level> a_, b_;
  MatchLabelsOptions match_;
};

}  // namespace

void recover_lost(const std::vector<Level>& reference, const std::vector<Level>& target,
                  const RecoverLostOptions& options, const Plane& start_u, const Plane& start_v, Plane& u, Plane& v) {
  if (reference.size() < 2) return;
  const int width = u.width, height = u.height;
  cv::Mat lost, groups, statistics, centres;
  const cv::Mat wrong = mismatched(reference[0], target[0], options, u, v);
  cv::boxFilter(wrong, lost, CV_32F, {7, 7});
  lost = lost > 127.5;
  const int count = cv::connectedComponentsWithStats(grown(lost, 4), groups, statistics, centres);
  for (int group = 1; group < count; ++group) {
    const cv::Mat mine = (groups == group) & lost;
    const int pixels = cv::countNonZero(mine);
    if (pixels < fewest) continue;
    // What of the target is looked for, and the part of both pictures that this takes.
    PixelBox search{width, height, -1, -1};
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        if (!mine.at<std::uint8_t>(y, x)) continue;
        const int to_x = x + static_cast<int>(start_u.row(y)[x]), to_y = y + static_cast<int>(start_v.row(y)[x]);
        search = {std::min(search.left, to_x), std::min(search.top, to_y), std::max(search.right, to_x),
                  std::max(search.bottom, to_y)};
      }
    const auto about = [&](const PixelBox& box, int margin) {
      return PixelBox{std::max(box.left - margin, 0) / 2 * 2, std::max(box.top - margin, 0) / 2 * 2,
                      std::min(box.right + margin, width - 1), std::min(box.bottom + margin, height - 1)};
    };
    search = about(search, context_px);
    const PixelBox box = about(search, reach_y_px + 4);
    if (search.right - search.left < 8 || search.bottom - search.top < 8) continue;
    Region region(reference, target, options, box,
                  {search.left - box.left, search.top - box.top, search.right - box.left, search.bottom - box.top});
    // From target to reference, as far as the start knows.
    Plane back_u(box.right - box.left + 1, box.bottom - box.top + 1), back_v = back_u, forward_u, forward_v;
    for (int y = 0; y < back_u.height; ++y)
      for (int x = 0; x < back_u.width; ++x) {
        const float from_x = static_cast<float>(box.left + x) - start_u.row(box.top + y)[box.left + x];
        const float from_y = static_cast<float>(box.top + y) - start_v.row(box.top + y)[box.left + x];
        back_u.row(y)[x] = -between(start_u, from_x, from_y);
        back_v.row(y)[x] = -between(start_v, from_x, from_y);
      }
    region.look(back_u, back_v);
    const int before = cv::countNonZero(
        wrong(cv::Rect(search.left, search.top, search.right - search.left + 1, search.bottom - search.top + 1)));
    if (region.unmatched(back_u, back_v) > most_left * before) continue;
    cv::Mat known, parts;
    region.turn_round(back_u, back_v, forward_u, forward_v, known);
    // What differs, and hangs together with what was lost.
    cv::Mat differs(back_u.height, back_u.width, CV_8U, cv::Scalar(0));
    for (int y = 0; y < back_u.height; ++y)
      for (int x = 0; x < back_u.width; ++x) {
        const float du = forward_u.row(y)[x] - u.row(box.top + y)[box.left + x];
        const float dv = forward_v.row(y)[x] - v.row(box.top + y)[box.left + x];
        if (known.at<std::uint8_t>(y, x) && std::hypot(du, dv) > same_px) differs.at<std::uint8_t>(y, x) = 255;
      }
    const cv::Mat here = mine(cv::Rect(box.left, box.top, back_u.width, back_u.height));
    std::vector<bool> taken(
        static_cast<std::size_t>(cv::connectedComponents(grown(differs, 1) & grown(here, near_px), parts)), false);
    for (int y = 0; y < back_u.height; ++y)
      for (int x = 0; x < back_u.width; ++x)
        if (here.at<std::uint8_t>(y, x)) taken[static_cast<std::size_t>(parts.at<int>(y, x))] = true;
    taken[0] = false;
    for (int y = 0; y < back_u.height; ++y)
      for (int x = 0; x < back_u.width; ++x) {
        if (!known.at<std::uint8_t>(y, x) || !taken[static_cast<std::size_t>(parts.at<int>(y, x))]) continue;
        u.row(box.top + y)[box.left + x] = forward_u.row(y)[x];
        v.row(box.top + y)[box.left + x] = forward_v.row(y)[x];
      }
  }
}

}  // namespace face::flow
