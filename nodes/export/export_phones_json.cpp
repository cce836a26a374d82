// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_phones_json.h"

#include "nodes/base/phones_json.h"

namespace face::exports {

engine::File export_phones_json(const Phones& phones) {
  return engine::File::from_bytes(write_phones_json(phones), ".json");
}

}  // namespace face::exports
