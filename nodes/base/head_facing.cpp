// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/head_facing.h"

#include <cmath>

namespace face {
namespace {

using Place = std::complex<double>;

// value = first * one + second * other, with an error.
struct Equation {
  double value, first, second, error;
};

// The most likely two numbers, which are normally distributed about `likely` before anything is seen.
std::complex<double> most_likely(const std::vector<Equation>& equations, Place likely, Place deviation) {
  double a = 1 / (deviation.real() * deviation.real()), b = 0, c = 1 / (deviation.imag() * deviation.imag());
  double u = a * likely.real(), v = c * likely.imag();
  for (const Equation& equation : equations) {
    const double sure = 1 / (equation.error * equation.error);
    a += sure * equation.first * equation.first;
    b += sure * equation.first * equation.second;
    c += sure * equation.second * equation.second;
    u += sure * equation.first * equation.value;
    v += sure * equation.second * equation.value;
  }
  const double det = a * c - b * b;
  return {(c * u - b * v) / det, (a * v - b * u) / det};
}

}  // namespace

MiddleMark nose_tip_mark(Place seen_px, double below, double depth) { return {seen_px, below, depth, 0.04, 0.08}; }
MiddleMark mouth_mark(Place seen_px, double below, double depth) { return {seen_px, below, depth, 0.08, 0.12}; }
MiddleMark chin_mark(Place seen_px, double below, double depth) { return {seen_px, below, depth, 0.12, 0.25}; }

HeadFacing head_facing(Place right_px, Place left_px, const std::vector<MiddleMark>& marks) {
  constexpr double turn_deviation = 0.27, tilt_deviation = 0.03;  // rad
  constexpr double nod_deviation = 0.1, length_deviation = 0.12;  // rad, share
  HeadFacing facing{0, 0, (right_px + left_px) / 2.0, left_px - right_px};
  if (std::abs(facing.unit_px) == 0) return {0, 0, facing.middle_px};
  std::vector<Equation> aside, down;
  for (const MiddleMark& mark : marks)
    aside.push_back(
        {((mark.seen_px - facing.middle_px) / facing.unit_px).real(), mark.depth, mark.below, mark.across_error});
  facing.turn = std::atan(most_likely(aside, 0, {turn_deviation, tilt_deviation}).real());
  facing.unit_px /= std::cos(facing.turn);
  for (const MiddleMark& mark : marks)
    down.push_back(
        {((mark.seen_px - facing.middle_px) / facing.unit_px).imag(), -mark.depth, mark.below, mark.along_error});
  facing.nod = most_likely(down, {0, 1}, {nod_deviation, length_deviation}).real();
  return facing;
}

double HeadFacing::depth_px(Place seen_px, double front_depth_px) const {
  const Place off = (seen_px - middle_px) / (unit_px / std::abs(unit_px));
  // The third column of the rotation: how far what is in front is seen aside, down and in front.
  const double aside = std::sin(turn) * std::cos(nod), down = -std::sin(nod), front = std::cos(turn) * std::cos(nod);
  return (front_depth_px - aside * off.real() - down * off.imag()) / front;
}

}  // namespace face
