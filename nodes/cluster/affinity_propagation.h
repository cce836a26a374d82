// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/port.h"
#include "nodes/types/matrix.h"

namespace face::cluster {

enum class AffinityMethod {
  exact,  // every point may stand for every other: N^2 numbers
  pruned  // a few hundred points may stand for others: N x candidates numbers
};
enum class PreferenceRule {
  minimum,  // the least similarity of two points, as the paper has it for 18,000 frames
  scaled,   // of that, N of 18,000 parts (all of it above): a clip a tenth as long shows the same shapes a tenth as
            // often, so that a group is worth as much only where it costs a tenth
  median,
  value
};

struct AffinityPropagationOptions {
  AffinityMethod method = AffinityMethod::exact;
  PreferenceRule rule = PreferenceRule::minimum;  // what an exemplar costs, by the similarities of pairs
  double preference = -1;                         // where the rule is `value`; more negative makes fewer groups
  // As Frey and Dueck's own program. At damping 0.5 (scikit-learn) tight groups make messages swing; at 0.9 they take
  // so long to build up that scikit-learn's patience of 15 takes their beginning for the end.
  double damping = 0.9;
  std::int64_t max_iterations = 1000;
  std::int64_t patience = 100;    // iterations without a change of the exemplars that count as converged
  bool improve = false;           // groups of the exact method, too, as those of the pruned one are; see below
  std::int64_t candidates = 600;  // of the pruned method
  std::int64_t seed = 1;          // of the pruned method's random candidates
};

struct AffinityPropagationResult {
  Matrix labels;           // N x 1: number of the group of every point, 0 to K - 1
  Matrix exemplars;        // K x 1: the point that stands for every group, ascending
  double preference = 0;   // that was used
  double similarity = 0;   // net similarity: -(squared distances to the exemplars) + K preference
  bool converged = false;  // false where exemplars still changed in the last iteration
  std::int64_t iterations = 0;
};

// Groups points by affinity propagation (Frey and Dueck, Clustering by Passing Messages Between Data Points, Science
// 315, 2007) with similarity -|a - b|^2: finds how many groups there are, which points stand for them, and who belongs
// to which. points: N x D.
//
// exact: in single precision and about one N^2 matrix of similarities and one of availabilities. The responsibilities,
// the third of the usual implementation, need no room: damped with factor l, after t iterations they are
// (1 - l^t) s(i,k) - (damped maxima of row i) but for the few columns that were a row's maximum, which are kept. One
// pass over memory per iteration does both messages. Sums over columns are made per fixed block of rows, so that the
// number of threads changes no bit.
// Where two points are nearly the same (a film of 25 frames a second that is shown at 50) messages hardly tell which of
// them shall stand for both: they settle on far too few groups or on both points. `improve` mends that: as with the
// pruned method, exemplars move, are exchanged, given up and taken in as long as the net similarity rises.
// As in scikit-learn, after the messages every group takes the member with the largest sum of similarities as its
// exemplar and points go to their nearest exemplar. Differs from it: no noise is added to the similarities.
//
// pruned: only `candidates` points, spread by farthest-point sampling and drawn at random, half each, may be exemplars;
// then exemplars move to the middle of their groups, are exchanged for better candidates, groups that cost more than
// they are worth are given up and candidates that are worth more than they cost are taken in, until nothing changes;
// then once more with the points in the middle of the groups as candidates.
AffinityPropagationResult affinity_propagation(const Matrix& points, const AffinityPropagationOptions& options,
                                               engine::Progress& progress);

}  // namespace face::cluster
