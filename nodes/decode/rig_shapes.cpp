// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/rig_shapes.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "nodes/base/check.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/json_file.h"
#include "nodes/types/arkit.h"

namespace face::decode {
namespace {

// Offsets below this are rounding of the file's decimals, not motion.
constexpr float still_mm = 1e-4f;

// What stands between a name and those of the mesh, the deformer or the namespace before it.
constexpr std::string_view separators = ".:|/";

// Names are compared without case, '_', '-' and spaces.
std::string bare(std::string_view name) {
  std::string out;
  for (const char c : lower(std::string(name)))
    if (c != '_' && c != '-' && c != ' ') out += c;
  return out;
}

std::optional<std::string> arkit_named(std::string_view name) {
  const std::string wanted = bare(name);
  for (const std::string_view known : arkit_names)
    if (bare(known) == wanted) return std::string(known);
  return std::nullopt;
}

bool ends_with_any_case(std::string_view name, std::string_view end) {
  return name.size() > end.size() && lower(std::string(name.substr(name.size() - end.size()))) == end;
}

Shape sum(const Shape& a, const Shape& b) {
  Shape out{a.name, {}, {}};
  std::size_t i = 0, j = 0;
  while (i < a.vertices.size() || j < b.vertices.size()) {
    const std::uint32_t va = i < a.vertices.size() ? a.vertices[i] : UINT32_MAX;
    const std::uint32_t vb = j < b.vertices.size() ? b.vertices[j] : UINT32_MAX;
    Vec3f offset{};
    for (std::size_t k = 0; k < 3; ++k)
      offset[k] = (va <= vb ? a.offsets_mm[i][k] : 0) + (vb <= va ? b.offsets_mm[j][k] : 0);
    out.vertices.push_back(std::min(va, vb));
    out.offsets_mm.push_back(offset);
    if (va <= vb) ++i;
    if (vb <= va) ++j;
  }
  return out;
}

template <class Names>
std::string joined(const Names& names) {
  std::string out;
  for (const auto& name : names) {
    if (!out.empty()) out += ", ";
    out += name;
  }
  return out;
}

}  // namespace

std::string arkit_spelling(std::string_view name) {
  struct Side {
    std::string_view end, spelled;
  };
  // "_l" and the like before "l" alone, which no name is taken to end with.
  static constexpr Side sides[] = {{"_left", "Left"}, {"_right", "Right"}, {".left", "Left"}, {".right", "Right"},
                                   {"-left", "Left"}, {"-right", "Right"}, {"left", "Left"},  {"right", "Right"},
                                   {"_l", "Left"},    {"_r", "Right"},     {".l", "Left"},    {".r", "Right"},
                                   {"-l", "Left"},    {"-r", "Right"}};
  // Without more and more of what may stand before a name.
  for (std::string_view rest = name;;) {
    if (const auto known = arkit_named(rest)) return *known;
    std::string sided;  // if it is none of ARKit's
    for (const Side& side : sides) {
      if (!ends_with_any_case(rest, side.end)) continue;
      const std::string base(rest.substr(0, rest.size() - side.end.size()));
      if (const auto whole = arkit_named(base + std::string(side.spelled))) return *whole;
      if (const auto half = arkit_named(base)) return *half;
      sided = base + std::string(side.spelled);
      break;
    }
    const std::size_t separator =
        sided.empty() ? rest.find_first_of(separators) : std::string_view(sided).find_first_of(separators);
    const bool copy = separator != std::string_view::npos && separator + 1 < rest.size() &&
                      rest.find_first_not_of("0123456789", separator + 1) == std::string_view::npos;
    if (separator == std::string_view::npos || separator + 1 >= rest.size() || copy)
      return sided.empty() ? std::string(rest) : sided;
    rest.remove_prefix(separator + 1);
  }
}

std::string ShapeNames::in_rig(std::string_view name) const {
  const auto mapped = to_arkit.find(std::string(name));
  return mapped != to_arkit.end() ? mapped->second : arkit_spelling(name);
}

ShapeNames read_shape_names(const engine::File& file) {
  ShapeNames names{title_of(file), {}};
  const nlohmann::ordered_json json = read_json(file);
  if (!json.is_object())
    fail(names.title, ": found ", describe_json(json),
         ", expected an object of shape names and ARKit's names for them");
  for (const auto& [name, value] : json.items()) {
    const std::string arkit = value.is_string() ? value.get<std::string>() : std::string();
    if (value.is_string() && arkit.empty()) continue;  // not filled in
    if (arkit_index(arkit) == arkit_count)
      fail(names.title, " at /", name, ": found ", describe_json(value),
           ", expected one of ARKit's 52 names (jawOpen, ...)");
    names.to_arkit[name] = arkit;
  }
  return names;
}

void ShapeCollector::add(std::string_view name, const std::vector<Vec3f>& offsets_mm) {
  seen_.emplace(name);
  Shape shape{names_.in_rig(name), {}, {}};
  for (std::size_t v = 0; v < offsets_mm.size(); ++v) {
    const Vec3f& d = offsets_mm[v];
    if (std::abs(d[0]) <= still_mm && std::abs(d[1]) <= still_mm && std::abs(d[2]) <= still_mm) continue;
    shape.vertices.push_back(static_cast<std::uint32_t>(v));
    shape.offsets_mm.push_back(d);
  }
  const auto same = std::find_if(shapes_.begin(), shapes_.end(), [&](const Shape& s) { return s.name == shape.name; });
  if (same == shapes_.end())
    shapes_.push_back(std::move(shape));
  else
    *same = sum(*same, shape);
}

void ShapeCollector::finish(const std::string& title, Rig& rig) const {
  for (const auto& [name, arkit] : names_.to_arkit)
    if (!seen_.contains(name))
      fail(names_.title, " at /", name, ": ", title, " has no such shape. Found ",
           seen_.empty() ? "no shapes" : joined(seen_));
  rig.shapes.assign(arkit_count, {});
  for (std::size_t s = 0; s < arkit_count; ++s) rig.shapes[s].name = arkit_names[s];
  std::vector<bool> present(arkit_count, false);
  for (const Shape& shape : shapes_) {
    const std::size_t s = arkit_index(shape.name);
    if (s == arkit_count) {
      rig.shapes.push_back(shape);
    } else {
      rig.shapes[s] = shape;
      present[s] = true;
    }
  }
  rig.missing.clear();
  for (std::size_t s = 0; s < arkit_count; ++s)
    if (!present[s]) rig.missing.emplace_back(arkit_names[s]);
}

void expect_speech(const std::string& title, const Rig& rig) {
  const std::set<std::string_view> missing(rig.missing.begin(), rig.missing.end());
  std::vector<std::string_view> found, lacking;
  for (const Shape& shape : rig.shapes)
    if (!missing.contains(shape.name)) found.push_back(shape.name);
  for (const std::string_view needed : needed_shapes)
    if (missing.contains(needed)) lacking.push_back(needed);
  if (!lacking.empty())
    fail(title, ": lacks the shapes ", joined(lacking), "; a rig needs ", joined(needed_shapes), ". Found ",
         found.empty() ? "no shapes" : joined(found),
         rig.shapes.size() > arkit_count
             ? "; names that are not ARKit's are mapped by a file, which facegraph doctor proposes"
             : "");
  if (rig.shapes[arkit_index("jawOpen")].vertices.empty())
    fail(title,
         ": its jawOpen moves nothing: map a shape that opens the mouth to jawOpen, by a file, which facegraph doctor "
         "proposes");
}

}  // namespace face::decode
