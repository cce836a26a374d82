// SPDX-License-Identifier: Apache-2.0
#include "cli/preview.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "engine/describe/media.h"
#include "engine/describe/picture.h"
#include "engine/describe/view.h"
#include "engine/port.h"

namespace cli {
namespace {

using Json = nlohmann::ordered_json;
using engine::escape_markup;

constexpr std::size_t page_bytes = 24'000'000, most_file_bytes = 4'000'000, most_text = 4000, most_json_value = 400'000;
constexpr std::size_t shown_values = 6, measured_values = 32, curve_points = 2000, shortest_curve = 64;

// As many as are shown, from the first to the last.
std::vector<std::size_t> spread(std::size_t count, std::size_t most) {
  std::vector<std::size_t> chosen;
  if (count <= most)
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(i);
  else
    for (std::size_t i = 0; i < most; ++i) chosen.push_back(i * (count - 1) / (most - 1));
  return chosen;
}

std::string short_number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string cut(const std::string& text) {
  if (text.size() <= most_text) return escape_markup(text);
  std::size_t end = most_text;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return escape_markup(text.substr(0, end)) + "\u2026";
}

std::string caption_of(const std::string& element) {
  return element.empty() ? "" : "<figcaption>" + escape_markup(element) + "</figcaption>";
}

// {"columns": [...], "rows": [{"name": ..., "values": [...]}]} is a table, whatever type has that form.
std::string table_of(const Json& json) {
  if (!json.is_object() || !json.contains("columns") || !json.contains("rows") || !json["rows"].is_array() ||
      !json["columns"].is_array())
    return {};
  const auto cell = [](const Json& value) {
    return escape_markup(value.is_number()   ? short_number(value.get<double>())
                         : value.is_string() ? value.get<std::string>()
                         : value.is_null()   ? "\u2013"
                                             : value.dump());
  };
  std::string html = "<div class=\"wide\"><table><tr><th></th>";
  for (const Json& column : json["columns"]) html += "<th>" + cell(column) + "</th>";
  html += "</tr>";
  std::size_t rows = 0;
  for (const Json& row : json["rows"]) {
    if (!row.is_object() || !row.contains("values") || !row["values"].is_array()) return {};
    if (++rows > 60) continue;
    html += "<tr><th>" + cell(row.value("name", Json(""))) + "</th>";
    for (const Json& value : row["values"]) html += "<td>" + cell(value) + "</td>";
    html += "</tr>";
  }
  html += "</table></div>";
  return html + (rows > 60 ? "<p class=\"dim\">60 of " + std::to_string(rows) + " rows</p>" : "");
}

double number_of(const Json& json) {
  return json.is_number() ? json.get<double>() : json.is_boolean() ? json.get<bool>() : NAN;
}

// A curve, and what it goes from and to. `count`: how many there are of which these were chosen.
std::string drawn(const std::vector<double>& values, std::size_t count) {
  std::size_t finite = 0;
  double low = INFINITY, high = -INFINITY, sum = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    ++finite;
    sum += value;
    low = std::min(low, value), high = std::max(high, value);
  }
  if (finite == 0) return "<p class=\"dim\">No finite number.</p>";
  constexpr double width = 640, height = 110;
  std::string path;
  bool pen = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      pen = false;
      continue;
    }
    const double x =
        values.size() > 1 ? width * static_cast<double>(i) / static_cast<double>(values.size() - 1) : width / 2;
    const double y = high > low ? height * (high - values[i]) / (high - low) : height / 2;
    char text[64];
    std::snprintf(text, sizeof text, "%s%.1f %.1f", pen ? "L" : "M", x, y);
    path += text;
    pen = true;
  }
  return "<div><svg class=\"curve\" viewBox=\"-4 -4 648 118\" role=\"img\" aria-label=\"curve\"><path d=\"" + path +
         "\"/></svg><p class=\"dim\">" + std::to_string(count) + " values, " + short_number(low) + " to " +
         short_number(high) + ", mean " + short_number(sum / static_cast<double>(finite)) + "</p></div>";
}

// A long list of numbers is a curve: the samples of a sound, the times of frames.
std::string curve_in(const Json& json) {
  const Json* list = json.is_array() ? &json : nullptr;
  std::string name;
  if (json.is_object())
    for (const auto& [key, value] : json.items())
      if (value.is_array() && value.size() >= shortest_curve && (!list || value.size() > list->size()))
        list = &value, name = key;
  if (!list || list->size() < shortest_curve ||
      !std::all_of(list->begin(), list->end(), [](const Json& item) { return item.is_number(); }))
    return {};
  std::vector<double> values;
  for (const std::size_t i : spread(list->size(), curve_points)) values.push_back(number_of((*list)[i]));
  return (name.empty() ? "" : "<p class=\"dim\">" + escape_markup(name) + "</p>") + drawn(values, list->size());
}

}  // namespace

