// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/affinity_propagation.h"

#include <algorithm>
#include <numeric>

#include "nodes/base/check.h"
#include "nodes/cluster/affinity_dense.h"
#include "nodes/cluster/affinity_pruned.h"
#include "nodes/cluster/assign.h"

namespace face::cluster {

AffinityPropagationResult affinity_propagation(const Matrix& points, const AffinityPropagationOptions& options,
                                               engine::Progress& progress) {
  check_points(points, "points");
  check(points.rows >= 1, "points has no rows, expected at least one point");
  const bool pruned = options.method == AffinityMethod::pruned;
  std::vector<std::size_t> candidates(points.rows);
  std::iota(candidates.begin(), candidates.end(), std::size_t{0});
  if (pruned)
    candidates = spread_candidates(points, static_cast<std::size_t>(options.candidates),
                                   static_cast<std::uint64_t>(options.seed));

  AffinityPropagationResult result;
  Assignment assignment{{0}, std::vector<std::size_t>(points.rows, 0)};
  Similarities similarities(points, candidates);
  const float least = similarities.minimum();
  result.preference = options.preference;
  if (options.rule == PreferenceRule::minimum) result.preference = static_cast<double>(least);
  constexpr double paper_frames = 18000;  // Animating Lip-Sync Speech Faces, section 5.3
  if (options.rule == PreferenceRule::scaled)
    result.preference = static_cast<double>(least) * std::min(1.0, static_cast<double>(points.rows) / paper_frames);
  if (options.rule == PreferenceRule::median) result.preference = static_cast<double>(similarities.median());
  result.converged = least == 0;  // one point, many times: nothing to tell apart
  if (least < 0) {
    const MessageOptions passing{options.damping, options.max_iterations, options.patience};
    const Messages messages = pass_messages(similarities, static_cast<float>(result.preference), passing, progress);
    result.converged = messages.converged;
    result.iterations = messages.iterations;
    std::vector<std::size_t> exemplars;
    for (const std::size_t k : messages.exemplars) exemplars.push_back(candidates[k]);
    assignment = assign(points, std::move(exemplars));
    if (pruned || options.improve)
      assignment = improve_locally(points, similarities, std::move(assignment), result.preference);
    else
      assignment = improve_medoids(points, std::move(assignment), 1);
    if (pruned) {
      const Similarities central(points,
                                 central_candidates(points, assignment, static_cast<std::size_t>(options.candidates)));
      assignment = improve_locally(points, central, std::move(assignment), result.preference);
    }
  }
  if (!result.converged && !pruned && !options.improve)
    progress.warn(
        message("exemplars still changed after ", result.iterations, " iterations; a larger damping may settle them"));
  result.similarity = net_similarity(points, assignment, result.preference);
  result.labels = {points.rows, 1, std::vector<double>(assignment.labels.begin(), assignment.labels.end())};
  result.exemplars = {assignment.exemplars.size(), 1,
                      std::vector<double>(assignment.exemplars.begin(), assignment.exemplars.end())};
  return result;
}

}  // namespace face::cluster
