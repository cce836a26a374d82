// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/phones_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "nodes/base/check.h"

namespace face {
namespace {

using Json = nlohmann::json;

// 1-based line of a byte of the text.
std::size_t line_of(std::string_view text, std::size_t byte) {
  return 1 + static_cast<std::size_t>(std::count(
                 text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size())), '\n'));
}

std::string found_text(const Json& object, const char* key) {
  return object.contains(key) ? object[key].dump() : std::string("nothing");
}

}  // namespace

std::string write_phones_json(const Phones& phones) {
  std::string out = "[";
  for (std::size_t i = 0; i < phones.phones.size(); ++i) {
    const Phone& phone = phones.phones[i];
    out += message(i == 0 ? "\n" : ",\n", "  {\"phone\": ", Json(phone.label).dump(),
                   ", \"start_s\": ", Json(phone.start_s).dump(), ", \"end_s\": ", Json(phone.end_s).dump());
    if (!phone.word.empty()) out += message(", \"word\": ", Json(phone.word).dump());
    if (phone.score != 0) out += message(", \"score\": ", Json(phone.score).dump());
    out += "}";
  }
  out += "\n]\n";
  return out;
}

Phones parse_phones_json(std::string_view text, const std::string& name) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::parse_error& error) {
    fail(name, ":", line_of(text, error.byte > 0 ? error.byte - 1 : 0),
         ": this is not JSON: expected a list of phones");
  }
  check(json.is_array(), name, ": found ", json.type_name(), ", expected a list of phones");
  Phones phones;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const Json& object = json[i];
    check(object.is_object(), name, ": /", i, ": found ", object.type_name(), ", expected an object");
    const auto number = [&](const char* key) {
      check(object.contains(key) && object[key].is_number(), name, ": /", i, "/", key, ": found ",
            found_text(object, key), ", expected a number of seconds");
      return object[key].get<double>();
    };
    Phone phone;
    check(object.contains("phone") && object["phone"].is_string(), name, ": /", i, "/phone: found ",
          found_text(object, "phone"), ", expected a text");
    phone.label = object["phone"].get<std::string>();
    phone.start_s = number("start_s");
    phone.end_s = number("end_s");
    check(phone.end_s >= phone.start_s, name, ": /", i, "/end_s: found ", phone.end_s,
          ", expected no less than start_s = ", phone.start_s);
    if (object.contains("word")) {
      check(object["word"].is_string(), name, ": /", i, "/word: found ", object["word"].dump(), ", expected a text");
      phone.word = object["word"].get<std::string>();
    }
    if (object.contains("score")) phone.score = number("score");
    phones.duration_s = phone.end_s;
    phones.phones.push_back(std::move(phone));
  }
  return phones;
}

}  // namespace face
