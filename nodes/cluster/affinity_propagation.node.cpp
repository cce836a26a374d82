// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/affinity_propagation.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::cluster;

NODE(
    "cluster.affinity_propagation", &affinity_propagation, version{3},
    doc{"Finds the points that stand best for all others, and how many there should be, by affinity propagation."},
    input{"points", "N x D"},
    param("method", &AffinityPropagationOptions::method,
          {{"exact", AffinityMethod::exact}, {"pruned", AffinityMethod::pruned}},
          "Every point may be an exemplar (memory grows with the square of their number), or a few hundred may"),
    param("rule", &AffinityPropagationOptions::rule,
          {{"minimum", PreferenceRule::minimum},
           {"scaled", PreferenceRule::scaled},
           {"median", PreferenceRule::median},
           {"value", PreferenceRule::value}},
          "What an exemplar costs: the smallest similarity of two points, N of 18,000 parts of that (short clips), the "
          "median similarity, or `preference`"),
    param("preference", &AffinityPropagationOptions::preference, range{-1e300, 0}, unit{"1"},
          "Cost of an exemplar where the rule is value; more negative makes fewer groups",
          inert{"counts where the rule is value"}),
    param("damping", &AffinityPropagationOptions::damping, range{0, 0.99}, unit{"1"},
          "Share of the old message that every new one keeps"),
    param("max_iterations", &AffinityPropagationOptions::max_iterations, range{1, 100000}, unit{"1"},
          "Iterations at most", inert{"most data settle before"}),
    param("patience", &AffinityPropagationOptions::patience, range{1, 1000}, unit{"1"},
          "Iterations without a change of the exemplars that count as settled", inert{"most data stay settled"}),
    param("improve", &AffinityPropagationOptions::improve,
          "Groups of the exact method, too, are improved as long as the net similarity rises: where points are nearly "
          "the "
          "same, messages do not settle well",
          inert{"counts where messages did not find the best groups"}),
    param("candidates", &AffinityPropagationOptions::candidates, range{2, 20000}, unit{"1"},
          "Points that may be exemplars where the method is pruned", inert{"counts where the method is pruned"}),
    param("seed", &AffinityPropagationOptions::seed, range{0, 1000000}, unit{"1"},
          "Another seed draws other candidates where the method is pruned", inert{"counts where the method is pruned"}),
    output("labels", &AffinityPropagationResult::labels, "N x 1: number of every point's group"),
    output("exemplars", &AffinityPropagationResult::exemplars, "K x 1: the point that stands for every group"),
    output("preference", &AffinityPropagationResult::preference, "What an exemplar cost"),
    output("similarity", &AffinityPropagationResult::similarity,
           "Net similarity: squared distances to the exemplars, negative, and what the exemplars cost"),
    output("converged", &AffinityPropagationResult::converged, "False where the exemplars did not settle"),
    output("iterations", &AffinityPropagationResult::iterations, "Rounds of messages"));
