// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/json_tree.h"

#include <deque>
#include <iterator>
#include <nlohmann/json.hpp>
#include <unordered_map>

namespace engine {
namespace {

constexpr std::size_t most_levels = 64;  // keeps strangers' files from exhausting the stack

// Walks over the text and tells the handler how far the parser has read.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, std::size_t* read) : at_(at), read_(read) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    ++at_;
    ++*read_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  std::size_t* read_;
};

std::string pointer_step(const std::string& parent, std::string_view key) {
  std::string pointer = parent + "/";
  for (const char c : key) {
    if (c == '~')
      pointer += "~0";
    else if (c == '/')
      pointer += "~1";
    else
      pointer += c;
  }
  return pointer;
}

// Builds the tree from the parser's events. A token starts at the first character after the preceding token that is no
// blank, comma, colon or comment; where it ends is what the parser has read.
class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  TreeBuilder(std::string_view text, const std::size_t& read, const SourceFile& source, JsonValue& document,
              std::vector<Problem>& problems)
      : text_(text), read_(read), source_(source), document_(document), problems_(problems) {}

  bool null() override { return scalar(JsonValue::Kind::null) != nullptr; }
  bool boolean(bool value) override {
    scalar(JsonValue::Kind::boolean)->boolean = value;
    return true;
  }
  bool number_integer(std::int64_t value) override {
    return number(JsonValue::Kind::integer, value, static_cast<double>(value));
  }
  bool number_unsigned(std::uint64_t value) override {
    if (value > static_cast<std::uint64_t>(INT64_MAX))
      return number(JsonValue::Kind::real, 0, static_cast<double>(value));
    return number_integer(static_cast<std::int64_t>(value));
  }
  bool number_float(double value, const std::string&) override { return number(JsonValue::Kind::real, 0, value); }
  bool string(std::string& value) override {
    scalar(JsonValue::Kind::string)->text = std::move(value);
    return true;
  }
  bool binary(nlohmann::json::binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(JsonValue::Kind::object); }
  bool start_array(std::size_t) override { return open(JsonValue::Kind::array); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(std::string& name) override {
    start_token();
    Level& level = levels_.back();
    const auto [known, fresh] = level.lines.emplace(name, line_);
    if (!fresh)
      problems_.push_back({{source_.shown, line_, column_, pointer_step(level.value->pointer, name)},
                           "the key " + quoted_text(name) + " stands here twice; the first is in line " +
                               std::to_string(known->second)});
    level.dropped = !fresh;
    level.key = {};
    level.key.key = name;
    level.key.source = &source_;
    level.key.line = line_;
    level.key.column = column_;
    previous_end_ = read_;
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) override {
    std::string message = error.what();
    for (const char* const prefix : {"] ", "parse error at ", ": ", " - "}) {
      const std::size_t at = message.find(prefix);
      if (at != std::string::npos && (at < 40 || prefix[0] == ' '))
        message.erase(0, at + std::char_traits<char>::length(prefix));
    }
    start_token();
    message.erase(std::min(message.find("; last read"), message.size()));  // it may hold what stands before
    if (message == "invalid literal")
      message += " " + quoted_text(text_.substr(start_, text_.find_first_of(" \t\r\n,:]}", start_) - start_));
    const char next = start_ < text_.size() ? text_[start_] : '\0';
    if (comma_ && (next == '}' || next == ']'))
      message = std::string("a comma stands before '") + next + "'";
    else if (!comma_ && message.starts_with("unexpected") &&
             (message.ends_with("expected '}'") || message.ends_with("expected ']'")))
      message += " or a comma";
    else if (message.find("U+000A") != std::string::npos)
      message = "the string is not closed in its line";
    problems_.push_back({{source_.shown, line_, column_, {}}, "not valid JSON: " + message});
    return false;
  }

 private:
  struct Level {
    JsonValue* value = nullptr;
    JsonMember key;                              // of the member that comes next
    bool dropped = false;                        // that member is a duplicate
    JsonValue spare;                             // where a duplicate's value goes
    std::unordered_map<std::string, int> lines;  // keys seen
  };

  void start_token() {
    std::size_t at = previous_end_;
    comma_ = false;
    const auto end_of = [&](std::string_view mark, std::size_t from) {
      return std::min(text_.find(mark, from), text_.size());
    };
    while (at < text_.size()) {
      const char c = text_[at];
      if (c == '/' && at + 1 < text_.size() && text_[at + 1] == '/')
        at = end_of("\n", at);
      else if (c == '/' && at + 1 < text_.size() && text_[at + 1] == '*')
        at = std::min(end_of("*/", at + 2) + 2, text_.size());
      else if (c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ',' || c == ':')
        comma_ = comma_ || c == ',', ++at;
      else
        break;
    }
    for (; counted_ < at; ++counted_) {
      const auto c = static_cast<unsigned char>(text_[counted_]);
      if (c == '\n') {
        ++line_;
        column_ = 1;
      } else if ((c & 0xC0) != 0x80) {
        ++column_;
      }
    }
    start_ = at;
  }

  JsonValue* place_value(JsonValue::Kind kind) {
    start_token();
    JsonValue* value = &document_;
    if (!levels_.empty()) {
      Level& level = levels_.back();
      JsonValue& parent = *level.value;
      if (parent.is(JsonValue::Kind::array)) {
        value = &parent.items.emplace_back();
        value->pointer = parent.pointer + "/" + std::to_string(parent.items.size() - 1);
      } else if (level.dropped) {
        level.spare = {};
        value = &level.spare;
        value->pointer = pointer_step(parent.pointer, level.key.key);
      } else {
        value = &parent.members.emplace_back(std::move(level.key)).value;
        value->pointer = pointer_step(parent.pointer, parent.members.back().key);
      }
    }
    value->kind = kind;
    value->source = &source_;
    value->line = line_;
    value->column = column_;
    previous_end_ = read_;
    return value;
  }

  JsonValue* scalar(JsonValue::Kind kind) { return place_value(kind); }

  bool number(JsonValue::Kind kind, std::int64_t integer, double real) {
    JsonValue* const value = place_value(kind);
    // The parser has read the character after a number too.
    const std::size_t end = std::min(text_.find_first_not_of("0123456789+-.eE", start_), text_.size());
    previous_end_ = end;
    value->text = std::string(text_.substr(start_, end - start_));
    value->integer = integer;
    value->real = real;
    return true;
  }

  bool open(JsonValue::Kind kind) {
    JsonValue* const value = place_value(kind);
    if (levels_.size() >= most_levels) {
      problems_.push_back({value->place(), "nested deeper than " + std::to_string(most_levels) + " levels"});
      return false;
    }
    levels_.emplace_back().value = value;
    return true;
  }

  bool close() {
    previous_end_ = read_;
    levels_.pop_back();
    return true;
  }

  std::string_view text_;
  const std::size_t& read_;
  const SourceFile& source_;
  JsonValue& document_;
  std::vector<Problem>& problems_;
  std::deque<Level> levels_;  // values may live in it: they must not move
  std::size_t previous_end_ = 0, start_ = 0, counted_ = 0;
  int line_ = 1, column_ = 1;
  bool comma_ = false;  // one stands before the token
};

}  // namespace

