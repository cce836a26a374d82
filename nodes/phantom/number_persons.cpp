// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/number_persons.h"

namespace face::phantom {

void number_persons(engine::SeqWriter<std::string>& ids, const NumberPersonsOptions& options) {
  for (std::int64_t i = 1; i <= options.count; ++i) ids.push(std::to_string(i), std::to_string(i));
}

}  // namespace face::phantom
