// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_corrections.h"

#include <map>
#include <nlohmann/json.hpp>

#include "nodes/base/check.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/json_file.h"

namespace face::decode {

engine::Seq<Landmarks> read_corrections(const engine::File& file) {
  const std::string title = title_of(file);
  const nlohmann::ordered_json json = read_json(file);
  if (!json.is_array()) fail(title, ": found ", describe_json(json), ", expected a list of corrections");
  std::map<long, Landmarks> frames;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const std::string at = message("/", i);
    const long frame = json_index(json_member(json[i], "frame", title, at), title, at + "/frame");
    const auto& name = json_member(json[i], "point", title, at);
    if (!name.is_string()) fail(title, " at ", at, "/point: found ", describe_json(name), ", expected a point's name");
    Landmark point{name.get<std::string>(), 0, 0, true};
    json_xy(json_member(json[i], "xy", title, at), title, at + "/xy", point.x_px, point.y_px);
    for (const Landmark& other : frames[frame].points)
      if (other.name == point.name)
        fail(title, " at ", at, ": found a second correction of ", point.name, " in frame ", frame, ", expected one");
    frames[frame].points.push_back(point);
  }
  std::vector<Landmarks> values;
  std::vector<std::string> ids;
  for (auto& [frame, landmarks] : frames) {
    values.push_back(std::move(landmarks));
    ids.push_back(std::to_string(frame));
  }
  return {std::move(values), std::move(ids)};
}

}  // namespace face::decode
