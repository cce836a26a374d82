// SPDX-License-Identifier: Apache-2.0
#include "engine/base/problem.h"

#include <algorithm>
#include <cctype>

namespace engine {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same =
          std::tolower(static_cast<unsigned char>(a[i - 1])) == std::tolower(static_cast<unsigned char>(b[j - 1]));
      const std::size_t substituted = diagonal + (same ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({substituted, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string Problem::line() const {
  std::string text_line = place.file;
  if (place.line > 0) text_line += ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
  if (!place.pointer.empty()) text_line += ": " + place.pointer;
  return text_line + (text_line.empty() ? "" : ": ") + text;
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_name(name, candidates);
  return nearest.empty() ? "" : " (did you mean '" + nearest + "'?)";
}

std::string listed(const std::vector<std::string>& names, const char* last) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? std::string(" ") + last + " " : ", ";
    text += "'" + names[i] + "'";
  }
  return text;
}

std::string did_you_mean_of(std::string_view name, const std::vector<std::string>& names) {
  const std::string nearest = did_you_mean(name, names);
  if (!nearest.empty()) return nearest;
  return names.empty() ? "; it has none" : "; it has " + listed(names);
}

}  // namespace engine
