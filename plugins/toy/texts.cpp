// SPDX-License-Identifier: Apache-2.0
#include "plugins/toy/texts.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace toy {

std::string read_text(const engine::File& file) {
  std::ifstream in(file.path(), std::ios::binary);
  if (!in || file.is_folder()) throw std::runtime_error(file.name() + " is no file that can be read");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string upper(const std::string& text, const UpperOptions& options) {
  std::string result = text;
  bool start = true;
  for (char& c : result) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool up = options.mode == UpperOptions::Mode::upper || (options.mode == UpperOptions::Mode::title && start);
    if (letter) c = static_cast<char>(up ? c & ~0x20 : c | 0x20);
    start = !letter;
  }
  return result;
}

double length(const std::string& text) { return static_cast<double>(text.size()); }

std::string concat(const engine::Seq<std::string>& texts, const ConcatOptions& options) {
  std::string result;
  bool first = true;
  for (const std::string& text : texts) {
    if (!first) result += options.separator;
    first = false;
    result += text;
  }
  return result;
}

std::string pair(const std::string& left, const std::string& right) { return left + " " + right; }

bool contains(const std::string& text, const ContainsOptions& options) {
  return text.find(options.part) != std::string::npos;
}

engine::Seq<std::string> repeat(const std::string& text, const RepeatOptions& options) {
  std::vector<std::string> texts;
  for (int i = 0; i < options.times; ++i) texts.push_back(text + std::to_string(i));
  return texts;
}

engine::File join_texts(const engine::Seq<std::string>& texts) { return write_text(concat(texts, {"\n"})); }

engine::File write_text(const std::string& text) { return engine::File::from_bytes(text, ".txt"); }

}  // namespace toy
