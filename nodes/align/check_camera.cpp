// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/check_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "nodes/align/marker_points.h"
#include "nodes/align/orient.h"
#include "nodes/base/check.h"
#include "nodes/base/quantile.h"
#include "nodes/base/scan_points.h"

namespace face::align {
namespace {

using Point = std::array<double, 3>;

constexpr double most_stretch = 2.5;
constexpr double coarse_step = 1.25, fine_step = 1.04;
constexpr double tell_stretch = 1.5, tell_ratio = 1.25;
constexpr double wrong_stretch = 1.15, wrong_ratio = 1.5;
constexpr std::size_t fewest_markers = 6, fewest_frames = 4;

// The markers of a frame that the reference has too, as the camera has them: x right, y up, z to the camera.
struct Pairs {
  std::vector<Point> from, to;
};

Point point_of(const Camera& camera, const MarkerPoint& marker) {
  const double share = marker.depth_mm / static_cast<double>(camera.focal_px);
  return {(marker.x_px - static_cast<double>(camera.centre_x_px)) * share,
          (static_cast<double>(camera.centre_y_px) - marker.y_px) * share, -marker.depth_mm};
}

Point stretched(const Point& p, double x, double y) { return {p[0] * x, p[1] * y, p[2]}; }

double distance(const RigidMotion& m, const Point& from, const Point& to) {
  double square = 0;
  for (std::size_t r = 0; r < 3; ++r) {
    double value = m.translation_mm[r] - to[r];
    for (std::size_t c = 0; c < 3; ++c) value += m.rotation[r * 3 + c] * from[c];
    square += value * value;
  }
  return std::sqrt(square);
}

// The median distance of a frame's markers from the reference's, brought together in the stretched space.
double left_mm(const Pairs& pairs, double x, double y) {
  std::vector<Point> from, to;
  for (std::size_t i = 0; i < pairs.from.size(); ++i) {
    from.push_back(stretched(pairs.from[i], x, y));
    to.push_back(stretched(pairs.to[i], x, y));
  }
  std::vector<double> weights(from.size(), 1), errors(from.size(), 0);
  double usual = 0;
  for (int round = 0; round < 6; ++round) {
    const AbsoluteOrientation found = absolute_orientation(from, to, weights);
    if (!found.solved) return 0;
    for (std::size_t i = 0; i < from.size(); ++i) errors[i] = distance(found.to_from, from[i], to[i]);
    usual = median(errors);
    for (std::size_t i = 0; i < from.size(); ++i) {
      const double e = errors[i] / std::max(2 * usual, 1e-9);
      weights[i] = 1 / ((1 + e * e) * (1 + e * e));
    }
  }
  return usual;
}

double left_mm(const std::vector<Pairs>& frames, double x, double y) {
  double squares = 0;
  for (const Pairs& pairs : frames) squares += std::pow(left_mm(pairs, x, y), 2);
  return std::sqrt(squares / static_cast<double>(frames.size())) / std::cbrt(x * y);
}

double rounded(double value) { return std::round(100 * value) / 100; }

}  // namespace

CheckCameraResult check_camera(const engine::Seq<DepthScan>& scans, const engine::Seq<Landmarks>& markers,
                               const DepthScan& reference, const Landmarks& reference_markers,
                               const CheckCameraOptions& options, engine::Progress& progress) {
  check(scans.size() == markers.size(), "there are ", scans.size(), " scans and ", markers.size(), " sets of markers");
  check_scan(reference, "reference");
  std::vector<MarkerPoint> rigid = marker_points(reference, reference_markers);
  std::stable_sort(rigid.begin(), rigid.end(),
                   [](const MarkerPoint& a, const MarkerPoint& b) { return a.y_px < b.y_px; });
  rigid.resize(static_cast<std::size_t>(std::ceil(options.upper_share * static_cast<double>(rigid.size()))));
  const std::size_t count = std::min(scans.size(), static_cast<std::size_t>(options.frames));
  std::vector<Pairs> frames;
  for (std::size_t k = 0; k < count; ++k) {
    progress.report(static_cast<double>(k) / static_cast<double>(count));
    const std::size_t i = k * scans.size() / count;
    const std::shared_ptr<const DepthScan> scan = scans.at(i);
    check_scan(*scan, "scan");
    Pairs pairs;
    for (const MarkerPoint& here : marker_points(*scan, *markers.at(i)))
      for (const MarkerPoint& there : rigid)
        if (here.name == there.name) {
          pairs.from.push_back(point_of(scan->camera, here));
          pairs.to.push_back(point_of(reference.camera, there));
        }
    if (pairs.from.size() >= fewest_markers) frames.push_back(std::move(pairs));
  }
  CheckCameraResult result;
  if (frames.size() < fewest_frames) return result;
  result.rms_mm = result.best_rms_mm = left_mm(frames, 1, 1);
  const auto look = [&](double middle_x, double middle_y, double step, int reach) {
    for (int v = -reach; v <= reach; ++v)
      for (int u = -reach; u <= reach; ++u) {
        const double x = middle_x * std::pow(step, u), y = middle_y * std::pow(step, v);
        const double left = left_mm(frames, x, y);
        if (left < result.best_rms_mm) {
          result.best_rms_mm = left;
          result.stretch_x = x;
          result.stretch_y = y;
        }
      }
  };
  look(1, 1, coarse_step, static_cast<int>(std::log(most_stretch) / std::log(coarse_step)));
  look(result.stretch_x, result.stretch_y, fine_step, 4);
  const auto tells = [&](double x, double y) {
    return left_mm(frames, result.stretch_x * x, result.stretch_y * y) > tell_ratio * result.best_rms_mm;
  };
  result.told = tells(tell_stretch, tell_stretch) && tells(1 / tell_stretch, 1 / tell_stretch);
  const double off_x = std::max(result.stretch_x, 1 / result.stretch_x),
               off_y = std::max(result.stretch_y, 1 / result.stretch_y);
  const bool other = std::max(off_x, off_y) >= wrong_stretch;
  result.plausible = !(result.told && other && result.rms_mm >= wrong_ratio * result.best_rms_mm);
  if (!result.plausible) {
    result.report =
        message("the head's turns say that focal lengths are wrong: fx ", rounded(result.stretch_x), " and fy ",
                rounded(result.stretch_y), " times what they are; markers stay ", rounded(result.rms_mm),
                " mm from a rigid head's, with other focal lengths ", rounded(result.best_rms_mm), " mm");
    progress.warn(result.report);
  } else if (result.told && !other) {
    result.report = "the head's turns agree with fx and fy";
  } else {
    result.report = "the head turns too little to tell whether fx and fy are true";
  }
  result.report += "\n";
  return result;
}

}  // namespace face::align
