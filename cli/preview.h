// SPDX-License-Identifier: Apache-2.0
// Values as HTML, for pages that need nothing from elsewhere.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

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
  // "1.2 MB in 751 values"
  std::string size(const std::string& type, const engine::StoredOutput& output);

 private:
  std::string picture(const std::string& bytes, const std::string& suffix, const std::string& caption);
  std::string file(const engine::Value& value, const std::string& caption);
  std::string curve(const std::string& type, const engine::StoredOutput& output);

  engine::Plugins& plugins_;
  engine::Store& store_;
  std::size_t bytes_ = 0;
};

std::string base64(const std::string& bytes);

}  // namespace cli
