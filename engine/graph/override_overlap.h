// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "engine/base/problem.h"
#include "engine/graph/flat_graph.h"

namespace engine {

// Reports overrides of a node that is not mapped, ids with a wrong number of levels, and elements named more than once.
void check_overrides(const FlatNode& node, int mapped_depth, std::vector<Problem>& problems);

}  // namespace engine
