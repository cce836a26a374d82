// SPDX-License-Identifier: Apache-2.0
#include "engine/base/element_id.h"

#include <algorithm>
#include <cctype>

namespace engine {
namespace {

bool digits_only(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return c >= '0' && c <= '9'; });
}

bool plain(unsigned char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-';
}

}  // namespace

std::string canonical_id(std::string_view text) {
  if (text.empty() || !plain(static_cast<unsigned char>(text[0]))) return {};
  for (const unsigned char c : text)
    if (!plain(c) && c != '.') return {};
  if (digits_only(text)) {
    const std::size_t first = std::min(text.find_first_not_of('0'), text.size() - 1);
    return std::string(text.substr(first));
  }
  // digits-digits would read as a range of ids.
  const std::size_t dash = text.find('-');
  if (dash != std::string_view::npos && digits_only(text.substr(0, dash)) && digits_only(text.substr(dash + 1)))
    return {};
  return std::string(text);
}

bool is_integer_id(std::string_view canonical) { return digits_only(canonical); }

bool id_before(std::string_view a, std::string_view b) {
  const bool a_integer = is_integer_id(a);
  const bool b_integer = is_integer_id(b);
  if (a_integer != b_integer) return a_integer;
  if (a_integer && a.size() != b.size()) return a.size() < b.size();
  return a < b;
}

}  // namespace engine
