// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/metric.h"

#include <charconv>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace engine {
namespace {

using Json = nlohmann::ordered_json;

std::string what_it_has(const Json& value) {
  if (value.is_object()) {
    std::vector<std::string> names;
    for (const auto& [key, item] : value.items()) names.push_back("'" + key + "'");
    std::string text = "an object with ";
    for (std::size_t i = 0; i < names.size() && i < 12; ++i) text += (i == 0 ? "" : ", ") + names[i];
    return text + (names.size() > 12 ? ", ..." : "");
  }
  if (value.is_array()) return "a list of " + std::to_string(value.size());
  if (value.is_null()) return "no number";
  return value.is_string() ? "a text" : value.dump();
}

const Json* step(const Json& value, const std::string& name) {
  if (value.is_object()) {
    const auto found = value.find(name);
    return found == value.end() ? nullptr : &*found;
  }
  if (!value.is_array()) return nullptr;
  for (const Json& item : value)
    if (item.is_object() && item.contains("name") && item["name"] == name) return &item;
  std::size_t index = 0;
  const auto [end, code] = std::from_chars(name.data(), name.data() + name.size(), index);
  return code == std::errc() && end == name.data() + name.size() && index < value.size() ? &value[index] : nullptr;
}

}  // namespace

bool parse_metric(std::string_view text, Metric& metric, std::string& error) {
  metric = {};
  // Ids of nodes in subgraphs have slashes too: a path begins behind the output.
  std::size_t from = text.find('.');
  if (const std::size_t bracket = text.find('['); bracket != std::string_view::npos)
    from = std::min(text.find(']', bracket), text.size());
  const std::size_t slash = from == std::string_view::npos ? from : text.find('/', from);
  if (!parse_reference(text.substr(0, slash), metric.reference, error)) return false;
  for (std::size_t at = slash; at != std::string_view::npos;) {
    const std::size_t next = text.find('/', at + 1);
    metric.path.emplace_back(text.substr(at + 1, next == std::string_view::npos ? next : next - at - 1));
    if (metric.path.back().empty()) {
      error = "'" + std::string(text) + "' is no number's name: a step of its path is empty";
      return false;
    }
    at = next;
  }
  return true;
}

double number_at(const std::string& json, const std::vector<std::string>& path) {
  const Json root = Json::parse(json, nullptr, false);
  if (root.is_discarded()) throw std::invalid_argument("its JSON form cannot be read");
  const Json* value = &root;
  std::string at = "the value";
  for (const std::string& name : path) {
    const Json* const next = step(*value, name);
    if (!next) throw std::invalid_argument(at + " is " + what_it_has(*value) + ": there is no '" + name + "' in it");
    at = "'" + name + "'";
    value = next;
  }
  if (value->is_boolean()) return value->get<bool>() ? 1 : 0;
  if (!value->is_number())
    throw std::invalid_argument(at + " is " + what_it_has(*value) + ", expected a number" +
                                (value->is_structured() ? ": name one in it with /" : ""));
  return value->get<double>();
}

}  // namespace engine
