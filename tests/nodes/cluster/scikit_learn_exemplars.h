// SPDX-License-Identifier: Apache-2.0
// What scikit-learn 1.2.1 finds in planted_groups(2000, 10, 12, 4):
//   S = -euclidean_distances(X, squared=True)
//   AffinityPropagation(damping=0.5, preference=P, random_state=0, max_iter=400).fit(X).cluster_centers_indices_
#pragma once
#include <vector>

namespace test {

const std::vector<double> scikit_learn_minimum = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};  // P = S.min()
constexpr double scikit_learn_minimum_preference = -6752.085596490868;
const std::vector<double> scikit_learn_median = {0, 1,  2,  3,   4,   5,   6,    7,    8,
                                                 9, 10, 11, 103, 461, 897, 1099, 1510, 1841};  // P = numpy.median(S)
constexpr double scikit_learn_median_preference = -1999.9788694905901;

}  // namespace test
