// SPDX-License-Identifier: Apache-2.0
// Judges animated speech on the posed rig by the definitions that the project's goals are stated in. It shares nothing
// with the code it judges but the vertices that the rig names.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "nodes/base/pose.h"
#include "nodes/types/phones.h"
#include "nodes/types/rig.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace test {

struct Verdict {
  int bilabials = 0;
  double widest_closure_mm = -1e9;  // largest and least of the smallest lip gaps inside /p b m/
  double deepest_closure_mm = 1e9;
  double deepest_gap_mm = 1e9;  // least lip gap of all frames
  int labiodentals = 0;
  double farthest_teeth_mm = -1e9;  // largest of the smallest lip-teeth distances inside /f v/
  double deepest_bite_mm = 1e9;     // least signed distance inside /f v/
  int open_vowels = 0;
  double least_open_mm = 1e9;  // least lip gap at the middle of a long open vowel
  double high_energy = 0;      // of the weights above 12 Hz, and of the weights without their mean,
  double whole_energy = 0;     // both outside 30 ms of closures
  double largest_step = 0;     // of any weight from frame to frame

  void add(const Verdict& other) {
    bilabials += other.bilabials;
    widest_closure_mm = std::max(widest_closure_mm, other.widest_closure_mm);
    deepest_closure_mm = std::min(deepest_closure_mm, other.deepest_closure_mm);
    deepest_gap_mm = std::min(deepest_gap_mm, other.deepest_gap_mm);
    labiodentals += other.labiodentals;
    farthest_teeth_mm = std::max(farthest_teeth_mm, other.farthest_teeth_mm);
    deepest_bite_mm = std::min(deepest_bite_mm, other.deepest_bite_mm);
    open_vowels += other.open_vowels;
    least_open_mm = std::min(least_open_mm, other.least_open_mm);
    high_energy += other.high_energy;
    whole_energy += other.whole_energy;
    largest_step = std::max(largest_step, other.largest_step);
  }
};

inline double judged_gap_mm(const face::Rig& rig, const std::vector<face::Vec3f>& posed) {
  double sum = 0;
  for (const face::LipPair& pair : rig.inner_lips)
    sum += double{posed[pair.upper][1]} - posed[pair.lower][1] - rig.neutral.points_mm[pair.upper][1] +
           rig.neutral.points_mm[pair.lower][1];
  return sum / static_cast<double>(rig.inner_lips.size());
}

// The polygons' normals about every vertex of the upper teeth, and whether polygons that are not wholly of the teeth
// meet there: beyond such a border there is no inside.
struct JudgedTeeth {
  std::vector<std::vector<face::Vec3f>> normals;
  std::vector<bool> border;
};

// Vertex to vertex; where the lip vertex lies behind every polygon about the nearest vertex of the teeth, minus its
// depth below the nearest of their planes.
inline double judged_teeth_mm(const face::Rig& rig, const std::vector<face::Vec3f>& posed, const JudgedTeeth& teeth) {
  const auto product = [](const face::Vec3f& a, const face::Vec3f& b) {
    return double{a[0]} * b[0] + double{a[1]} * b[1] + double{a[2]} * b[2];
  };
  double least = 1e9;
  for (const std::uint32_t lip : rig.lower_lip) {
    double nearest = 1e9, plane = 0;
    bool inside = false;
    for (std::size_t t = 0; t < rig.upper_teeth.size(); ++t) {
      const face::Vec3f &p = posed[lip], &tooth = posed[rig.upper_teeth[t]];
      const face::Vec3f d = {p[0] - tooth[0], p[1] - tooth[1], p[2] - tooth[2]};
      const double squared = product(d, d);
      if (squared >= nearest) continue;
      nearest = squared;
      plane = -1e9;
      for (const face::Vec3f& normal : teeth.normals[t])
        plane = std::max(plane, product(d, normal) / std::sqrt(product(normal, normal)));
      inside = !teeth.border[t] && plane < 0;
    }
    least = std::min(least, inside ? plane : std::sqrt(nearest));
  }
  return least;
}

inline JudgedTeeth judge_teeth(const face::Rig& rig) {
  const face::Mesh& mesh = rig.neutral;
  const std::set<std::uint32_t> teeth(rig.upper_teeth.begin(), rig.upper_teeth.end());
  std::vector<std::vector<face::Vec3f>> normals(mesh.points_mm.size());
  std::vector<bool> border(mesh.points_mm.size(), false);
  for (std::size_t f = 0; f < mesh.polygon_count(); ++f) {
    const std::uint32_t first = mesh.polygon_starts[f], count = mesh.polygon_starts[f + 1] - first;
    bool whole = true;
    for (std::uint32_t c = 0; c < count; ++c) whole = whole && teeth.contains(mesh.corners[first + c]);
    for (std::uint32_t c = 0; c < count; ++c) {
      const std::uint32_t v = mesh.corners[first + c];
      const face::Vec3f& b = mesh.points_mm[v];
      const face::Vec3f& a = mesh.points_mm[mesh.corners[first + (c + count - 1) % count]];
      const face::Vec3f& n = mesh.points_mm[mesh.corners[first + (c + 1) % count]];
      if (!whole) border[v] = true;
      face::Vec3f normal;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        normal[k] = (n[i] - b[i]) * (a[j] - b[j]) - (n[j] - b[j]) * (a[i] - b[i]);
      }
      normals[v].push_back(normal);
    }
  }
  JudgedTeeth judged;
  for (const std::uint32_t v : rig.upper_teeth) {
    judged.normals.push_back(normals[v]);
    judged.border.push_back(border[v]);
  }
  return judged;
}

