// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/phantom/make_head.h"
#include "nodes/phantom/sculptor.h"

namespace face::phantom {

// The embedded head without its shapes.
Head neutral_head(const MakeHeadOptions& options);

}  // namespace face::phantom
