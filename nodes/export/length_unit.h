// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace face::exports {

// The unit in which a file gives lengths.
enum class ExportUnit { m, cm, mm };

inline float units_per_mm(ExportUnit unit) {
  return unit == ExportUnit::m ? 0.001f : unit == ExportUnit::cm ? 0.1f : 1.0f;
}

}  // namespace face::exports
