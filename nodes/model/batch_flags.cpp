// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/batch_flags.h"

#include <algorithm>
#include <vector>

#include "nodes/base/check.h"

namespace face::model {

void batch_flags(const engine::Seq<double>& differences, engine::SeqWriter<bool>& flags,
                 const BatchFlagsOptions& options) {
  check(options.batch >= 1 && options.batch <= options.batches, "batch is ", options.batch, ", expected 1 to ",
        options.batches);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < differences.size(); ++i) order.emplace_back(*differences.at(i), i);
  std::sort(order.begin(), order.end());
  const auto batch = static_cast<std::size_t>(options.batch), batches = static_cast<std::size_t>(options.batches);
  std::vector<bool> in(order.size(), false);
  // Rounded up, so that the first batch is never empty where there is any scan.
  const auto end_of = [&](std::size_t b) { return (order.size() * b + batches - 1) / batches; };
  for (std::size_t i = end_of(batch - 1); i < end_of(batch); ++i) in[order[i].second] = true;
  for (std::size_t i = 0; i < in.size(); ++i) flags.push(differences.id(i), in[i]);
}

}  // namespace face::model
