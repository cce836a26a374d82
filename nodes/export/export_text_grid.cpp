// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_text_grid.h"

#include "nodes/base/text_grid.h"

namespace face::exports {

engine::File export_text_grid(const Phones& phones) {
  return engine::File::from_bytes(write_text_grid(text_grid_from_phones(phones)), ".TextGrid");
}

}  // namespace face::exports
