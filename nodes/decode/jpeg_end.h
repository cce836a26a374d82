// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>

namespace face::decode {

// Whether a JPEG picture goes on to its end (ITU-T T.81, EOI). Decoders show one that was cut short as if the missing
// part were grey.
bool has_jpeg_end(std::string_view jpeg);

}  // namespace face::decode
