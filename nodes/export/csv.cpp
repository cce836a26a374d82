// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/csv.h"

#include <algorithm>
#include <charconv>

namespace face::exports {

void append_fixed(std::string& out, double value, int decimals) {
  char text[400];  // the longest double has 309 digits before the point
  const auto result = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals);
  const std::string_view written(text, static_cast<std::size_t>(result.ptr - text));
  const bool minus_zero = written.front() == '-' && written.find_first_of("123456789in") == std::string_view::npos;
  out += minus_zero ? written.substr(1) : written;
}

void append_field(std::string& out, std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    out += text;
    return;
  }
  out += '"';
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
}

}  // namespace face::exports