// Second order Butterworth high-pass, run forwards and backwards from rest, so that it shifts nothing.
inline std::vector<double> high_pass(std::vector<double> x, double cut_hz, double rate_hz) {
  const double c = std::tan(std::numbers::pi * cut_hz / rate_hz), d = 1 + std::numbers::sqrt2 * c + c * c;
  for (int pass = 0; pass < 2; ++pass) {
    const double start = x.empty() ? 0 : x.front();
    double x1 = start, x2 = start, y1 = 0, y2 = 0;
    for (double& value : x) {
      const double y = (value - 2 * x1 + x2 - 2 * (c * c - 1) * y1 - (1 - std::numbers::sqrt2 * c + c * c) * y2) / d;
      x2 = x1, x1 = value, y2 = y1, y1 = y;
      value = y;
    }
    std::reverse(x.begin(), x.end());
  }
  return x;
}

inline Verdict judge_speech(const face::Phones& phones, const std::vector<face::Weights>& weights,
                            const face::Timeline& timeline, const face::Rig& rig) {
  Verdict verdict;
  const JudgedTeeth teeth = judge_teeth(rig);
  const bool has_teeth = !rig.lower_lip.empty() && !rig.upper_teeth.empty();
  const double rate_hz = static_cast<double>(timeline.time_s.size()) / timeline.duration_s;
  std::vector<double> gaps;
  for (const face::Weights& frame : weights) gaps.push_back(judged_gap_mm(rig, face::pose_points(rig, frame)));
  for (const double gap : gaps) verdict.deepest_gap_mm = std::min(verdict.deepest_gap_mm, gap);

  std::vector<bool> near_closure(weights.size(), false);
  const std::set<std::string> open = {"AA", "AE", "AH", "AO", "AW", "AY", "EH", "OW"};
  for (std::size_t p = 0; p < phones.phones.size(); ++p) {
    const face::Phone& phone = phones.phones[p];
    const std::string base = phone.label.substr(0, phone.label.find('.'));
    const double start_s = phone.start_s;
    double end_s = phone.end_s;
    if (phone.label.ends_with(".r")) continue;
    if (base == "P" || base == "B" || base == "M")
      for (std::size_t i = 0; i < weights.size(); ++i)
        if (timeline.time_s[i] >= start_s - 0.03 && timeline.time_s[i] <= end_s + 0.03) near_closure[i] = true;
    if (phone.label.ends_with(".c")) end_s = phones.phones.at(p + 1).end_s;
    double least_gap = 1e9, least_teeth = 1e9;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (timeline.time_s[i] < start_s - 1e-9 || timeline.time_s[i] >= end_s - 1e-9) continue;
      least_gap = std::min(least_gap, gaps[i]);
      if ((base == "F" || base == "V") && has_teeth) {
        const double distance = judged_teeth_mm(rig, face::pose_points(rig, weights[i]), teeth);
        least_teeth = std::min(least_teeth, distance);
      }
    }
    if (least_gap > 1e8) continue;  // shorter than a frame and between two: no frame shows it
    if (base == "P" || base == "B" || base == "M") {
      ++verdict.bilabials;
      verdict.widest_closure_mm = std::max(verdict.widest_closure_mm, least_gap);
      verdict.deepest_closure_mm = std::min(verdict.deepest_closure_mm, least_gap);
    } else if ((base == "F" || base == "V") && has_teeth) {
      ++verdict.labiodentals;
      verdict.farthest_teeth_mm = std::max(verdict.farthest_teeth_mm, least_teeth);
      verdict.deepest_bite_mm = std::min(verdict.deepest_bite_mm, least_teeth);
    } else if (open.contains(base) && end_s - start_s >= 0.08) {
      ++verdict.open_vowels;
      const auto middle = static_cast<std::size_t>(std::lround((start_s + end_s) / 2 * rate_hz));
      verdict.least_open_mm = std::min(verdict.least_open_mm, gaps[std::min(middle, gaps.size() - 1)]);
    }
  }
  for (std::size_t s = 0; s < weights.front().values.size(); ++s) {
    std::vector<double> curve;
    double mean = 0;
    for (const face::Weights& frame : weights) {
      if (!curve.empty())
        verdict.largest_step = std::max(verdict.largest_step, std::abs(frame.values[s] - curve.back()));
      curve.push_back(frame.values[s]);
      mean += frame.values[s] / static_cast<double>(weights.size());
    }
    const std::vector<double> high = high_pass(curve, 12, rate_hz);
    for (std::size_t i = 0; i < curve.size(); ++i) {
      if (near_closure[i]) continue;
      verdict.high_energy += high[i] * high[i];
      verdict.whole_energy += (curve[i] - mean) * (curve[i] - mean);
    }
  }
  return verdict;
}

}  // namespace test
