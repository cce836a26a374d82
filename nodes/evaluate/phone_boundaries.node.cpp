// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/phone_boundaries.h"

#include "engine/node.h"
#include "nodes/types/table.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.phone_boundaries", &phone_boundaries, version{1},
     doc{"An alignment beside the true one: boundary errors, phone error rate, F1 at 20 ms and the R-value."},
     input{"phones", "The alignment that is judged"}, input{"truth", "The true one"},
     output("table",
            "boundaries, mae_ms, median_ms, bias_ms, shares within 10 to 50 ms, unmatched_percent, per_percent, "
            "f1_20ms_percent, r_value"));
