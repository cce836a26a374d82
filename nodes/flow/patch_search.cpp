// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/patch_search.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace face::flow {
namespace {

constexpr int side = 8;
constexpr int area = side * side;
constexpr float unseen = 1e30f;  // cost where a patch is not seen
using Patch = std::array<float, area>;

struct Found {
  float u = 0, v = 0;
  float cost = unseen;  // mean weighted squared difference; 1e30 = not seen
};

class Search {
 public:
  Search(const Level& reference, const Level& target, const PatchSearchOptions& options)
      : a_(reference), b_(target), options_(options), width_(reference.share.width), height_(reference.share.height) {
    // 1 where the pixel and those right of it and below it are measured: between them can be interpolated.
    solid_ = Plane(width_, height_);
    for (int y = 0; y + 1 < height_; ++y)
      for (int x = 0; x + 1 < width_; ++x) {
        const float *here = target.share.row(y) + x, *below = target.share.row(y + 1) + x;
        solid_.row(y)[x] = here[0] * here[1] * below[0] * below[1];
      }
  }

  // Prepares the patch whose top left pixel is given; false where less than half of it is measured.
  bool take(int x, int y) {
    x_ = x;
    y_ = y;
    count_ = 0;
    for (int r = 0; r < side; ++r)
      for (int c = 0; c < side; ++c) count_ += mask_[index(r, c)] = a_.share.row(y + r)[x + c];
    if (count_ < area / 2) return false;
    const std::size_t channels = a_.channels.size();
    values_.resize(channels);
    gx_.resize(channels);
    gy_.resize(channels);
    xx_ = xy_ = yy_ = 0;
    for (std::size_t k = 0; k < channels; ++k) {
      const Plane& plane = a_.channels[k];
      float mean_x = 0, mean_y = 0;
      for (int r = 0; r < side; ++r)
        for (int c = 0; c < side; ++c) {
          const std::size_t i = index(r, c);
          values_[k][i] = plane.row(y + r)[x + c];
          gx_[k][i] = gradient(plane, x + c, y + r, 1, 0) * mask_[i];
          gy_[k][i] = gradient(plane, x + c, y + r, 0, 1) * mask_[i];
          mean_x += gx_[k][i];
          mean_y += gy_[k][i];
        }
      mean_x /= count_;
      mean_y /= count_;
      for (std::size_t i = 0; i < area; ++i) {
        gx_[k][i] = mask_[i] * (gx_[k][i] - mean_x);
        gy_[k][i] = mask_[i] * (gy_[k][i] - mean_y);
        xx_ += options_.weights[k] * gx_[k][i] * gx_[k][i];
        xy_ += options_.weights[k] * gx_[k][i] * gy_[k][i];
        yy_ += options_.weights[k] * gy_[k][i] * gy_[k][i];
      }
    }
    // Little contrast: small steps.
    const float damping = 1e-3f * (xx_ + yy_) + 1e-3f * count_;
    xx_ += damping;
    yy_ += damping;
    return true;
  }

  // Cost at a displacement, and the step that would lower it.
  Found look(float u, float v, float& step_u, float& step_v) {
    Found found{u, v, unseen};
    const float px = static_cast<float>(x_) + u, py = static_cast<float>(y_) + v;
    if (!(px >= 0 && py >= 0 && px < static_cast<float>(width_ - side) && py < static_cast<float>(height_ - side)))
      return found;
    const int ix = static_cast<int>(px), iy = static_cast<int>(py);
    const float fx = px - static_cast<float>(ix), fy = py - static_cast<float>(iy);
    float count = 0;
    Patch both;
    for (int r = 0; r < side; ++r)
      for (int c = 0; c < side; ++c) count += both[index(r, c)] = mask_[index(r, c)] * solid_.row(iy + r)[ix + c];
    if (count < 0.6f * count_) return found;
    float cost = 0, bx = 0, by = 0;
    for (std::size_t k = 0; k < values_.size(); ++k) {
      Patch d;
      float sum = 0;
      for (int r = 0; r < side; ++r) {
        const float *p = b_.channels[k].row(iy + r) + ix, *q = b_.channels[k].row(iy + r + 1) + ix;
        const std::size_t n = index(r, 0);
        for (std::size_t c = 0; c < side; ++c) {
          const float above = p[c] + fx * (p[c + 1] - p[c]), below = q[c] + fx * (q[c + 1] - q[c]);
          d[n + c] = both[n + c] * (above + fy * (below - above) - values_[k][n + c]);
        }
      }
      for (std::size_t i = 0; i < area; ++i) sum += d[i];
      const float mean = sum / count;
      float square = 0, sx = 0, sy = 0;
      for (std::size_t i = 0; i < area; ++i) {
        const float e = both[i] * (d[i] - mean);
        square += e * e;
        sx += e * gx_[k][i];
        sy += e * gy_[k][i];
      }
      cost += options_.weights[k] * square;
      bx += options_.weights[k] * sx;
      by += options_.weights[k] * sy;
    }
    found.cost = cost / count;
    const float determinant = xx_ * yy_ - xy_ * xy_;
    step_u = -(yy_ * bx - xy_ * by) / determinant;
    step_v = -(xx_ * by - xy_ * bx) / determinant;
    return found;
  }

