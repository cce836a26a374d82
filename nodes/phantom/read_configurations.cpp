// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/read_configurations.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/types/arkit.h"

namespace face::phantom {
namespace {

using Json = nlohmann::ordered_json;

// One or two indices into arkit_names.
std::vector<std::size_t> shapes_called(const std::string& name, const std::string& where) {
  std::vector<std::size_t> shapes;
  for (const std::string& full : {name, name + "Left", name + "Right"})
    if (arkit_index(full) < arkit_count) shapes.push_back(arkit_index(full));
  check(!shapes.empty(), where, ": no ARKit shape is called \"", name, "\"");
  return shapes;
}

}  // namespace

void read_configurations(const engine::File& file, engine::SeqWriter<Weights>& weights) {
  std::ifstream in(file.path(), std::ios::binary);
  check(in.good(), file.name(), ": cannot be read");
  Json json;
  try {
    json = Json::parse(in, nullptr, true, true);
  } catch (const Json::parse_error& error) {
    fail(file.name(), ": ", error.what());
  }
  check(json.is_object() && !json.empty(), file.name(), ": expected an object of faces by name");
  for (const auto& [name, face] : json.items()) {
    const std::string where = file.name() + ": " + name;
    check(face.is_object(), where, ": expected an object of weights by ARKit name");
    Weights made;
    made.values.assign(arkit_count, 0.0f);
    for (const auto& [shape, weight] : face.items()) {
      check(weight.is_number() && weight >= 0.0 && weight <= 1.0, where, ": ", shape, " is ", weight.dump(),
            ", expected a number from 0 to 1");
      for (const std::size_t index : shapes_called(shape, where)) made.values[index] = weight.get<float>();
    }
    weights.push(name, std::move(made));
  }
}

}  // namespace face::phantom
