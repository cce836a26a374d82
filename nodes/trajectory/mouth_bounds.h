// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <limits>
#include <vector>

#include "nodes/base/mouth.h"
#include "nodes/trajectory/bounded_trajectory.h"
#include "nodes/trajectory/speech_targets.h"
#include "nodes/types/rig.h"

namespace face::trajectory {

// What contact means, in mm. Bars: lip gap within [-0.3, 1.0] in a closure, lower lip within [-1, 1] of the teeth, gap
// above 1.0 at the middle of an open vowel. Targets lie well inside, so that rounding of weights and frames between two
// closed ones stay within.
struct MouthLimits {
  double overlap_mm = 0.2;      // no pair of lip points runs deeper into each other, at any time
  double closed_mm = 0.1;       // the mean gap of a closure is at most this
  double closed_pair_mm = 0.6;  // and that of every pair this
  double teeth_mm = 0.2;        // the lower lip comes at least so near to the teeth
  double bite_mm = 0.4;         // and enters them by no more than this
  double slide_mm = 0.35;       // along them per linearisation; hypot(teeth_mm, slide_mm) is within the tolerance
  double teeth_price = 300;   // per mm that the teeth stay out of reach: some rigs, and some very short phones, have to
  double tolerance_mm = 0.3;  // by which a contact may miss these and still counts as made
};

// The mouth of one rig as bounds on the ARKit-52 weights of a frame.
class MouthBounds {
 public:
  explicit MouthBounds(const Rig& rig, const MouthLimits& limits = {});

  // The shapes that may deviate from the speech trajectory to make contact, ascending: those that move the lips up,
  // down, in and out. Spreading, eyes and brows are left as they are.
  const std::vector<std::size_t>& correctors() const { return correctors_; }
  bool has_lips() const { return !pair_rows_.empty(); }
  bool has_teeth() const { return teeth_.usable(); }

  // Mean lip gap and signed lip-teeth distance of a pose of 52 weights.
  LipGap gap(const std::vector<double>& weights) const;
  double teeth_mm(const std::vector<double>& weights) const;

  // Appends bounds on the correctors of a frame whose other weights are fixed. `weights` holds all 52.
  void keep_apart(std::size_t frame, const std::vector<double>& weights, std::vector<FrameBound>& bounds) const;
  void close(std::size_t frame, const std::vector<double>& weights, std::vector<FrameBound>& bounds) const;
  void open(std::size_t frame, const std::vector<double>& weights, double open_mm,
            std::vector<FrameBound>& bounds) const;
  // The lower lip does not enter the teeth; with `touch` it meets them, too. The distance is not linear: these bounds
  // hold about `weights` only. Solve, and call again there.
  void bound_teeth(std::size_t frame, const std::vector<double>& weights, bool touch,
                   std::vector<FrameBound>& bounds) const;
  // What bound_teeth() asks for is so.
  bool teeth_hold(const std::vector<double>& weights, bool touch) const;

 private:
  // low <= value + row . (x - weights) <= high, as a bound on the correctors alone.
  void append(std::size_t frame, const std::vector<double>& row, double value, const std::vector<double>& weights,
              double low, double high, std::vector<FrameBound>& bounds,
              double price = std::numeric_limits<double>::infinity()) const;

  MouthLimits limits_;
  std::vector<std::vector<double>> pair_rows_;  // P x 52
  std::vector<double> mean_row_;                // 52
  LipTeeth teeth_;
  std::vector<std::size_t> correctors_;
};

}  // namespace face::trajectory
