// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

namespace face::exports {

// A number with a fixed count of decimals and a point, whatever the locale; never "-0.000".
void append_fixed(std::string& out, double value, int decimals);

// A field of RFC 4180: quoted where it holds a comma, a quote or a line break.
void append_field(std::string& out, std::string_view text);

}  // namespace face::exports
