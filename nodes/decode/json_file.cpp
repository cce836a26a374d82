// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/json_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "nodes/base/check.h"
#include "nodes/decode/input_file.h"

namespace face::decode {

nlohmann::ordered_json read_json(const engine::File& file) {
  const std::string text = read_bytes(file);
  check(!text.empty(), title_of(file), ": is empty, expected JSON");
  try {
    return nlohmann::ordered_json::parse(text, nullptr, true, true);
  } catch (const nlohmann::ordered_json::parse_error& error) {
    const std::size_t byte = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
    const auto at = text.begin() + static_cast<std::ptrdiff_t>(byte);
    const auto line = 1 + std::count(text.begin(), at, '\n');
    const std::size_t newline = byte > 0 ? text.rfind('\n', byte - 1) : std::string::npos;
    const std::size_t column = newline == std::string::npos ? byte + 1 : byte - newline;
    fail(title_of(file), " line ", line, " column ", column, ": is not JSON: found ",
         byte < text.size() ? "'" + text.substr(byte, 1) + "'" : "the end of the file", " where the text cannot go on");
  } catch (const nlohmann::ordered_json::out_of_range& error) {
    // "... number overflow parsing '1e400'"
    const std::string said = error.what();
    const std::size_t quote = std::min(said.find('\''), said.size() - 1);
    const std::string number = said.substr(quote + 1, said.rfind('\'') - quote - 1);
    const auto at = text.begin() + static_cast<std::ptrdiff_t>(std::min(text.find(number), text.size()));
    fail(title_of(file), " line ", 1 + std::count(text.begin(), at, '\n'), ": found ", number,
         ", expected a number of at most 1.8e308 in size");
  }
}

std::string describe_json(const nlohmann::ordered_json& value) {
  const std::string text = value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  return text.size() <= 40 ? text : std::string(value.type_name()) + " " + text.substr(0, 36) + "...";
}

const nlohmann::ordered_json& json_member(const nlohmann::ordered_json& object, const char* key,
                                          const std::string& title, const std::string& pointer) {
  const bool present = object.is_object() && object.contains(key);
  if (!present)
    fail(title, pointer.empty() ? "" : " at ", pointer, ": found ", describe_json(object),
         ", expected an object with \"", key, "\"");
  return object[key];
}

double json_number(const nlohmann::ordered_json& value, const std::string& title, const std::string& pointer) {
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    fail(title, " at ", pointer, ": found ", describe_json(value), ", expected a number");
  return value.get<double>();
}

long json_index(const nlohmann::ordered_json& value, const std::string& title, const std::string& pointer) {
  if (!value.is_number_integer() || value.get<long>() < 0)
    fail(title, " at ", pointer, ": found ", describe_json(value), ", expected a whole number from 0");
  return value.get<long>();
}

void json_xy(const nlohmann::ordered_json& value, const std::string& title, const std::string& pointer, double& x,
             double& y) {
  if (!value.is_array() || value.size() != 2)
    fail(title, " at ", pointer, ": found ", describe_json(value), ", expected [x, y] in pixels");
  x = json_number(value[0], title, pointer + "/0");
  y = json_number(value[1], title, pointer + "/1");
}

}  // namespace face::decode
