// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/phone_statistics.h"
#include "nodes/types/table.h"

namespace face::trajectory {

// What training knows of every phone, to read: frames, mean_0, mean_1, ..., deviation_0, ... (square roots of the
// covariance's diagonal). The last row, "all", is of all speech.
Table statistics_table(const PhoneStatistics& statistics);

}  // namespace face::trajectory
