// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/dense_flow.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "nodes/base/quantile.h"
#include "nodes/flow/patch_search.h"
#include "nodes/flow/relax.h"

namespace face::flow {
namespace {

// Smallest rectangle of the measured pixels.
RelaxArea area_of(const Plane& share) {
  RelaxArea area{share.height, -1, share.width, -1};
  for (int y = 0; y < share.height; ++y)
    for (int x = 0; x < share.width; ++x)
      if (share.row(y)[x] > 0) {
        area.first_row = std::min(area.first_row, y);
        area.last_row = y;
        area.first_column = std::min(area.first_column, x);
        area.last_column = std::max(area.last_column, x);
      }
  return area;
}

void median5(Plane& plane) {
  const cv::Mat source(plane.height, plane.width, CV_32F, plane.values.data());
  cv::Mat out;
  cv::medianBlur(source, out, 5);
  std::copy(out.ptr<float>(), out.ptr<float>() + plane.values.size(), plane.values.begin());
}

// Adds one channel to the tensor and the right side. A pixel counts where it and its four neighbours are measured.
void add_channel(const Plane& reference, const Plane& warped, const Plane& residual, const Plane& seen, float weight,
                 float tolerance, FlowEnergy& energy) {
  const int width = reference.width, height = reference.height;
  const float inverse = tolerance > 0 ? 1 / (tolerance * tolerance) : 0;
  for (int y = 1; y + 1 < height; ++y) {
    const float *a = reference.row(y), *b = warped.row(y), *aa = reference.row(y - 1), *ab = reference.row(y + 1),
                *ba = warped.row(y - 1), *bb = warped.row(y + 1);
    const float *ok = seen.row(y), *dd = residual.row(y);
    float *xx = energy.aa.row(y), *xy = energy.ab.row(y), *yy = energy.bb.row(y), *rx = energy.ra.row(y),
          *ry = energy.rb.row(y);
    for (int x = 1; x + 1 < width; ++x) {
      // Mean of both pictures' gradients: the linearisation is then exact to second order.
      const float gx = 0.25f * ((a[x + 1] - a[x - 1]) + (b[x + 1] - b[x - 1]));
      const float gy = 0.25f * ((ab[x] - aa[x]) + (bb[x] - ba[x]));
      const float d = dd[x], loose = 1 / (1 + d * d * inverse);
      const float w = weight * ok[x] * loose;
      xx[x] += w * gx * gx;
      xy[x] += w * gx * gy;
      yy[x] += w * gy * gy;
      rx[x] -= w * gx * d;
      ry[x] -= w * gy * d;
    }
  }
}

// 1 where the pixel and its four neighbours are measured in both pictures.
Plane seen_by_both(const Plane& a, const Plane& b) {
  Plane seen(a.width, a.height);
  for (int y = 1; y + 1 < a.height; ++y) {
    const float *a0 = a.row(y), *au = a.row(y - 1), *ad = a.row(y + 1), *b0 = b.row(y), *bu = b.row(y - 1),
                *bd = b.row(y + 1);
    float* s = seen.row(y);
    for (int x = 1; x + 1 < a.width; ++x)
      s[x] = a0[x] * a0[x - 1] * a0[x + 1] * au[x] * ad[x] * b0[x] * b0[x - 1] * b0[x + 1] * bu[x] * bd[x];
  }
  return seen;
}

// Difference of the pictures where both are seen, without its mean over a window.
Plane residual_of(const Plane& reference, const Plane& warped, const Plane& seen, int offset_radius_px) {
  Plane residual(reference.width, reference.height);
  for (std::size_t i = 0; i < residual.values.size(); ++i)
    residual.values[i] = seen.values[i] * (warped.values[i] - reference.values[i]);
  if (offset_radius_px > 0) {
    Plane mean = residual, weight = seen;
    box_mean(mean, offset_radius_px);
    box_mean(weight, offset_radius_px);
    for (std::size_t i = 0; i < residual.values.size(); ++i)
      if (seen.values[i] > 0) residual.values[i] -= mean.values[i] / weight.values[i];
  }
  return residual;
}

// From the mean tensor and its right side for a step to those for the place: J w = J w_now + r. With damping the local
// solution is shortened where the smaller eigenvalue is small, and the energy pulls to that.
void about_the_place(const Plane& u, const Plane& v, float damping, FlowEnergy& energy) {
  for (std::size_t i = 0; i < u.values.size(); ++i) {
    const float a = energy.aa.values[i], b = energy.ab.values[i], c = energy.bb.values[i];
    float rx = energy.ra.values[i], ry = energy.rb.values[i];
    if (damping > 0) {
      const float mean = 0.5f * (a + c), half = 0.5f * (a - c);
      const float smaller = std::max(mean - std::sqrt(half * half + b * b), 0.0f);
      const float more = damping * damping / (smaller + damping);
      const float da = a + more, dc = c + more, determinant = da * dc - b * b;
      const float su = (dc * rx - b * ry) / determinant, sv = (da * ry - b * rx) / determinant;
      rx = a * su + b * sv;
      ry = b * su + c * sv;
    }
    energy.ra.values[i] = a * u.values[i] + b * v.values[i] + rx;
    energy.rb.values[i] = b * u.values[i] + c * v.values[i] + ry;
  }
}

// Links hold less where neighbours differ more (Black and Anandan's line process of the Lorentzian).
void set_links(const Plane& u, const Plane& v, float smoothness, float bend_px, FlowEnergy& energy) {
  if (bend_px <= 0) {
    std::fill(energy.right.values.begin(), energy.right.values.end(), smoothness);
    std::fill(energy.down.values.begin(), energy.down.values.end(), smoothness);
    return;
  }
  const float inverse = 1 / (bend_px * bend_px);
  for (int y = 0; y < u.height; ++y) {
    const float *a = u.row(y), *b = v.row(y);
    const float *c = u.row(std::min(y + 1, u.height - 1)), *d = v.row(std::min(y + 1, u.height - 1));
    float *right = energy.right.row(y), *down = energy.down.row(y);
    for (int x = 0; x + 1 < u.width; ++x) {
      const float du = a[x + 1] - a[x], dv = b[x + 1] - b[x];
      right[x] = smoothness / (1 + (du * du + dv * dv) * inverse);
    }
    for (int x = 0; x < u.width; ++x) {
      const float du = c[x] - a[x], dv = d[x] - b[x];
      down[x] = smoothness / (1 + (du * du + dv * dv) * inverse);
    }
  }
}

// Where the reference is not measured (between the lips) what is on one side says little about the other.
void weaken_links(const Plane& share, float factor, FlowEnergy& energy) {
  if (factor == 1) return;
  for (int y = 0; y < share.height; ++y) {
    const float *here = share.row(y), *below = share.row(std::min(y + 1, share.height - 1));
    float *right = energy.right.row(y), *down = energy.down.row(y);
    for (int x = 0; x + 1 < share.width; ++x)
      if (here[x] * here[x + 1] == 0) right[x] *= factor;
    for (int x = 0; x < share.width; ++x)
      if (here[x] * below[x] == 0) down[x] *= factor;
  }
}

}  // namespace

float gradient_scale(const Plane& channel, const Plane& share) {
  std::vector<float> lengths;
  for (int y = 0; y + 1 < channel.height; ++y)
    for (int x = 0; x + 1 < channel.width; ++x) {
      if (share.row(y)[x] * share.row(y)[x + 1] * share.row(y + 1)[x] == 0) continue;
      const float here = channel.row(y)[x];
      const float length = std::hypot(channel.row(y)[x + 1] - here, channel.row(y + 1)[x] - here);
      if (length > 0) lengths.push_back(length);
    }
  return lengths.empty() ? 1 : median(std::move(lengths));
}

void dense_flow(const std::vector<Level>& reference, const std::vector<Level>& target, const DenseFlowOptions& options,
                Plane& u, Plane& v) {
  const std::size_t count = reference.size();
  std::vector<Plane> start_u = {u}, start_v = {v};
  for (std::size_t l = 1; l < count; ++l) {
    start_u.push_back(coarser(start_u.back(), 0.5f));
    start_v.push_back(coarser(start_v.back(), 0.5f));
  }
  u = start_u.back();
  v = start_v.back();
  for (std::size_t l = count; l-- > 0;) {
    const Level &a = reference[l], &b = target[l];
    const int width = a.share.width, height = a.share.height;
    if (l + 1 < count) {
      // What the coarser levels found, added to the start at its own resolution.
      for (std::size_t i = 0; i < u.values.size(); ++i) {
        u.values[i] -= start_u[l + 1].values[i];
        v.values[i] -= start_v[l + 1].values[i];
      }
      u = finer(u, width, height, 2);
      v = finer(v, width, height, 2);
      for (std::size_t i = 0; i < u.values.size(); ++i) {
        u.values[i] += start_u[l].values[i];
        v.values[i] += start_v[l].values[i];
      }
    }
    const RelaxArea area = area_of(a.share);
    Level warped;
    FlowEnergy energy;
    energy.right = energy.down = Plane(width, height);
    if (options.search && (l > 0 || count == 1)) {
      PatchSearchOptions search;
      search.weights = options.weights;
      search_patches(a, b, search, start_u[l], start_v[l], u, v);
    }
    const int warps = l == 0 ? options.fine_warps : options.coarse_warps;
    for (int k = 0; k < warps; ++k) {
      const float loose =
          warps == 1 ? 1 : std::pow(options.first_looseness, 1 - static_cast<float>(k) / static_cast<float>(warps - 1));
      warp(b, u, v, warped, options.between);
      const Plane seen = seen_by_both(a.share, warped.share);
      energy.aa = energy.ab = energy.bb = energy.ra = energy.rb = Plane(width, height);
      for (std::size_t c = 0; c < a.channels.size(); ++c)
        add_channel(a.channels[c], warped.channels[c],
                    residual_of(a.channels[c], warped.channels[c], seen, options.offset_radius_px), seen,
                    options.weights[c], loose * options.tolerances[c], energy);
      for (Plane* plane : {&energy.aa, &energy.ab, &energy.bb, &energy.ra, &energy.rb})
        box_mean(*plane, options.window_radius_px);
      about_the_place(u, v, options.damping, energy);
      set_links(u, v, options.smoothness, loose * options.bend_px, energy);
      weaken_links(a.share, options.unmeasured_link, energy);
      relax(energy, area, options.sweeps, 1.7f, u, v);
      if (options.median) median5(u), median5(v);
    }
  }
}

}  // namespace face::flow
