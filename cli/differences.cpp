// SPDX-License-Identifier: Apache-2.0
#include "cli/differences.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "cli/curves.h"
#include "cli/experiments.h"
#include "cli/interrupt.h"
#include "cli/number_difference.h"
#include "engine/describe/media.h"
#include "engine/describe/picture.h"
#include "engine/run/run.h"

namespace cli {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::size_t most_bytes = 20'000'000;         // of values that are compared number by number
constexpr std::size_t most_known_bytes = 400'000'000;  // of values that a difference compares
constexpr std::size_t most_pairs = 500;                // of values of one output that are

Json shown_json(const engine::Value& value) {
  return Json::parse(value.type().show(value.data().get()), nullptr, false);
}

bool is_table(const Json& json) {
  return json.is_object() && json.contains("columns") && json.contains("rows") && json["columns"].is_array() &&
         json["rows"].is_array() && !json["rows"].empty() && json["rows"][0].contains("values");
}

bool is_pictured(const engine::Value& value) {
  for (const auto& view : value.type().views)
    if (engine::media_of("." + view.suffix).element == "img") return true;
  return false;
}

// A number of a table: one that is not finite is null in JSON.
double number_at(const Json& values, std::size_t column) {
  return column < values.size() && values[column].is_number() ? values[column].get<double>() : NAN;
}

std::string read_all(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Which lines differ, of texts.
void compare_lines(const std::string& a, const std::string& b, Json& json) {
  std::size_t line = 0, differing = 0, first = 0;
  auto x = a.begin(), y = b.begin();
  while (x != a.end() || y != b.end()) {
    ++line;
    const auto u = std::find(x, a.end(), '\n'), v = std::find(y, b.end(), '\n');
    if (!std::equal(x, u, y, v) && differing++ == 0) first = line;
    x = u == a.end() ? u : u + 1;
    y = v == b.end() ? v : v + 1;
  }
  json["lines_differing"] = differing;
  json["lines"] = line;
  json["first_line"] = first;
}

}  // namespace

// Pairs of values that differ, one after the other: keeps what is said of the one that differs most.
class Differences::Pairs {
 public:
  Pairs(engine::Plugins& plugins, Previews& previews) : plugins_(plugins), previews_(previews) {}

  void add(const std::string& element, const engine::Value& a, const engine::Value& b) {
    std::vector<engine::NamedValue> said;
    if (!a.type().difference.empty() && a.size_bytes() + b.size_bytes() <= most_known_bytes) {
      try {
        said = engine::compare_values(a, b, plugins_);
      } catch (const std::exception& error) {
        failure_ = error.what();
      }
    }
    if (!said.empty()) return add(element, std::move(said), &a, &b);
    if (a.size_bytes() + b.size_bytes() > most_bytes) return;
    add(element, shown_json(a), shown_json(b));
    if (!worst_a_ || worst_element_ == element) worst_a_ = a, worst_b_ = b;
  }

  // What a difference says, whose table's first row sums up and whose first column tells how far apart they are.
  void add(const std::string& element, std::vector<engine::NamedValue> said, const engine::Value* a,
           const engine::Value* b) {
    const auto table =
        std::find_if(said.begin(), said.end(), [](const auto& named) { return is_table(shown_json(named.value)); });
    Json json = table == said.end() ? Json() : shown_json(table->value);
    const double far = json.is_null() ? NAN : number_at(json["rows"][0]["values"], 0);
    curve_.push_back(far);
    const bool first = said_.empty();
    if (!first && !(far > far_ || std::isnan(far_))) return;
    far_ = far;
    said_ = std::move(said);
    table_ = std::move(json);
    worst_element_ = element;
    if (a && b) worst_a_ = *a, worst_b_ = *b;
  }

  void add(const std::string& element, const Json& a, const Json& b) {
    NumberDifference here;
    here.visit(a, b, "");
    ++compared_;
    squares_ += here.squares;
    numbers_ += here.numbers;
    form_ |= here.form;
    others_ += here.others;
    if (compared_ == 1 || here.largest > largest_) {
      largest_ = here.largest;
      largest_at_ = (element.empty() ? "" : "[" + element + "]") + here.where;
      worst_element_ = element;
    }
  }

  void set_failure(const std::string& text) { failure_ = text; }
  bool found() const { return !said_.empty() || compared_ > 0; }

