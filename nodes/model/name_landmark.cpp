// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/name_landmark.h"

#include <charconv>
#include <optional>
#include <string_view>

#include "nodes/base/check.h"

namespace face::model {
namespace {

struct Name {
  std::string_view name;
  std::uint32_t point;  // of Multi-PIE's 68
};

// Multi-PIE's mark-up (Gross, Matthews, Cohn, Kanade, Baker: Multi-PIE, FG 2008), counted from 0.
constexpr Name names[] = {
    {"chin", 8},
    {"brow_outer_r", 17},
    {"brow_r", 19},
    {"brow_inner_r", 21},
    {"brow_inner_l", 22},
    {"brow_l", 24},
    {"brow_outer_l", 26},
    {"nose_bridge", 27},
    {"nose_tip", 30},
    {"nose_wing_r", 31},
    {"nose_base", 33},
    {"nose_wing_l", 35},
    {"eye_outer_r", 36},
    {"eye_inner_r", 39},
    {"eye_inner_l", 42},
    {"eye_outer_l", 45},
    {"mouth_corner_r", 48},
    {"upper_lip", 51},
    {"mouth_corner_l", 54},
    {"lower_lip", 57},
    {"inner_upper_lip", 62},
    {"inner_lower_lip", 66},
};
constexpr std::string_view contours[] = {"jaw_r", "jaw_l", "cheek_r", "cheek_l"};

std::optional<std::uint32_t> number(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

std::optional<std::uint32_t> number_after(std::string_view name, std::string_view prefix) {
  return name.starts_with(prefix) ? number(name.substr(prefix.size())) : std::nullopt;
}

std::optional<std::uint32_t> point_of(std::string_view name) {
  for (const Name& known : names)
    if (known.name == name) return known.point;
  if (const auto n = number(name); n && *n < 68) return n;
  if (const auto n = number_after(name, "lip_"); n && *n < 12) return 48 + *n;
  if (const auto n = number_after(name, "inner_lip_"); n && *n < 8) return 60 + *n;
  return {};
}

}  // namespace

NamedVertex name_landmark(const MorphableModel& model, const std::string& name) {
  if (const auto vertex = number_after(name, "vertex_")) {
    check(*vertex < model.mean.points_mm.size(), "the point \"", name, "\" asks for vertex ", *vertex,
          ", but the model has ", model.mean.points_mm.size());
    return {*vertex, false};
  }
  for (const std::string_view contour : contours)
    if (name == contour) return {0, true};
  if (name.starts_with("contour_")) return {0, true};
  const std::optional<std::uint32_t> point = point_of(name);
  if (!point)
    fail("the point \"", name,
         "\" has a name that no model knows, expected eye_inner_r, mouth_corner_l, nose_tip, chin, lip_0 to lip_11, "
         "jaw_r, cheek_l, contour_1, 0 to 67 (Multi-PIE), vertex_N or the like");
  if (*point < 17 && *point != 8) return {0, true};
  check(model.landmarks68.size() == 68, "the point \"", name, "\" needs a model with 68 landmarks, this one has ",
        model.landmarks68.size(), "; name the vertex itself: vertex_N");
  return {model.landmarks68[*point], false};
}

}  // namespace face::model
