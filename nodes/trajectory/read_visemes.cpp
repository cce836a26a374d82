// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/read_visemes.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>

#include "nodes/base/check.h"
#include "nodes/base/edit_distance.h"
#include "nodes/types/arkit.h"

namespace face::trajectory {
namespace {

using Json = nlohmann::ordered_json;
using Groups = std::map<std::string, std::vector<std::size_t>>;

// The labels that a table must hold, and after the bar those that it may.
constexpr std::array<std::string_view, 56> labels = {
    "AA",  "AE",  "AH",  "AO",  "AW",  "AY",  "B",   "CH",  "D",   "DH",  "EH",   "ER",   "EY",   "F",
    "G",   "HH",  "IH",  "IY",  "JH",  "K",   "L",   "M",   "N",   "NG",  "OW",   "OY",   "P",    "R",
    "S",   "SH",  "T",   "TH",  "UH",  "UW",  "V",   "W",   "Y",   "Z",   "ZH",   "SIL",  "P.c",  "P.r",
    "B.c", "B.r", "T.c", "T.r", "D.c", "D.r", "K.c", "K.r", "G.c", "G.r", "CH.c", "CH.r", "JH.c", "JH.r"};
constexpr std::size_t needed_labels = 52;

std::string nearest(std::string_view name, const std::vector<std::string>& names) {
  return *std::min_element(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
    return edit_distance(name, a) < edit_distance(name, b);
  });
}

// A place in the file; errors start with it.
struct Place {
  const std::string& title;
  std::string pointer;
  Place operator/(const std::string& key) const { return {title, pointer + "/" + key}; }
  template <class... Parts>
  [[noreturn]] void error(const Parts&... parts) const {
    fail(title, ": ", pointer.empty() ? std::string("the table") : pointer, " ", parts...);
  }
};

std::string shown(const Json& value) {
  std::string text = value.dump();
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  return text;
}

const Json& object_at(const Json& value, const Place& place) {
  if (!value.is_object()) place.error("is ", shown(value), ", expected an object {...}");
  return value;
}

double number_at(const Json& value, const Place& place, double low, double high) {
  if (!value.is_number() || value.get<double>() < low || value.get<double>() > high)
    place.error("is ", shown(value), ", expected a number from ", low, " to ", high);
  return value.get<double>();
}

void check_keys(const Json& object, const Place& place, const std::vector<std::string>& known) {
  for (const auto& [key, value] : object_at(object, place).items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      (place / key).error("is not known here; did you mean \"", nearest(key, known), "\"?");
}

// The indices of a shape: one, or left and right of a name that lacks the side. Empty where it is none.
std::vector<std::size_t> find_shapes(const std::string& name) {
  if (const std::size_t index = arkit_index(name); index < arkit_count) return {index};
  const std::size_t left = arkit_index(name + "Left");
  const std::size_t right = arkit_index(name + "Right");
  // jawLeft and mouthLeft are no sides of "jaw" and "mouth".
  if (left == arkit_count || right == arkit_count || name == "jaw" || name == "mouth") return {};
  return {left, right};
}

std::vector<std::size_t> shapes_at(const std::string& name, const Place& place) {
  std::vector<std::size_t> found = find_shapes(name);
  if (!found.empty()) return found;
  std::vector<std::string> names;
  for (const std::string_view arkit : arkit_names) {
    names.emplace_back(arkit);
    for (const std::string_view side : {"Left", "Right"}) {
      const std::string stem(arkit.substr(0, arkit.size() > side.size() ? arkit.size() - side.size() : 0));
      if (arkit.ends_with(side) && !find_shapes(stem).empty()) names.push_back(stem);
    }
  }
  place.error("names \"", name, "\", which is not one of ARKit's 52 shapes; did you mean \"", nearest(name, names),
              "\"?");
}

std::vector<float> weights_at(const Json& object, const Place& place) {
  std::vector<float> weights(arkit_count, 0.0f);
  for (const auto& [name, value] : object_at(object, place).items())
    for (const std::size_t shape : shapes_at(name, place / name))
      weights[shape] = static_cast<float>(number_at(value, place / name, 0, 1));
  return weights;
}

// Groups first, then single shapes, whatever their order in the file.
void apply_sigmas(const Json& object, const Place& place, const Groups& groups, std::vector<float>& sigmas) {
  for (const bool single : {false, true})
    for (const auto& [name, value] : object_at(object, place).items()) {
      const auto group = groups.find(name);
      if ((group == groups.end()) != single) continue;
      const auto sigma = static_cast<float>(number_at(value, place / name, 0.02, 10));
      for (const std::size_t shape : single ? shapes_at(name, place / name) : group->second) sigmas[shape] = sigma;
    }
}

Viseme viseme_at(const std::string& label, const Json& entry, const Place& place, const Groups& groups,
                 const Json& defaults, const Place& defaults_place) {
  check_keys(entry, place, {"weights", "glide", "sigma", "sigmas", "contact", "open_mm"});
  Viseme viseme;
  viseme.label = label;
  if (!entry.contains("weights")) place.error("has no \"weights\", expected the target of every shape that moves");
  viseme.weights = weights_at(entry["weights"], place / "weights");
  if (entry.contains("glide")) {
    const Place glide_place = place / "glide";
    const Json& glide = object_at(entry["glide"], glide_place);
    check_keys(glide, glide_place, {"from", "weights"});
    if (!glide.contains("from") || !glide.contains("weights"))
      glide_place.error("is ", shown(glide), ", expected {\"from\": share of the length, \"weights\": {...}}");
    viseme.glide_from = number_at(glide["from"], glide_place / "from", 0, 1);
    viseme.glide_weights = weights_at(glide["weights"], glide_place / "weights");
  }
  double sigma = number_at(defaults["sigma"], defaults_place / "sigma", 0.02, 10);
  if (entry.contains("sigma")) sigma = number_at(entry["sigma"], place / "sigma", 0.02, 10);
  viseme.sigmas.assign(arkit_count, static_cast<float>(sigma));
  if (defaults.contains("sigmas")) apply_sigmas(defaults["sigmas"], defaults_place / "sigmas", groups, viseme.sigmas);
  if (entry.contains("sigmas")) apply_sigmas(entry["sigmas"], place / "sigmas", groups, viseme.sigmas);
  if (entry.contains("contact")) {
    if (entry["contact"] != "lips" && entry["contact"] != "teeth")
      (place / "contact").error("is ", shown(entry["contact"]), ", expected \"lips\" or \"teeth\"");
    viseme.contact = entry["contact"];
  }
  if (entry.contains("open_mm")) viseme.open_mm = number_at(entry["open_mm"], place / "open_mm", 0, 30);
  return viseme;
}

Groups groups_at(const Json& table, const Place& place) {
  Groups groups;
  if (!table.contains("groups")) return groups;
  for (const auto& [name, members] : object_at(table["groups"], place).items()) {
    if (!members.is_array()) (place / name).error("is ", shown(members), ", expected a list of shape names");
    if (!find_shapes(name).empty()) (place / name).error("is the name of a shape, expected another name for a group");
    for (std::size_t i = 0; i < members.size(); ++i) {
      const Place member = place / name / std::to_string(i);
      if (!members[i].is_string()) member.error("is ", shown(members[i]), ", expected a shape name");
      for (const std::size_t shape : shapes_at(members[i], member)) groups[name].push_back(shape);
    }
  }
  return groups;
}

}  // namespace

Visemes read_visemes(const engine::File& file) {
  const std::string title = file.name().empty() ? std::string("the viseme table") : file.name();
  std::string text;
  if (file.in_memory()) {
    text = file.bytes();
  } else {
    std::ifstream stream(file.path(), std::ios::binary);
    check(!file.is_folder() && stream.good(), title, ": cannot be read as a file");
    std::ostringstream content;
    content << stream.rdbuf();
    text = content.str();
  }
  Json table;
  try {
    table = Json::parse(text);
  } catch (const Json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    fail(title, ": line ", 1 + std::count(text.begin(), end, '\n'), " is not JSON, expected a viseme table");
  }
  const Place root{title, ""};
  check_keys(table, root, {"about", "groups", "defaults", "visemes"});
  if (!table.contains("visemes")) root.error("has no \"visemes\", expected one entry per phone");
  if (!table.contains("defaults")) table["defaults"] = Json::object();
  check_keys(table["defaults"], root / "defaults", {"sigma", "sigmas"});
  if (!table["defaults"].contains("sigma")) table["defaults"]["sigma"] = 0.45;
  const Groups groups = groups_at(table, root / "groups");

  const Place place = root / "visemes";
  const std::vector<std::string> known(labels.begin(), labels.end());
  Visemes visemes;
  for (const auto& [label, entry] : object_at(table["visemes"], place).items()) {
    if (std::find(known.begin(), known.end(), label) == known.end())
      (place / label).error("is not a phone of the CMU dictionary; did you mean \"", nearest(label, known), "\"?");
    visemes.visemes.push_back(viseme_at(label, entry, place / label, groups, table["defaults"], root / "defaults"));
  }
  std::string missing;
  for (std::size_t i = 0; i < needed_labels; ++i)
    if (!table["visemes"].contains(labels[i])) missing += (missing.empty() ? "" : ", ") + known[i];
  if (!missing.empty())
    place.error("lacks ", missing, "; expected the 39 phones, SIL, and closure and release of P B T D K G");
  return visemes;
}

}  // namespace face::trajectory
