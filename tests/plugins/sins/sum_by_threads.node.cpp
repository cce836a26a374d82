// SPDX-License-Identifier: Apache-2.0
#include "tests/plugins/sins/sins.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("sins.sum_by_threads", &sins::sum_by_threads, version{1}, doc{"Rounds by the number of threads."},
     input{"number", "A number"}, output("sum", "Other for every number of threads"));
