// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/matrix.h"
#include "nodes/types/table.h"

namespace face::evaluate {

struct ClusteringOptions {
  double small = 20;  // a planted group of up to so many points is a small one
};

// Groups of points that exemplars stand for (N points in D dimensions, K groups).
//   net_similarity   sum_i s(i, e(i)) over points that are no exemplars + K preference, with s(i, j) = -|x_i - x_j|^2
//                    (Frey and Dueck, Clustering by Passing Messages Between Data Points, Science 315, 2007)
//   groups           K
//   small_groups     planted groups of at most `small` points
//   recall_percent   share of the planted groups for which a found group has a Jaccard index of at least 0.5
//   small_recall_percent  the same of the small ones
//   exemplar_recall_percent  share of the small ones that hold an exemplar
// points: N x D. labels: N x 1, group of every point, 0 to K - 1. exemplars: K x 1, a point each. planted: N x 1, the
// true groups as any whole numbers; null = no recall (NaN). preference: what an exemplar costs, negative.
Table clustering(const Matrix& points, const Matrix& labels, const Matrix& exemplars, const Matrix* planted,
                 const double& preference, const ClusteringOptions& options = {});

}  // namespace face::evaluate
