// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/port.h"

namespace face::decode {

// A JSON file, members in the file's order. Throws with file, line and column where it is not JSON.
nlohmann::ordered_json read_json(const engine::File& file);

// What a value is, for messages: its kind, and the value itself where it is short.
std::string describe_json(const nlohmann::ordered_json& value);

// The member of an object; throws "FILE at /pointer: found ..., expected an object with \"key\"".
const nlohmann::ordered_json& json_member(const nlohmann::ordered_json& object, const char* key,
                                          const std::string& title, const std::string& pointer);

// A finite number, or "FILE at /pointer: found ..., expected a number".
double json_number(const nlohmann::ordered_json& value, const std::string& title, const std::string& pointer);

// A whole number from 0, or the like.
long json_index(const nlohmann::ordered_json& value, const std::string& title, const std::string& pointer);

// A pair of numbers.
void json_xy(const nlohmann::ordered_json& value, const std::string& title, const std::string& pointer, double& x,
             double& y);

}  // namespace face::decode
