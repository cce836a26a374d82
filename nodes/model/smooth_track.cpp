// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/smooth_track.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/model/face_pose.h"
#include "nodes/model/pose_model.h"

namespace face::model {
namespace {

using Rows3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr std::size_t least_frames = 12;
// Ratios that are tried: half an octave apart, and none at all. From the largest on a path is all but straight.
constexpr int least_power = -12, most_power = 40;

// The factor L of 1 + ratio D D', D taking second differences: three entries per row.
struct Band {
  std::vector<double> on, below, lowest;
};

Band factor(std::size_t count, double ratio) {
  Band l{std::vector<double>(count), std::vector<double>(count), std::vector<double>(count)};
  for (std::size_t i = 0; i < count; ++i) {
    if (i >= 2) l.lowest[i] = ratio / l.on[i - 2];
    if (i >= 1) l.below[i] = (-4 * ratio - (i >= 2 ? l.lowest[i] * l.below[i - 1] : 0.0)) / l.on[i - 1];
    l.on[i] = std::sqrt(1 + 6 * ratio - l.below[i] * l.below[i] - l.lowest[i] * l.lowest[i]);
  }
  return l;
}

std::vector<double> forwards(const Band& l, const std::vector<double>& values) {
  std::vector<double> x(values.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = (values[i] - (i >= 1 ? l.below[i] * x[i - 1] : 0.0) - (i >= 2 ? l.lowest[i] * x[i - 2] : 0.0)) / l.on[i];
  return x;
}

std::vector<double> backwards(const Band& l, const std::vector<double>& values) {
  std::vector<double> x(values.size());
  for (std::size_t i = x.size(); i-- > 0;)
    x[i] = (values[i] - (i + 1 < x.size() ? l.below[i + 1] * x[i + 1] : 0.0) -
            (i + 2 < x.size() ? l.lowest[i + 2] * x[i + 2] : 0.0)) /
           l.on[i];
  return x;
}

// Logarithm of the likelihood of second differences whose covariance is proportional to 1 + ratio D D'.
double likelihood_of(const std::vector<double>& values, double ratio) {
  const Band l = factor(values.size(), ratio);
  double squares = 0, logarithms = 0;
  for (const double z : forwards(l, values)) squares += z * z;
  for (const double on : l.on) logarithms += std::log(on);
  const auto count = static_cast<double>(values.size());
  return -logarithms - 0.5 * count * std::log(squares / count);
}

// The rotation vector that takes one orientation to the other, in the camera's frame.
Eigen::Vector3d turn_between(const FacePose& from, const FacePose& to) {
  const Eigen::Map<const Rows3> a(from.rotation.data()), b(to.rotation.data());
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(b * a.transpose()));
  return turn.angle() * turn.axis();
}

void smooth(std::vector<FacePose>& poses) {
  const std::size_t frames = poses.size();
  if (frames < least_frames) return;
  std::array<std::vector<double>, 3> accelerations;
  for (std::size_t f = 1; f + 1 < frames; ++f) {
    const Eigen::Vector3d a = turn_between(poses[f], poses[f + 1]) - turn_between(poses[f - 1], poses[f]);
    for (std::size_t axis = 0; axis < 3; ++axis) accelerations[axis].push_back(a[static_cast<Eigen::Index>(axis)]);
  }
  std::array<std::vector<double>, 3> added;
  for (std::size_t axis = 0; axis < 3; ++axis) added[axis] = most_probable_correction(accelerations[axis]);
  for (std::size_t f = 0; f < frames; ++f) {
    std::array<double, FacePose::size> step{};
    for (std::size_t axis = 0; axis < 3; ++axis) step[axis] = added[axis][f];
    poses[f] = moved(poses[f], step);
  }
}

}  // namespace

std::vector<double> most_probable_correction(const std::vector<double>& second_differences) {
  const std::vector<double>& d = second_differences;
  std::vector<double> added(d.size() + 2, 0.0);
  if (std::all_of(d.begin(), d.end(), [](double value) { return value == 0; })) return added;
  double best = likelihood_of(d, 0), ratio = 0;
  for (int power = least_power; power <= most_power; ++power) {
    const double tried = std::exp2(0.5 * power), likelihood = likelihood_of(d, tried);
    if (likelihood > best) {
      best = likelihood;
      ratio = tried;
    }
  }
  // The minimum is -ratio D' (1 + ratio D D')^-1 d.
  const Band l = factor(d.size(), ratio);
  const std::vector<double> x = backwards(l, forwards(l, d));
  constexpr std::array<double, 3> weights = {1, -2, 1};
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) added[i + k] -= ratio * weights[k] * x[i];
  return added;
}

void smooth_track(const MorphableModel& model, const engine::Seq<FaceFit>& fits, engine::SeqWriter<FaceFit>& smoothed,
                  engine::Progress& progress) {
  const Vec3f middle = turning_point(model);
  std::vector<FacePose> poses;
  std::size_t written = 0, first_lost = 0;
  const auto finish = [&] {
    smooth(poses);
    for (const FacePose& pose : poses) {
      FaceFit fit = *fits.at(written);
      if (poses.size() >= least_frames) fit.camera = camera_of(pose);
      smoothed.push(fits.id(written++), std::move(fit));
    }
    poses.clear();
  };
  for (std::size_t f = 0; f < fits.size(); ++f) {
    const auto fit = fits.at(f);
    if (fit->converged) {
      poses.push_back(pose_of(fit->camera, middle));
      continue;
    }
    finish();
    if (f == 0 || fits.at(f - 1)->converged) first_lost = f;
    if (f + 1 == fits.size() || fits.at(f + 1)->converged)
      progress.warn(message(first_lost == f ? "frame " : message("frames ", fits.id(first_lost), " to "), fits.id(f),
                            first_lost == f ? " is" : " are", " not believed: ", fits.at(first_lost)->problem));
    smoothed.push(fits.id(written++), *fit);
  }
  finish();
}

}  // namespace face::model
