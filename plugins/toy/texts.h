// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"

namespace toy {

// The bytes of a file, as text.
std::string read_text(const engine::File& file);

struct UpperOptions {
  enum class Mode { upper, lower, title };
  Mode mode = Mode::upper;
};
// ASCII letters in another case.
std::string upper(const std::string& text, const UpperOptions& options);

// Bytes of a text.
double length(const std::string& text);

struct ConcatOptions {
  std::string separator;
};
// All texts in one.
std::string concat(const engine::Seq<std::string>& texts, const ConcatOptions& options);

// Two texts, side by side.
std::string pair(const std::string& left, const std::string& right);

struct ContainsOptions {
  std::string part;
};
bool contains(const std::string& text, const ContainsOptions& options);

struct RepeatOptions {
  int times = 3;
};
// A sequence of copies, each with its number behind it.
engine::Seq<std::string> repeat(const std::string& text, const RepeatOptions& options);

// All texts in one file, a line break between them.
engine::File join_texts(const engine::Seq<std::string>& texts);

engine::File write_text(const std::string& text);

}  // namespace toy
