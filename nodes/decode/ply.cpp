// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/ply.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "nodes/base/check.h"

namespace face::decode {
namespace {

enum class Form { ascii, little_endian, big_endian };
enum class Number { i8, u8, i16, u16, i32, u32, f32, f64, unknown };

struct Property {
  std::string name;
  Number type = Number::unknown;
  Number count_type = Number::unknown;  // of a list; unknown for a single number
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

Number number_type(std::string_view name) {
  struct Known {
    std::string_view old_name, new_name;
    Number type;
  };
  static constexpr Known known[] = {{"char", "int8", Number::i8},      {"uchar", "uint8", Number::u8},
                                    {"short", "int16", Number::i16},   {"ushort", "uint16", Number::u16},
                                    {"int", "int32", Number::i32},     {"uint", "uint32", Number::u32},
                                    {"float", "float32", Number::f32}, {"double", "float64", Number::f64}};
  for (const Known& one : known)
    if (name == one.old_name || name == one.new_name) return one.type;
  return Number::unknown;
}

std::size_t size_of(Number type) {
  switch (type) {
    case Number::i8:
    case Number::u8:
      return 1;
    case Number::i16:
    case Number::u16:
      return 2;
    case Number::f64:
      return 8;
    default:
      return 4;
  }
}

// The largest value of a whole type, by which colours are divided; 1 for real ones.
float full_of(Number type) { return type == Number::u8 ? 255.0f : type == Number::u16 ? 65535.0f : 1.0f; }

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  Ply read() {
    read_header();
    ply_.polygon_starts.push_back(0);
    for (const Element& element : elements_) read_element(element);
    for (const std::uint32_t v : ply_.corners)
      if (v >= ply_.points.size())
        fail(name_, ": a polygon has vertex ", v, ", but there are ", ply_.points.size(), " vertices");
    return std::move(ply_);
  }

 private:
  std::string_view line() {
    if (at_ >= bytes_.size()) fail(name_, ":", line_ + 1, ": found the end of the file, expected end_header");
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    std::string_view text = bytes_.substr(at_, end - at_);
    at_ = std::min(end + 1, bytes_.size());
    ++line_;
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    return text;
  }

  static std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    for (std::size_t at = text.find_first_not_of(" \t"); at != std::string_view::npos;) {
      const std::size_t end = std::min(text.find_first_of(" \t", at), text.size());
      words.emplace_back(text.substr(at, end - at));
      at = text.find_first_not_of(" \t", end);
    }
    return words;
  }

  [[noreturn]] void refuse(std::string_view found, const char* expected) const {
    fail(name_, ":", line_, ": found \"", found.substr(0, 60), "\", expected ", expected);
  }

  void read_header() {
    check(bytes_.starts_with("ply"), name_, ": found \"", bytes_.substr(0, 16), "\", expected \"ply\"");
    line();
    bool form_known = false;
    while (true) {
      const std::string_view text = line();
      const std::vector<std::string> words = words_of(text);
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format" && words.size() >= 2) {
        form_known = words[1] == "ascii" || words[1] == "binary_little_endian" || words[1] == "binary_big_endian";
        if (!form_known) refuse(text, "ascii, binary_little_endian or binary_big_endian");
        form_ = words[1] == "ascii"                  ? Form::ascii
                : words[1] == "binary_little_endian" ? Form::little_endian
                                                     : Form::big_endian;
      } else if (words[0] == "element" && words.size() == 3) {
        Element element{words[1], 0, {}};
        const auto [stop, error] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
        if (error != std::errc() || *stop != 0) refuse(text, "element, a name and a count");
        elements_.push_back(std::move(element));
      } else if (words[0] == "property" && words.size() >= 3 && !elements_.empty()) {
        const bool list = words[1] == "list";
        if (list && words.size() != 5) refuse(text, "property list, two types and a name");
        Property property{words.back(), number_type(words[list ? 3 : 1]),
                          list ? number_type(words[2]) : Number::unknown};
        if (property.type == Number::unknown || (list && property.count_type == Number::unknown))
          refuse(text, "a type of number (char to double)");
        elements_.back().properties.push_back(std::move(property));
      } else {
        refuse(text, "format, element, property, comment or end_header");
      }
    }
    check(form_known, name_, ": found no format, expected ascii, binary_little_endian or binary_big_endian");
  }