  // Steps downhill from a start; keeps the best place seen.
  void descend(float u, float v, Found& best) {
    float step_u = 0, step_v = 0;
    const float start_u = u, start_v = v;
    for (int i = 0; i <= options_.iterations; ++i) {
      const Found found = look(u, v, step_u, step_v);
      if (found.cost >= unseen) return;
      if (found.cost < best.cost)
        best = found;
      else if (i > 2)
        return;
      u += step_u;
      v += step_v;
      if (std::fabs(step_u) + std::fabs(step_v) < 0.02f) return;
      if (std::fabs(u - start_u) > side || std::fabs(v - start_v) > side) return;
    }
  }

  // Adds the patch to the sums of the field, every pixel as it fits there.
  void spread(const Found& found, Plane& u, Plane& v, Plane& weight) const {
    const float px = static_cast<float>(x_) + found.u, py = static_cast<float>(y_) + found.v;
    const int ix = static_cast<int>(px), iy = static_cast<int>(py);
    const float fx = px - static_cast<float>(ix), fy = py - static_cast<float>(iy);
    Patch misfit{};
    for (std::size_t k = 0; k < values_.size(); ++k) {
      Patch d;
      float sum = 0;
      for (int r = 0; r < side; ++r) {
        const float *p = b_.channels[k].row(iy + r) + ix, *q = b_.channels[k].row(iy + r + 1) + ix;
        for (int c = 0; c < side; ++c) {
          const float above = p[c] + fx * (p[c + 1] - p[c]), below = q[c] + fx * (q[c + 1] - q[c]);
          const std::size_t i = index(r, c);
          d[i] = mask_[i] * (above + fy * (below - above) - values_[k][i]);
          sum += d[i];
        }
      }
      for (std::size_t i = 0; i < area; ++i) {
        const float e = d[i] - sum / count_;
        misfit[i] += options_.weights[k] * e * e;
      }
    }
    for (int r = 0; r < side; ++r)
      for (int c = 0; c < side; ++c) {
        const float w = 1 / std::sqrt(std::max(misfit[index(r, c)], 0.1f)) / std::sqrt(std::max(found.cost, 0.1f));
        u.row(y_ + r)[x_ + c] += w * found.u;
        v.row(y_ + r)[x_ + c] += w * found.v;
        weight.row(y_ + r)[x_ + c] += w;
      }
  }

 private:
  static std::size_t index(int r, int c) { return static_cast<std::size_t>(r * side + c); }
  float gradient(const Plane& plane, int x, int y, int dx, int dy) const {
    const int x0 = std::max(x - dx, 0), x1 = std::min(x + dx, width_ - 1), y0 = std::max(y - dy, 0),
              y1 = std::min(y + dy, height_ - 1);
    if (a_.share.row(y0)[x0] * a_.share.row(y1)[x1] == 0) return 0;
    return 0.5f * (plane.row(y1)[x1] - plane.row(y0)[x0]);
  }

  const Level &a_, &b_;
  const PatchSearchOptions& options_;
  int width_, height_, x_ = 0, y_ = 0;
  Plane solid_;
  Patch mask_{};
  std::vector<Patch> values_, gx_, gy_;
  float count_ = 0, xx_ = 0, xy_ = 0, yy_ = 0;
};

// Positions of patches along a side: every stride pixels, and one at the end.
std::vector<int> positions(int length, int stride) {
  std::vector<int> out;
  for (int at = 0; at + side <= length; at += stride) out.push_back(at);
  if (!out.empty() && out.back() + side < length) out.push_back(length - side);
  return out;
}

}  // namespace

void search_patches(const Level& reference, const Level& target, const PatchSearchOptions& options, const Plane& also_u,
                    const Plane& also_v, Plane& u, Plane& v) {
  const std::vector<int> xs = positions(u.width, options.stride_px), ys = positions(u.height, options.stride_px);
  const std::size_t columns = xs.size(), rows = ys.size();
  std::vector<Found> found(columns * rows);
  Search search(reference, target, options);
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t n = 0; n < found.size(); ++n) {
      const std::size_t i = pass == 0 ? n : found.size() - 1 - n, column = i % columns, row = i / columns;
      const int x = xs[column], y = ys[row];
      if (!search.take(x, y)) continue;
      Found& best = found[i];
      const auto from = [&](const Found& other) {
        float ignored_u = 0, ignored_v = 0;
        if (other.cost >= unseen || search.look(other.u, other.v, ignored_u, ignored_v).cost >= best.cost) return;
        search.descend(other.u, other.v, best);
      };
      if (pass == 0) {
        const int mx = x + side / 2, my = y + side / 2;
        search.descend(u.row(my)[mx], v.row(my)[mx], best);
        from({also_u.row(my)[mx], also_v.row(my)[mx], 0});
        if (column > 0) from(found[i - 1]);
        if (row > 0) from(found[i - columns]);
      } else {
        if (column + 1 < columns) from(found[i + 1]);
        if (row + 1 < rows) from(found[i + columns]);
      }
    }
  Plane sum_u(u.width, u.height), sum_v = sum_u, weight = sum_u;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i].cost < unseen && search.take(xs[i % columns], ys[i / columns]))
      search.spread(found[i], sum_u, sum_v, weight);
  for (std::size_t i = 0; i < u.values.size(); ++i) {
    if (weight.values[i] == 0) continue;
    u.values[i] = sum_u.values[i] / weight.values[i];
    v.values[i] = sum_v.values[i] / weight.values[i];
  }
}

}  // namespace face::flow