  void tell(Json& json) const {
    if (!said_.empty()) {
      json["compared"] = curve_.size();
      if (!worst_element_.empty()) json["most_at"] = worst_element_;
      if (!table_.is_null()) {
        json["measures"] = Json::object();
        const Json& values = table_["rows"][0]["values"];
        for (std::size_t c = 0; c < table_["columns"].size(); ++c)
          if (c < values.size() && !values[c].is_null())
            json["measures"][table_["columns"][c].get<std::string>()] = values[c];
      }
    }
    if (compared_ > 0 && numbers_ > 0) {
      json["compared"] = compared_;
      json["largest_difference"] = largest_;
      json["largest_at"] = largest_at_;
      json["rms_difference"] = std::sqrt(squares_ / static_cast<double>(numbers_));
    }
    if (form_) json["form_differs"] = true;
    if (others_ > 0) json["texts_differing"] = others_;
    if (!failure_.empty()) json["not_compared"] = failure_;
  }

  // Of the pair that differs most: what the difference shows, and the values themselves where it shows no picture.
  std::string html() {
    std::string html;
    if (curve_.size() > 1)
      html += "<p class=\"dim\">" +
              engine::escape_markup(table_.is_null() ? "" : table_["columns"][0].get<std::string>()) +
              " of every value</p>" + curve_html(curve_, curve_.size());
    const std::string at = worst_element_.empty() ? "" : " of " + worst_element_ + ", which differs most";
    const auto add = [&](const engine::Value& value, const std::string& caption) {
      html += "<div>" + previews_.value(value, caption + at) + "</div>";
    };
    bool pictured = false;
    for (const engine::NamedValue& named : said_) {
      pictured |= is_pictured(named.value);
      add(named.value, named.name);
    }
    if (!pictured && worst_a_ && worst_b_ && is_pictured(worst_a_)) add(worst_a_, "A"), add(worst_b_, "B");
    return html;
  }

