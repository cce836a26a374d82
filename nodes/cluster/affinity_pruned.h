// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/cluster/affinity_dense.h"
#include "nodes/cluster/assign.h"

namespace face::cluster {

// `count` points, ascending: half by farthest-point sampling from the point that is farthest from the mean (Gonzalez,
// Clustering to Minimize the Maximum Intercluster Distance, Theoretical Computer Science 38, 1985), which finds small
// groups, half at random, which finds dense ones.
std::vector<std::size_t> spread_candidates(const Matrix& points, std::size_t count, std::uint64_t seed);

// About `count` points in the middle of the groups, the same number for each, and the exemplars; ascending.
std::vector<std::size_t> central_candidates(const Matrix& points, const Assignment& assignment, std::size_t count);

// Gives up groups, exchanges exemplars for candidates, takes in candidates and moves exemplars to the middle of their
// groups as long as the net similarity rises.
Assignment improve_locally(const Matrix& points, const Similarities& similarities, Assignment assignment,
                           double preference);

}  // namespace face::cluster
