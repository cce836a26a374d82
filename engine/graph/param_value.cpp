// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/param_value.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace engine {
namespace {

using Kind = JsonValue::Kind;

constexpr double most_exact = 9007199254740991.0;  // larger bounds are none

std::string number_text(double value) { return to_text(ParamValue(value)); }

std::string range_text(const ParamInfo& param) {
  const bool low = param.low > -most_exact;
  const bool high = param.high < most_exact;
  std::string text;
  if (low && high) text = " from " + number_text(param.low) + " to " + number_text(param.high);
  if (low && !high) text = " of at least " + number_text(param.low);
  if (!low && high) text = " of at most " + number_text(param.high);
  if (!text.empty() && !param.unit.empty() && param.unit != "1") text += " " + param.unit;
  return text;
}

std::string choices_text(const ParamInfo& param) {
  std::string text;
  for (const std::string& choice : param.choices) text += (text.empty() ? "" : ", ") + quoted_text(choice);
  return text;
}

std::string expected_one(const ParamInfo& param, bool plural) {
  switch (param.kind) {
    case ParamKind::boolean:
      return plural ? "true and false" : "true or false";
    case ParamKind::integer:
      return (plural ? "integers" : "an integer") + range_text(param);
    case ParamKind::real:
      return (plural ? "numbers" : "a number") + range_text(param);
    case ParamKind::string:
      return plural ? "strings" : "a string";
    case ParamKind::choice:
      return (plural ? "" : "one of ") + choices_text(param);
  }
  return {};
}

// A real number without bounds may be any; an integer has to be exact as a double.
bool in_range(double value, const ParamInfo& param) {
  const bool real = param.kind == ParamKind::real;
  const bool low = value >= param.low || (real && param.low <= -most_exact);
  const bool high = value <= param.high || (real && param.high >= most_exact);
  return std::isfinite(value) && low && high;
}

bool fits(const JsonValue& value, const ParamInfo& param) {
  switch (param.kind) {
    case ParamKind::boolean:
      return value.is(Kind::boolean);
    case ParamKind::integer:
      return value.is(Kind::integer) && in_range(value.real, param);
    case ParamKind::real:
      return (value.is(Kind::integer) || value.is(Kind::real)) && in_range(value.real, param);
    case ParamKind::string:
      return value.is(Kind::string);
    case ParamKind::choice:
      if (!value.is(Kind::string)) return false;
      for (const std::string& choice : param.choices)
        if (choice == value.text) return true;
      return false;
  }
  return false;
}

std::string mismatch(const JsonValue& value, const ParamInfo& param) {
  std::string text = "found " + found(value) + ", expected " + expected_value(param);
  if (param.kind == ParamKind::choice && value.is(Kind::string)) text += did_you_mean(value.text, param.choices);
  if (param.kind == ParamKind::integer && value.is(Kind::integer) && range_text(param).empty())
    text += " of at most " + number_text(most_exact) + " in size";
  return text;
}

ParamValue one(const JsonValue& value, ParamKind kind) {
  switch (kind) {
    case ParamKind::boolean:
      return value.boolean;
    case ParamKind::integer:
      return value.integer;
    case ParamKind::real:
      return value.real == 0 ? 0.0 : value.real;  // -0 is 0: equal values have equal keys
    default:
      return value.text;
  }
}

template <class T>
ParamValue list_of(const JsonValue& value, ParamKind kind) {
  std::vector<T> values;
  for (const JsonValue& item : value.items) values.push_back(std::get<T>(one(item, kind)));
  return values;
}

JsonValue scalar_of_text(std::string_view text, ParamKind kind) {
  JsonValue value;
  value.kind = Kind::string;
  value.text = text;
  const char* const end = text.data() + text.size();
  if (kind == ParamKind::boolean && (text == "true" || text == "false")) {
    value.kind = Kind::boolean;
    value.boolean = text == "true";
  } else if (kind == ParamKind::integer || kind == ParamKind::real) {
    if (const auto [at, code] = std::from_chars(text.data(), end, value.integer); code == std::errc() && at == end) {
      value.kind = Kind::integer;
      value.real = static_cast<double>(value.integer);
    } else if (const auto [stop, failure] = std::from_chars(text.data(), end, value.real);
               failure == std::errc() && stop == end && std::isfinite(value.real)) {
      value.kind = Kind::real;
    }
  }
  return value;
}

}  // namespace

std::string expected_value(const ParamInfo& param) {
  return param.list ? "a list of " + expected_one(param, true) : expected_one(param, false);
}

std::optional<ParamValue> read_param(const JsonValue& value, const ParamInfo& param, std::string& error) {
  if (!param.list) {
    if (fits(value, param)) return one(value, param.kind);
    error = mismatch(value, param);
    return {};
  }
  if (!value.is(Kind::array)) {
    error = mismatch(value, param);
    return {};
  }
  for (const JsonValue& item : value.items)
    if (!fits(item, param)) {
      error = mismatch(item, param);
      return {};
    }
  switch (param.kind) {
    case ParamKind::boolean:
      return list_of<bool>(value, param.kind);
    case ParamKind::integer:
      return list_of<std::int64_t>(value, param.kind);
    case ParamKind::real:
      return list_of<double>(value, param.kind);
    default:
      return list_of<std::string>(value, param.kind);
  }
}

JsonValue value_of_text(std::string_view text, const ParamInfo& param, const SourceFile& source,
                        const std::string& pointer) {
  JsonValue value;
  if (param.list && text.starts_with('[')) {
    std::vector<Problem> problems;
    if (!parse_json(text, source, value, problems)) {
      value = {};
      value.kind = Kind::string;
      value.text = text;
    }
    for (JsonValue& item : value.items) {
      item.line = item.column = 0;
      item.pointer = pointer;
    }
  } else if (param.list) {
    value.kind = Kind::array;
    for (std::string_view rest = text; !text.empty();) {
      const std::size_t comma = rest.find(',');
      value.items.push_back(scalar_of_text(rest.substr(0, comma), param.kind));
      value.items.back().source = &source;
      value.items.back().pointer = pointer;
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
  } else {
    value = scalar_of_text(text, param.kind);
  }
  value.source = &source;
  value.line = value.column = 0;
  value.pointer = pointer;
  return value;
}

std::optional<std::int64_t> parse_size(std::string_view text) {
  double amount = 0;
  const char* const end = text.data() + text.size();
  const auto [at, code] = std::from_chars(text.data(), end, amount, std::chars_format::fixed);
  if (code != std::errc() || !(amount >= 0)) return {};
  std::string_view unit(at, static_cast<std::size_t>(end - at));
  if (unit.starts_with(' ')) unit.remove_prefix(1);
  double bytes = 0;
  if (unit.empty() || unit == "B") bytes = 1;
  if (unit == "kB" || unit == "KB") bytes = 1e3;
  if (unit == "MB") bytes = 1e6;
  if (unit == "GB") bytes = 1e9;
  if (unit == "TB") bytes = 1e12;
  const double total = amount * bytes;
  if (bytes == 0 || total > most_exact) return {};
  return static_cast<std::int64_t>(std::llround(total));
}

}  // namespace engine
