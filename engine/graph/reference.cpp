// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/reference.h"

#include "engine/base/element_id.h"
#include "engine/graph/graph.h"

namespace engine {
namespace {

bool letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool digit(char c) { return c >= '0' && c <= '9'; }

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

std::string in_quotes(std::string_view text) { return "'" + std::string(text) + "'"; }

constexpr const char* what_an_id_is = "ids are made of letters, digits, '_', '-' and '.', and 3-5 is a range";

}  // namespace

bool is_name(std::string_view text) {
  if (text.empty() || !letter(text[0])) return false;
  for (const char c : text)
    if (!letter(c) && !digit(c)) return false;
  return true;
}

bool parse_reference(std::string_view text, Reference& reference, std::string& error) {
  reference = {};
  const auto fail = [&](const std::string& why) {
    error = in_quotes(text) + " is no reference: " + why;
    return false;
  };
  if (text.empty()) return fail("it is empty, expected \"node\", \"node.output\" or \"node.output[id]\"");
  std::string_view rest = text;
  if (const std::size_t bracket = rest.find('['); bracket != std::string_view::npos) {
    if (!rest.ends_with(']')) return fail("']' is missing at its end");
    const std::string_view inside = rest.substr(bracket + 1, rest.size() - bracket - 2);
    for (const std::string_view part : split(inside, '/')) {
      reference.element.push_back(canonical_id(part));
      if (reference.element.back().empty()) return fail(in_quotes(part) + " is no element id (" + what_an_id_is + ")");
    }
    rest = rest.substr(0, bracket);
  }
  std::string_view node = rest;
  if (const std::size_t dot = rest.find('.'); dot != std::string_view::npos) {
    node = rest.substr(0, dot);
    const std::string_view output = rest.substr(dot + 1);
    if (!is_name(output)) return fail(in_quotes(output) + " is no name of an output");
    reference.output = output;
  }
  for (const std::string_view part : split(node, '/'))
    if (!is_name(part)) return fail(in_quotes(part) + " is no name of a node");
  reference.node = node;
  return true;
}

bool parse_ranges(std::string_view text, std::vector<Override::Range>& ranges, std::string& error) {
  ranges.clear();
  for (const std::string_view padded : split(text, ',')) {
    const std::string_view item = trimmed(padded);
    Override::Range range;
    const std::vector<std::string_view> parts = split(item, '/');
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
      range.parents.push_back(canonical_id(parts[i]));
      if (range.parents.back().empty()) {
        error = in_quotes(parts[i]) + " is no element id (" + what_an_id_is + ")";
        return false;
      }
    }
    const std::string_view last = parts.back();
    const std::size_t dash = last.find('-');
    const bool two =
        dash != std::string_view::npos && is_integer_id(last.substr(0, dash)) && is_integer_id(last.substr(dash + 1));
    range.first = canonical_id(two ? last.substr(0, dash) : last);
    range.last = two ? canonical_id(last.substr(dash + 1)) : range.first;
    if (range.first.empty()) {
      error = in_quotes(item) + " is no element id or range (" + what_an_id_is + ")";
      return false;
    }
    if (two && id_before(range.last, range.first)) {
      error = "the range " + std::string(last) + " runs backwards";
      return false;
    }
    ranges.push_back(std::move(range));
  }
  return true;
}

}  // namespace engine
