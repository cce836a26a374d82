// SPDX-License-Identifier: Apache-2.0
#include "cli/preview.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/curves.h"
#include "cli/experiments.h"
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

constexpr const char* style = R"(
:root{color-scheme:light;--line:#d5dce4;--dim:#5a6b7d}
*{box-sizing:border-box}
body{margin:0;font:15px/1.5 system-ui,"Segoe UI",Helvetica,Arial,sans-serif;color:#1d2733;background:#f5f7f9}
main{max-width:72rem;margin:0 auto;padding:1rem}
h1{font-size:1.5rem;margin:.5rem 0}h2{font-size:1.15rem;margin:1.5rem 0 .5rem}
h3{font-size:1rem;margin:.9rem 0 .3rem;font-weight:600}h1,h2,h3,p{overflow-wrap:anywhere}
section{background:#fff;border:1px solid var(--line);border-radius:6px;padding:.8rem 1rem;margin:.8rem 0}
section:target{border-color:#5a86c4;box-shadow:0 0 0 2px #cfe0f6}
.wide{overflow-x:auto;max-width:100%}
.dim{color:var(--dim);margin:.2rem 0}.bad{color:#a8281f}.warn{color:#8a5a00}
table{border-collapse:collapse;font-size:.9rem}th,td{border-bottom:1px solid var(--line);padding:.2rem .6rem;text-align:left;vertical-align:top}
td{font-variant-numeric:tabular-nums;overflow-wrap:break-word}
pre{background:#f3f5f7;border-radius:4px;padding:.5rem;margin:.3rem 0;overflow:auto;max-height:18rem;white-space:pre-wrap;overflow-wrap:anywhere;font-size:.85rem}
.previews{display:flex;flex-wrap:wrap;gap:.6rem;align-items:flex-start}.previews>*{max-width:100%}.previews>pre,.previews>.wide{flex:1 1 16rem}
figure{margin:0}figure>:first-child{max-width:100%;max-height:22rem;border:1px solid var(--line);background:#fff}
figcaption{font-size:.8rem;color:var(--dim)}
svg.curve{width:40rem;max-width:100%;background:#f3f5f7}svg.curve path{fill:none;stroke:#2f6bb3;stroke-width:1.5;vector-effect:non-scaling-stroke}
.changed{font-weight:600}
)";

// As many as are shown, from the first to the last.
std::vector<std::size_t> spread(std::size_t count, std::size_t most) {
  std::vector<std::size_t> chosen;
  if (count <= most)
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(i);
  else
    for (std::size_t i = 0; i < most; ++i) chosen.push_back(i * (count - 1) / (most - 1));
  return chosen;
}

std::string cut(const std::string& text) {
  return escape_markup(beginning(text, most_text)) + (text.size() > most_text ? "\u2026" : "");
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
  return (name.empty() ? "" : "<p class=\"dim\">" + escape_markup(name) + "</p>") + curve_html(values, list->size());
}

// The one list of numbers that a value is, or has beside single values; null otherwise.
const Json* number_list(const Json& json) {
  const Json* list = nullptr;
  const auto look = [&](const Json& value) {
    if (!value.is_array()) return true;
    const bool numbers = std::all_of(value.begin(), value.end(), [](const Json& item) { return item.is_number(); });
    if (!numbers || list) return false;
    list = &value;
    return true;
  };
  if (json.is_array()) return look(json) ? list : nullptr;
  if (!json.is_object()) return nullptr;
  for (const auto& [key, value] : json.items())
    if (!look(value)) return nullptr;
  return list;
}

}  // namespace

std::string html_page(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width, initial-scale=1\"><link rel=\"icon\" href=\"data:,\"><title>" +
         escape_markup(title) + "</title><style>" + style + "</style><body><main>\n" + body + "</main></body></html>\n";
}

std::string table_html(const std::string& json) { return table_of(Json::parse(json, nullptr, false)); }

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
    return embedded(bytes, media, caption);
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
  return curve_html(values, output.leaves.size());
}

std::string Previews::lists(const std::string& type, const engine::StoredOutput& output) {
  constexpr std::size_t fewest = 8, most_points = 400, most_bytes = 20'000;
  if (output.leaves.size() < fewest || type == "file" || type == "text") return {};
  std::vector<std::vector<double>> all;
  for (const std::size_t i : spread(output.leaves.size(), most_points)) {
    const auto value = engine::stored_value(type, output.leaves[i].identity, plugins_, store_);
    if (!value || value->size_bytes() > most_bytes || !value->type().views.empty()) return {};
    const Json json = Json::parse(value->type().show(value->data().get()), nullptr, false);
    const Json* list = number_list(json);
    if (!list) return {};
    auto& numbers = all.emplace_back();
    for (const Json& number : *list) numbers.push_back(number.get<double>());
  }
  return curves_html(all, output.leaves.size());
}

std::string Previews::value(const engine::Value& value, const std::string& caption) {
  try {
    if (value.type().name == "file") return file(value, caption);
    for (const auto& view : value.type().views) {
      const engine::Media media = engine::media_of("." + view.suffix);
      if (media.element == "img")
        return picture(engine::view_value(value, "." + view.suffix, plugins_), "." + view.suffix, caption);
      if (media.element == "audio" && value.size_bytes() <= most_file_bytes)
        return embedded(engine::view_value(value, "." + view.suffix, plugins_), media, caption) +
               (value.size_bytes() > most_json_value
                    ? ""
                    : curve_in(Json::parse(value.type().show(value.data().get()), nullptr, false)));
    }
    const std::string name = caption.empty() ? "" : "<p class=\"dim\">" + escape_markup(caption) + "</p>";
    if (value.size_bytes() > most_json_value)
      return name + "<p class=\"dim\">" + show_size(value.size_bytes()) + ", too much to show here</p>";
    const std::string text = value.type().show(value.data().get());
    const Json json = Json::parse(text, nullptr, false);
    std::string table = json.is_discarded() ? "" : table_of(json);
    if (table.empty() && !json.is_discarded()) table = curve_in(json);
    const std::string plain = json.is_string()   ? json.get<std::string>()
                              : json.is_number() ? short_number(json.get<double>())
                                                 : text;
    return name + (table.empty() ? "<pre>" + cut(plain) + "</pre>" : table);
  } catch (const std::exception& error) {
    return "<p class=\"dim\">It cannot be shown: " + escape_markup(error.what()) + "</p>";
  }
}

std::string Previews::embedded(const std::string& bytes, const engine::Media& media, const std::string& caption) {
  if (bytes_ + bytes.size() * 4 / 3 > page_bytes)
    return "<p class=\"dim\">" + media.element + " is left out: the page is full.</p>";
  bytes_ += bytes.size() * 4 / 3;
  return "<figure><" + media.element + " controls preload=\"metadata\" src=\"data:" + media.mime + ";base64," +
         base64(bytes) + "\"></" + media.element + ">" + caption_of(caption) + "</figure>";
}

std::string Previews::show(const std::string& type, const engine::StoredOutput& output) {
  if (output.leaves.empty()) return "<p class=\"dim\">There is nothing.</p>";
  if (output.cheap) return "<p class=\"dim\">Its values are made when they are read, and not kept.</p>";
  const bool numbers = type == "number" || type == "integer" || type == "flag";
  if (numbers && output.leaves.size() > 1) return curve(type, output);
  std::string html = lists(type, output);
  if (!html.empty()) return html;
  const auto chosen = spread(output.leaves.size(), shown_values);
  for (const std::size_t i : chosen) {
    const engine::StoredLeaf& leaf = output.leaves[i];
    const auto value = engine::stored_value(type, leaf.identity, plugins_, store_);
    if (!value) {
      html += "<p class=\"dim\">It is not in the store.</p>";
      continue;
    }
    html += this->value(*value, leaf.element);
    const auto& views = value->type().views;
    const bool pictured =
        std::any_of(views.begin(), views.end(), [](const auto& view) { return view.suffix == "png"; });
    if (type != "file" && !pictured && value->size_bytes() > most_json_value) break;
    if (type != "file" && !pictured && chosen.size() > 3 && i == chosen[2]) break;
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
