// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_text.h"

namespace face::exports {

engine::File export_text(const std::string& text) { return engine::File::from_bytes(text, ".txt"); }

}  // namespace face::exports