std::string base64(const std::string& bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    const std::size_t here = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < here ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= here ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

std::string Previews::picture(const std::string& bytes, const std::string& suffix, const std::string& caption) {
  if (bytes_ + bytes.size() * 4 / 3 > page_bytes)
    return "<p class=\"dim\">A picture is left out: the page is full.</p>";
  bytes_ += bytes.size() * 4 / 3;
  return "<figure><img loading=\"lazy\" alt=\"" + escape_markup(caption.empty() ? "picture" : caption) +
         "\" src=\"data:" + engine::media_of(suffix).mime + ";base64," + base64(bytes) + "\">" + caption_of(caption) +
         "</figure>";
}

std::string Previews::file(const engine::Value& value, const std::string& caption) {
  const engine::File& file = value.as<engine::File>();
  if (file.is_folder()) return "<p>A folder of files</p>";
  const std::string bytes = engine::view_value(value, "", plugins_), suffix = file.suffix();
  const engine::Media media = engine::media_of(suffix);
  if (media.element == "pre") return "<pre>" + cut(bytes.substr(0, most_text + 8)) + "</pre>" + caption_of(caption);
  if (!media.element.empty() && bytes.size() <= most_file_bytes) {
    if (media.element == "img") return picture(bytes, suffix, caption);
    if (bytes_ + bytes.size() * 4 / 3 <= page_bytes) {
      bytes_ += bytes.size() * 4 / 3;
      return "<figure><" + media.element + " controls preload=\"metadata\" src=\"data:" + media.mime + ";base64," +
             base64(bytes) + "\"></" + media.element + ">" + caption_of(caption) + "</figure>";
    }
  }
  return "<p>A file " + escape_markup(suffix) + " of " + show_size(bytes.size()) + "</p>";
}

std::string Previews::curve(const std::string& type, const engine::StoredOutput& output) {
  std::vector<double> values;
  for (const std::size_t i : spread(output.leaves.size(), curve_points)) {
    const auto value = engine::stored_value(type, output.leaves[i].identity, plugins_, store_);
    if (!value) return "<p class=\"dim\">Its values are not in the store.</p>";
    const Json json = Json::parse(value->type().show(value->data().get()), nullptr, false);
    values.push_back(number_of(json));
  }
  return drawn(values, output.leaves.size());
}

std::string Previews::show(const std::string& type, const engine::StoredOutput& output) {
  if (output.leaves.empty()) return "<p class=\"dim\">There is nothing.</p>";
  if (output.cheap) return "<p class=\"dim\">Its values are made when they are read, and not kept.</p>";
  const bool numbers = type == "number" || type == "integer" || type == "flag";
  if (numbers && output.leaves.size() > 1) return curve(type, output);
  std::string html;
  const auto chosen = spread(output.leaves.size(), shown_values);
  for (const std::size_t i : chosen) {
    const engine::StoredLeaf& leaf = output.leaves[i];
    const auto value = engine::stored_value(type, leaf.identity, plugins_, store_);
    if (!value) {
      html += "<p class=\"dim\">It is not in the store.</p>";
      continue;
    }
    try {
      if (type == "file") {
        html += file(*value, leaf.element);
        continue;
      }
      const auto& views = value->type().views;
      const auto png = std::find_if(views.begin(), views.end(), [](const auto& view) { return view.suffix == "png"; });
      if (png != views.end()) {
        html += picture(engine::view_value(*value, ".png", plugins_), ".png", leaf.element);
        continue;
      }
      if (value->size_bytes() > most_json_value) {
        html += "<p class=\"dim\">" + show_size(value->size_bytes()) + ", too much to show here</p>";
        break;
      }
      const std::string text = value->type().show(value->data().get());
      const Json json = Json::parse(text, nullptr, false);
      std::string table = json.is_discarded() ? "" : table_of(json);
      if (table.empty() && !json.is_discarded()) table = curve_in(json);
      const std::string plain = json.is_string()   ? json.get<std::string>()
                                : json.is_number() ? short_number(json.get<double>())
                                                   : text;
      html += (leaf.element.empty() ? "" : "<p class=\"dim\">" + escape_markup(leaf.element) + "</p>") +
              (table.empty() ? "<pre>" + cut(plain) + "</pre>" : table);
      if (chosen.size() > 3 && i == chosen[2] && png == views.end()) break;
    } catch (const std::exception& error) {
      html += "<p class=\"dim\">It cannot be shown: " + escape_markup(error.what()) + "</p>";
    }
  }
  return html;
}

std::string Previews::size(const std::string& type, const engine::StoredOutput& output) {
  const std::size_t count = output.leaves.size();
  const std::string values = std::to_string(count) + (count == 1 ? " value" : " values");
  if (output.cheap || count == 0) return values;
  const auto measured = spread(count, measured_values);
  double bytes = 0;
  for (const std::size_t i : measured) {
    const std::int64_t one = engine::stored_bytes(type, output.leaves[i].identity, store_);
    if (one < 0) return values + ", not all in the store";
    bytes += static_cast<double>(one);
  }
  const bool all = measured.size() == count;
  const auto total =
      static_cast<std::uint64_t>(bytes * static_cast<double>(count) / static_cast<double>(measured.size()));
  return (all ? "" : "about ") + show_size(total) + (count == 1 ? "" : " in " + values);
}

}  // namespace cli
