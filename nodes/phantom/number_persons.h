// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "engine/port.h"

namespace face::phantom {

struct NumberPersonsOptions {
  std::int64_t count = 200;
};

// The numbers 1, 2, ... count as texts: ids that make one phantom.make_person many.
void number_persons(engine::SeqWriter<std::string>& ids, const NumberPersonsOptions& options = {});

}  // namespace face::phantom