const JsonMember* JsonValue::find(std::string_view key) const {
  for (const JsonMember& member : members)
    if (member.key == key) return &member;
  return nullptr;
}

Place JsonValue::place() const { return {source != nullptr ? source->shown : "", line, column, pointer}; }
Place JsonMember::place() const { return {source != nullptr ? source->shown : "", line, column, value.pointer}; }

bool parse_json(std::string_view text, const SourceFile& source, JsonValue& document, std::vector<Problem>& problems) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::size_t read = 0;
  TreeBuilder builder(text, read, source, document, problems);
  return nlohmann::json::sax_parse(CountingIterator(text.data(), &read),
                                   CountingIterator(text.data() + text.size(), &read), &builder,
                                   nlohmann::json::input_format_t::json, true, true);
}

std::string quoted_text(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string out = "\"";
  const bool shortened = text.size() > longest;
  std::size_t end = std::min(text.size(), longest);
  while (shortened && end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  for (const char c : text.substr(0, end)) {
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (c == '\n')
      out += "\\n";
    else if (static_cast<unsigned char>(c) < 0x20)
      out += "?";
    else
      out += c;
  }
  return out + (shortened ? "...\"" : "\"");
}

std::string found(const JsonValue& value) {
  switch (value.kind) {
    case JsonValue::Kind::null:
      return "null";
    case JsonValue::Kind::boolean:
      return value.boolean ? "true" : "false";
    case JsonValue::Kind::integer:
    case JsonValue::Kind::real:
      return "the number " + value.text;
    case JsonValue::Kind::string:
      return "the string " + quoted_text(value.text);
    case JsonValue::Kind::array:
      return value.items.empty() ? "an empty list" : "a list";
    case JsonValue::Kind::object:
      return "an object";
  }
  return {};
}

}  // namespace engine
