// SPDX-License-Identifier: Apache-2.0
// What lies behind a node or a task: for partial runs, plans and explanations.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "engine/run/session.h"

namespace engine::run {

// Index of a node; throws with the nearest name where there is none.
int find_or_throw(const Graph& graph, const std::string& id);

// Only what one node needs.
Graph reduced_to(const Graph& graph, int target);

struct EarlierFirst {
  bool operator()(const Task* a, const Task* b) const { return a->serial < b->serial; }
};
using TaskSet = std::set<const Task*, EarlierFirst>;

// The trees that a task reads, and the tasks behind a tree.
std::vector<Tree*> inputs_of(const Task& task);
void producers_of(Tree* tree, TaskSet& found);

// What a run would do with a task of a plan.
PlannedTask::Fate fate_of(const Task& task);

}  // namespace engine::run
