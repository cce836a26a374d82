// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <complex>
#include <string>
#include <vector>

namespace face::track {

// A point of a solid head: where it is at rest, seen from the front, and where it is seen, px. Only differences of
// depths mean something.
struct SolidPoint {
  std::complex<double> at_rest, seen;
  double depth_px = 0;  // at rest, towards the viewer
  double weight = 1;
};

// Angles, scale and place of a solid: turned about the picture's axes (x right, y down, z to the viewer) in this order,
// then scaled; (x_px, y_px) is where its origin is seen.
struct HeadPose {
  double nod = 0, turn = 0, tilt = 0;  // rad
  double log_scale = 0;
  double x_px = 0, y_px = 0;
};

// The numbers of a pose, in the order in which it names them, and back.
std::array<double, 6> pose_numbers(const HeadPose& pose);
HeadPose pose_of(const std::array<double, 6>& numbers);

// A head that a camera far away sees: scaled orthographic projection of a solid.
struct SolidHead {
  std::array<double, 3> origin_px = {0, 0, 0};               // a place at rest, that is seen at place_px
  std::array<double, 9> turn = {1, 0, 0, 0, 1, 0, 0, 0, 1};  // rotation times scale, rows
  std::complex<double> place_px;

  // Where a point at rest is seen.
  std::complex<double> seen(std::complex<double> at_rest, double depth_px) const;
  // The point at rest, of this depth, that is seen there.
  std::complex<double> at_rest(std::complex<double> seen_px, double depth_px) const;
};

// Normal distributions of a pose's angles and scale; its place is free.
struct LikelyPose {
  HeadPose mean, deviation;
};

SolidHead solid_head(const HeadPose& pose, const std::array<double, 3>& origin_px);

// The pose at which the points lie nearest to where they were seen (Gauss-Newton on three angles, scale and place).
// Three points are as many numbers as a pose has, and noise of the tip of the nose would turn the head: nods and turns
// within 8 degrees or so and scales within a twentieth are likelier than others, all the more where fewer points are
// seen. points: at least two. similarity: a first guess, from rest to what is seen, as rotation times scale. likely:
// what else is known of the pose; one point is enough then. Null = nothing.
SolidHead find_solid_head(const std::vector<SolidPoint>& points, std::complex<double> similarity,
                          const LikelyPose* likely = nullptr);

// How far the point of the 18-point layout with this name is in front of the inner corners of the eyes, in distances of
// these: means over adults (after Farkas, Anthropometry of the Head and Face, 1994, rounded). -1 for other names.
double usual_depth(const std::string& name);

}  // namespace face::track