 private:
  engine::Plugins& plugins_;
  Previews& previews_;
  std::vector<double> curve_;
  std::vector<engine::NamedValue> said_;
  Json table_;
  double far_ = NAN;
  std::string worst_element_, failure_;
  engine::Value worst_a_, worst_b_;
  std::size_t compared_ = 0, numbers_ = 0, others_ = 0;
  double squares_ = 0, largest_ = 0;
  std::string largest_at_;
  bool form_ = false;
};

Found Differences::outputs(const std::string& type, const engine::StoredOutput& a, const engine::StoredOutput& b) {
  std::map<std::string, engine::Digest> others;
  for (const engine::StoredLeaf& leaf : b.leaves) others.emplace(leaf.element, leaf.identity);
  Json json = {{"values", a.leaves.size()}};
  std::size_t equal = 0, only_a = 0, looked = 0, differing = 0;
  Json elements = Json::array();
  Found one_file;
  Pairs pairs(plugins_, previews_);
  for (const engine::StoredLeaf& leaf : a.leaves) {
    const auto other = others.find(leaf.element);
    if (other == others.end()) {
      ++only_a;
      continue;
    }
    const engine::Digest identity = other->second;
    others.erase(other);
    if (identity == leaf.identity) {
      ++equal;
      continue;
    }
    ++differing;
    if (all_) elements.push_back(leaf.element);
    if (looked >= most_pairs || a.cheap || b.cheap) continue;
    const auto x = engine::stored_value(type, leaf.identity, plugins_, store_);
    const auto y = engine::stored_value(type, identity, plugins_, store_);
    if (!x || !y) continue;
    if (type == "file") {  // of a sequence of files the first that differs is looked into
      const auto& first = x->as<engine::File>();
      const auto& second = y->as<engine::File>();
      if (looked++ > 0 || first.is_folder() || second.is_folder() || first.in_memory() || second.in_memory()) continue;
      one_file = files(first.path(), second.path(), first.suffix());
      if (one_file.json && !leaf.element.empty()) (*one_file.json)["most_at"] = leaf.element;
      continue;
    }
    ++looked;
    pairs.add(leaf.element, *x, *y);
    if (a.leaves.size() == 1 && (type == "number" || type == "integer" || type == "flag" || type == "text"))
      json["a"] = shown_json(*x), json["b"] = shown_json(*y);
  }
  if (differing + only_a + others.size() == 0) return {};
  json["equal"] = equal;
  json["differing"] = differing;
  if (only_a > 0) json["only_in_a"] = only_a;
  if (!others.empty()) json["only_in_b"] = others.size();
  pairs.tell(json);
  if (one_file.json)
    for (const auto& [key, value] : one_file.json->items())
      if (!json.contains(key)) json[key] = value;
  if (all_ && !elements.empty()) json["elements"] = elements;
  return {std::make_shared<Json>(std::move(json)), one_file.html + (pairs.found() ? pairs.html() : "")};
}

std::string Differences::graph_for(const std::string& suffix) const {
  if (suffix.size() < 2) return {};
  for (const std::string& folder : folders_) {
    const fs::path path = fs::path(folder) / "differences" / (lower(suffix.substr(1)) + ".json");
    std::error_code error;
    if (fs::is_regular_file(path, error)) return path.string();
  }
  return {};
}

// Runs a graph of two files, `a` and `b`: what each of its nodes "difference", "difference_WHAT" says, by WHAT.
std::vector<std::pair<std::string, Differences::Pairs>> Differences::by_graph(const std::string& path,
                                                                              const std::string& a,
                                                                              const std::string& b) {
  std::vector<std::pair<std::string, Pairs>> all;
  engine::GraphReading reading = read_graph(path, {{"a", a}, {"b", b}}, plugins_);
  if (!reading.problems.empty()) {
    all.emplace_back("", Pairs(plugins_, previews_)).second.set_failure(reading.problems[0].line());
    return all;
  }
  engine::RunOptions options;
  stop_on_interrupt(options);
  const engine::RunResult ran = engine::run_graph(reading.graph, plugins_, store_, options);
  const std::vector<engine::StoredNode> stored = engine::inspect_graph(reading.graph, plugins_, store_);
  constexpr std::string_view prefix = "difference";
  for (std::size_t n = 0; n < reading.graph.nodes.size(); ++n) {
    const engine::GraphNode& node = reading.graph.nodes[n];
    if (!node.id.starts_with(prefix)) continue;
    Pairs& pairs =
        all.emplace_back(node.id.substr(std::min(prefix.size() + 1, node.id.size())), Pairs(plugins_, previews_))
            .second;
    std::map<std::string, std::vector<engine::NamedValue>> said;
    std::vector<std::string> order;
    for (std::size_t o = 0; o < node.output_type.size() && o < stored[n].outputs.size(); ++o)
      for (const engine::StoredLeaf& leaf : stored[n].outputs[o].leaves) {
        const auto value = engine::stored_value(node.output_type[o], leaf.identity, plugins_, store_);
        if (!value) continue;
        if (said[leaf.element].empty()) order.push_back(leaf.element);
        said[leaf.element].push_back({node.info->outputs[o].name, *value});
      }
    for (const std::string& element : order) pairs.add(element, std::move(said[element]), nullptr, nullptr);
    if (!pairs.found()) pairs.set_failure(ran.failures.empty() ? "there is nothing to compare" : ran.failures[0]);
  }
  return all;
}

Found Differences::files(const std::string& a, const std::string& b, const std::string& suffix) {
  std::error_code error;
  const auto size_a = fs::file_size(a, error), size_b = fs::file_size(b, error);
  if (error) return {std::make_shared<Json>(Json{{"not_compared", "cannot read " + a + " or " + b}}), {}};
  constexpr std::uintmax_t most_text_bytes = 50'000'000;
  const bool small = size_a <= most_text_bytes && size_b <= most_text_bytes;
  if (size_a == size_b && read_all(a) == read_all(b)) return {};
  Json json = {{"bytes_a", size_a}, {"bytes_b", size_b}};
  Pairs pairs(plugins_, previews_);
  std::string html;
  bool found = false;
  if (const std::string graph = graph_for(suffix); !graph.empty())
    for (auto& [what, said] : by_graph(graph, a, b)) {
      found |= said.found();
      Json part = Json::object();
      said.tell(part);
      if (what.empty())
        json.update(part);
      else
        json["parts"][what] = std::move(part);
      html += (what.empty() ? "" : "<p>" + engine::escape_markup(what) + "</p>") + said.html();
    }
  const bool text = engine::media_of(suffix).element == "pre" || lower(suffix) == ".usda" || lower(suffix) == ".html";
  if (!found && small && lower(suffix) == ".json") {
    const Json x = Json::parse(read_all(a), nullptr, false), y = Json::parse(read_all(b), nullptr, false);
    if (!x.is_discarded() && !y.is_discarded()) pairs.add("", x, y);
  } else if (!found && small && text) {
    compare_lines(read_all(a), read_all(b), json);
  }
  pairs.tell(json);
  return {std::make_shared<Json>(std::move(json)), html + pairs.html()};
}

}  // namespace cli
