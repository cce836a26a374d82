// SPDX-License-Identifier: Apache-2.0
// Values as HTML, for pages that need nothing from elsewhere.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/describe/media.h"
#include "engine/graph/graph.h"
#include "engine/run/inspect.h"

namespace cli {

// Shows outputs of nodes: pictures by the views that their types name, numbers as curves, tables, texts, files that
// browsers show. Counts the bytes of the page, and leaves pictures out when it is full.
class Previews {
 public:
  Previews(engine::Plugins& plugins, engine::Store& store) : plugins_(plugins), store_(store) {}
  // Of a type (by name), the leaves that are there; what it says of a value that is not kept or cannot be shown it says
  // in words.
  std::string show(const std::string& type, const engine::StoredOutput& output);
  // One value, with a caption where it is not empty.
  std::string value(const engine::Value& value, const std::string& caption);
  // "1.2 MB in 751 values"
  std::string size(const std::string& type, const engine::StoredOutput& output);

 private:
  std::string picture(const std::string& bytes, const std::string& suffix, const std::string& caption);
  std::string file(const engine::Value& value, const std::string& caption);
  std::string embedded(const std::string& bytes, const engine::Media& media, const std::string& caption);
  // Sequences of number lists, such as weights over frames, as curves; empty where they are none.
  std::string lists(const std::string& type, const engine::StoredOutput& output);
  std::string curve(const std::string& type, const engine::StoredOutput& output);

  engine::Plugins& plugins_;
  engine::Store& store_;
  std::size_t bytes_ = 0;
};

// A page with the style of all pages. body: HTML.
std::string html_page(const std::string& title, const std::string& body);
// A value's JSON form as a table; empty where it is none.
std::string table_html(const std::string& json);

std::string base64(const std::string& bytes);

}  // namespace cli
