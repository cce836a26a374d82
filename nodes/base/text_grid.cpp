// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/text_grid.h"

#include <charconv>
#include <cmath>
#include <optional>

#include "nodes/base/check.h"

namespace face {
namespace {

void append_utf8(std::string& out, unsigned code) {
  const auto byte = [&](unsigned b) { out += static_cast<char>(b); };
  if (code < 0x80) {
    byte(code);
  } else if (code < 0x800) {
    byte(0xC0 | code >> 6);
    byte(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    byte(0xE0 | code >> 12);
    byte(0x80 | (code >> 6 & 0x3F));
    byte(0x80 | (code & 0x3F));
  } else {
    byte(0xF0 | code >> 18);
    byte(0x80 | (code >> 12 & 0x3F));
    byte(0x80 | (code >> 6 & 0x3F));
    byte(0x80 | (code & 0x3F));
  }
}

std::string from_utf16(std::string_view bytes, bool big_endian) {
  std::string out;
  const auto unit = [&](std::size_t i) {
    const auto a = static_cast<unsigned char>(bytes[i]), b = static_cast<unsigned char>(bytes[i + 1]);
    return big_endian ? a * 256U + b : b * 256U + a;
  };
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    unsigned code = unit(i);
    if (code >= 0xD800 && code < 0xDC00 && i + 3 < bytes.size()) {
      code = 0x10000 + ((code - 0xD800) << 10) + (unit(i + 2) - 0xDC00);
      i += 2;
    }
    append_utf8(out, code);
  }
  return out;
}

std::string to_utf8(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) return std::string(bytes.substr(3));
  if (bytes.starts_with("\xFE\xFF")) return from_utf16(bytes.substr(2), true);
  if (bytes.starts_with("\xFF\xFE")) return from_utf16(bytes.substr(2), false);
  if (bytes.size() >= 2 && bytes[0] == '\0') return from_utf16(bytes, true);
  if (bytes.size() >= 2 && bytes[1] == '\0') return from_utf16(bytes, false);
  return std::string(bytes);
}

// Steps through the free-standing values of a TextGrid.
class Reader {
 public:
  Reader(std::string text, std::string name) : text_(std::move(text)), name_(std::move(name)) {}

  double number(const char* what) {
    const Token token = next(what);
    if (token.kind != Kind::number) refuse(token, what);
    return token.number;
  }
  std::string text(const char* what) {
    const Token token = next(what);
    if (token.kind != Kind::text) refuse(token, what);
    return token.text;
  }
  std::string flag(const char* what) {
    const Token token = next(what);
    if (token.kind != Kind::flag) refuse(token, what);
    return token.text;
  }
  std::size_t count(const char* what) {
    const double value = number(what);
    if (!(value >= 0) || value != std::floor(value) || value > 1e8) fail(place(), "found ", value, ", expected ", what);
    return static_cast<std::size_t>(value);
  }
  std::string place() const { return message(name_, ":", token_line_, ": "); }

 private:
  enum class Kind { number, text, flag };
  struct Token {
    Kind kind = Kind::number;
    std::string text;
    double number = 0;
  };

  [[noreturn]] void refuse(const Token& token, const char* what) const {
    if (token.kind == Kind::number) fail(place(), "found the number ", token.number, ", expected ", what);
    if (token.kind == Kind::flag) fail(place(), "found ", token.text, ", expected ", what);
    fail(place(), "found \"", token.text, "\", expected ", what);
  }

  void skip_blanks() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '!') {  // a comment up to the line's end
        while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
      } else if (c == '\n') {
        ++line_;
        ++at_;
      } else if (c == ' ' || c == '\t' || c == '\r') {
        if (c == '\r' && (at_ + 1 >= text_.size() || text_[at_ + 1] != '\n')) ++line_;
        ++at_;
      } else {
        return;
      }
    }
  }

  Token next(const char* what) {
    while (true) {
      skip_blanks();
      token_line_ = line_;
      if (at_ >= text_.size()) fail(place(), "found the end of the file, expected ", what);
      if (text_[at_] == '"') return quoted(what);
      const std::size_t start = at_;
      while (at_ < text_.size() && static_cast<unsigned char>(text_[at_]) > ' ') ++at_;
      const std::string_view word(text_.data() + start, at_ - start);
      if (word.size() > 2 && word.front() == '<' && word.back() == '>') return {Kind::flag, std::string(word), 0};
      double value = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error == std::errc() && end == word.data() + word.size()) return {Kind::number, {}, value};
    }
  }

  Token quoted(const char* what) {
    Token token{Kind::text, {}, 0};
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '"') {
        if (at_ + 1 >= text_.size() || text_[at_ + 1] != '"') {
          ++at_;
          return token;
        }
        ++at_;
      }
      if (text_[at_] == '\n') ++line_;
      token.text += text_[at_];
    }
    fail(place(), "found a text without a closing quote, expected ", what);
  }

  std::string text_;
  std::string name_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t token_line_ = 1;
};

