// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/statistics_table.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::trajectory;

NODE("trajectory.statistics_table", &statistics_table, version{1}, doc{"What training knows of every phone, to read."},
     input{"statistics", "The speaker, from trajectory.train_phones"},
     output("table", "frames, means and standard deviations per phone"));