  double number(Number type) {
    if (form_ == Form::ascii) return written_number();
    const std::size_t size = size_of(type);
    if (at_ + size > bytes_.size()) fail(name_, ": is cut off at byte ", bytes_.size(), ", expected more numbers");
    unsigned char raw[8] = {};
    std::memcpy(raw, bytes_.data() + at_, size);
    at_ += size;
    if ((form_ == Form::big_endian) == (std::endian::native == std::endian::little)) std::reverse(raw, raw + size);
    const auto as = [&]<class T>(T value) {
      std::memcpy(&value, raw, sizeof value);
      return static_cast<double>(value);
    };
    switch (type) {
      case Number::i8:
        return as(std::int8_t{});
      case Number::u8:
        return as(std::uint8_t{});
      case Number::i16:
        return as(std::int16_t{});
      case Number::u16:
        return as(std::uint16_t{});
      case Number::i32:
        return as(std::int32_t{});
      case Number::u32:
        return as(std::uint32_t{});
      case Number::f32:
        return as(float{});
      default:
        return as(double{});
    }
  }

  double written_number() {
    while (at_ < bytes_.size() &&
           (bytes_[at_] == ' ' || bytes_[at_] == '\t' || bytes_[at_] == '\r' || bytes_[at_] == '\n'))
      line_ += bytes_[at_++] == '\n';
    double value = 0;
    const auto [stop, error] = std::from_chars(bytes_.data() + at_, bytes_.data() + bytes_.size(), value);
    if (error != std::errc())
      fail(name_, ":", line_ + 1, ": found \"",
           bytes_.substr(at_, std::min<std::size_t>(bytes_.find_first_of(" \r\n", at_) - at_, 40)),
           "\", expected a number");
    at_ = static_cast<std::size_t>(stop - bytes_.data());
    return value;
  }

  std::size_t count(Number type) {
    const double value = number(type);
    if (!(value >= 0 && value <= 1e6 && value == std::floor(value)))
      fail(name_, ": found a list of ", value, " numbers, expected 0 to a million");
    return static_cast<std::size_t>(value);
  }

  void read_element(const Element& element) {
    const bool vertices = element.name == "vertex", faces = element.name == "face";
    const auto has = [&](const char* wanted) {
      return std::any_of(element.properties.begin(), element.properties.end(),
                         [&](const Property& p) { return p.name == wanted && p.count_type == Number::unknown; });
    };
    const bool coloured = vertices && has("red") && has("green") && has("blue");
    if (vertices) check(has("x") && has("y") && has("z"), name_, ": its vertices have no x, y and z");
    if (element.properties.empty()) return;
    for (std::size_t e = 0; e < element.count; ++e) {
      Vec3f point{}, color{};
      for (const Property& property : element.properties) {
        if (property.count_type == Number::unknown) {
          const double value = number(property.type);
          for (std::size_t c = 0; c < 3; ++c) {
            if (property.name == std::string_view("xyz").substr(c, 1)) point[c] = static_cast<float>(value);
            static constexpr std::string_view channels[] = {"red", "green", "blue"};
            if (property.name == channels[c]) color[c] = static_cast<float>(value) / full_of(property.type);
          }
          continue;
        }
        const std::size_t size = count(property.count_type);
        const bool polygon = faces && (property.name == "vertex_indices" || property.name == "vertex_index");
        for (std::size_t i = 0; i < size; ++i) {
          const double value = number(property.type);
          if (!polygon) continue;
          if (!(value >= 0 && value < 4294967295.0))
            fail(name_, ": a polygon has vertex ", value, ", expected 0 or more");
          ply_.corners.push_back(static_cast<std::uint32_t>(value));
        }
        if (polygon) {
          if (size < 3) fail(name_, ": face ", e, " has ", size, " corners, expected 3 or more");
          ply_.polygon_starts.push_back(static_cast<std::uint32_t>(ply_.corners.size()));
        }
      }
      if (!vertices) continue;
      if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
        fail(name_, ": vertex ", e, " is at (", point[0], ", ", point[1], ", ", point[2], "), expected finite numbers");
      ply_.points.push_back(point);
      if (coloured) ply_.colors_srgb.push_back(color);
    }
  }

  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_ = 0, line_ = 0;
  Form form_ = Form::ascii;
  std::vector<Element> elements_;
  Ply ply_;
};

}  // namespace

Ply read_ply(std::string_view bytes, const std::string& name) { return Reader(bytes, name).read(); }

}  // namespace face::decode