std::string shortest(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string quote(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  quoted += '"';
  return quoted;
}

TextGridTier read_tier(Reader& reader) {
  const std::string kind = reader.text("\"IntervalTier\" or \"TextTier\"");
  if (kind != "IntervalTier" && kind != "TextTier")
    fail(reader.place(), "found \"", kind, "\", expected \"IntervalTier\" or \"TextTier\"");
  TextGridTier tier;
  tier.name = reader.text("the name of a tier");
  reader.number("the start of a tier");
  reader.number("the end of a tier");
  const std::size_t count = reader.count("the number of intervals");
  for (std::size_t i = 0; i < count; ++i) {
    TextGridInterval interval;
    interval.start_s = reader.number("the start of an interval");
    if (kind == "IntervalTier") interval.end_s = reader.number("the end of an interval");
    if (kind == "IntervalTier" && interval.end_s < interval.start_s)
      fail(reader.place(), "found an interval from ", interval.start_s, " to ", interval.end_s,
           ", expected an end after its start");
    interval.text = reader.text("the text of an interval");
    tier.intervals.push_back(std::move(interval));
  }
  if (kind == "TextTier") tier = {};
  return tier;
}

// Whether phones [first, end) are the same phones twice, so that a word was repeated.
bool repeats(const std::vector<Phone>& phones, std::size_t first, std::size_t end) {
  const std::size_t half = (end - first) / 2;
  if ((end - first) % 2 != 0) return false;
  for (std::size_t i = first; i < first + half; ++i)
    if (phones[i].label != phones[i + half].label) return false;
  return true;
}

}  // namespace

TextGrid parse_text_grid(std::string_view bytes, const std::string& name) {
  check(!bytes.empty(), name, ": the file is empty, expected a TextGrid");
  check(!bytes.starts_with("ooBinaryFile"), name,
        ": found a binary TextGrid, expected a text one (in Praat: Save as text file)");
  Reader reader(to_utf8(bytes), name);
  const std::string type = reader.text("\"ooTextFile\"");
  if (type != "ooTextFile") fail(reader.place(), "found \"", type, "\", expected \"ooTextFile\"");
  const std::string object = reader.text("\"TextGrid\"");
  if (object != "TextGrid") fail(reader.place(), "found \"", object, "\", expected \"TextGrid\"");
  TextGrid grid;
  grid.start_s = reader.number("the start of the TextGrid");
  grid.end_s = reader.number("the end of the TextGrid");
  if (reader.flag("<exists>") != "<exists>") return grid;
  const std::size_t tiers = reader.count("the number of tiers");
  for (std::size_t i = 0; i < tiers; ++i)
    if (TextGridTier tier = read_tier(reader); !tier.intervals.empty()) grid.tiers.push_back(std::move(tier));
  return grid;
}

std::string write_text_grid(const TextGrid& grid) {
  std::string out = "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n";
  const auto span = [&](const char* indent, double start_s, double end_s) {
    out += message(indent, "xmin = ", shortest(start_s), "\n", indent, "xmax = ", shortest(end_s), "\n");
  };
  span("", grid.start_s, grid.end_s);
  out += message("tiers? <exists>\nsize = ", grid.tiers.size(), "\nitem []:\n");
  for (std::size_t t = 0; t < grid.tiers.size(); ++t) {
    const TextGridTier& tier = grid.tiers[t];
    out +=
        message("    item [", t + 1, "]:\n        class = \"IntervalTier\"\n        name = ", quote(tier.name), "\n");
    span("        ", grid.start_s, grid.end_s);
    out += message("        intervals: size = ", tier.intervals.size(), "\n");
    for (std::size_t i = 0; i < tier.intervals.size(); ++i) {
      out += message("        intervals [", i + 1, "]:\n");
      span("            ", tier.intervals[i].start_s, tier.intervals[i].end_s);
      out += message("            text = ", quote(tier.intervals[i].text), "\n");
    }
  }
  return out;
}

TextGrid text_grid_from_phones(const Phones& phones) {
  TextGrid grid{0, phones.duration_s, {{"words", {}}, {"phones", {}}}};
  const std::vector<Phone>& list = phones.phones;
  for (std::size_t first = 0; first < list.size();) {
    std::size_t end = first + 1;
    while (end < list.size() && list[end].word == list[first].word) ++end;
    const bool twice = !list[first].word.empty() && repeats(list, first, end);
    const std::size_t middle = first + (end - first) / 2;
    if (twice) grid.tiers[0].intervals.push_back({list[first].start_s, list[middle].start_s, list[first].word});
    grid.tiers[0].intervals.push_back({list[twice ? middle : first].start_s, list[end - 1].end_s, list[first].word});
    first = end;
  }
  for (const Phone& phone : list)
    grid.tiers[1].intervals.push_back({phone.start_s, phone.end_s, phone.label == "SIL" ? "" : phone.label});
  return grid;
}

}  // namespace face
