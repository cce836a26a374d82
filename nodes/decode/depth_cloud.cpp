// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/depth_cloud.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>

#include "nodes/base/check.h"

namespace face::decode {
namespace {

constexpr double most_points = 1LL << 62, most_px = 100000;

static_assert(std::endian::native == std::endian::little, "binary PLY is read as it lies in memory");

struct Property {
  std::string type, name;
  // 0 of what is no type.
  std::size_t bytes() const {
    if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
    if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
    if (type == "int" || type == "uint" || type == "int32" || type == "uint32") return 4;
    if (type == "float" || type == "float32") return 4;
    if (type == "double" || type == "float64") return 8;
    return 0;
  }
  // The value of full light, as a colour.
  double full() const {
    if (type == "ushort" || type == "uint16") return 65535;
    return type.starts_with("float") || type == "double" ? 1 : 255;
  }
};

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t start = line.find_first_not_of(" \t\r,;", at);
    if (start == std::string_view::npos) break;
    at = std::min(line.find_first_of(" \t\r,;", start), line.size());
    words.push_back(line.substr(start, at - start));
  }
  return words;
}

// Lines one after the other, with their number.
class Lines {
 public:
  explicit Lines(const std::string& text) : text_(text) {}
  bool next(std::string_view& line) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line = std::string_view(text_).substr(at_, end - at_);
    at_ = end + 1;
    ++number_;
    return true;
  }
  std::size_t number() const { return number_; }
  std::size_t byte() const { return at_; }

 private:
  const std::string& text_;
  std::size_t at_ = 0, number_ = 0;
};

bool parse_number(std::string_view word, double& value) {
  if (word == "nan" || word == "NaN" || word == "NAN" || word == "-nan") {
    value = std::numeric_limits<double>::quiet_NaN();
    return true;
  }
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

double binary_number(const char* p, const Property& property) {
  const auto as = [p]<class T>(T value) {
    std::memcpy(&value, p, sizeof value);
    return static_cast<double>(value);
  };
  const std::string& t = property.type;
  if (t == "char" || t == "int8") return as(std::int8_t{});
  if (t == "uchar" || t == "uint8") return as(std::uint8_t{});
  if (t == "short" || t == "int16") return as(std::int16_t{});
  if (t == "ushort" || t == "uint16") return as(std::uint16_t{});
  if (t == "int" || t == "int32") return as(std::int32_t{});
  if (t == "uint" || t == "uint32") return as(std::uint32_t{});
  if (t == "double" || t == "float64") return as(double{});
  return as(float{});
}

std::uint8_t colour(double value) { return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0l, 255l)); }

Cloud read_ply(const std::string& bytes, const std::string& title) {
  Lines lines(bytes);
  std::string_view line;
  lines.next(line);
  Cloud cloud;
  std::vector<Property> properties;
  std::size_t count = 0;
  bool binary = false, in_vertices = false, ended = false;
  while (!ended && lines.next(line)) {
    const auto words = words_of(line);
    if (words.empty()) continue;
    const auto integer = [&](std::size_t i, double most) {
      double value = -1;
      if (i >= words.size() || !parse_number(words[i], value) || !(value >= 0 && value < most))
        fail(title, " line ", lines.number(), ": found \"", line, "\", expected a count");
      return value;
    };
    if (words[0] == "format") {
      binary = words.size() > 1 && words[1] == "binary_little_endian";
      if (!binary && !(words.size() > 1 && words[1] == "ascii"))
        fail(title, " line ", lines.number(), ": found \"", line, "\", expected ascii or binary_little_endian");
    } else if (words[0] == "element") {
      in_vertices = words.size() > 2 && words[1] == "vertex";
      if (in_vertices) count = static_cast<std::size_t>(integer(2, most_points));
      check(in_vertices || !properties.empty(), title, " line ", lines.number(), ": found \"", line,
            "\", expected the vertices first");
    } else if (words[0] == "property" && in_vertices) {
      if (words.size() != 3 || words[1] == "list")
        fail(title, " line ", lines.number(), ": found \"", line, "\", expected a number per vertex");
      properties.push_back({std::string(words[1]), std::string(words[2])});
      if (properties.back().bytes() == 0)
        fail(title, " line ", lines.number(), ": found \"", line, "\", expected a type of number (char to double)");
    } else if ((words[0] == "comment" || words[0] == "obj_info") && words.size() == 3) {
      if (words[1] == "width" || words[1] == "num_cols") cloud.width = static_cast<int>(integer(2, most_px));
      if (words[1] == "height" || words[1] == "num_rows") cloud.height = static_cast<int>(integer(2, most_px));
    } else if (words[0] == "end_header") {
      ended = true;
    }
  }
  check(ended, title, ": its header has no end, expected end_header");
  std::array<std::size_t, 6> at{};
  at.fill(properties.size());
  constexpr std::array names = {"x", "y", "z", "red", "green", "blue"};
  for (std::size_t k = 0; k < names.size(); ++k)
    for (std::size_t p = 0; p < properties.size(); ++p)
      if (properties[p].name == names[k]) at[k] = p;
  for (std::size_t k = 0; k < 3; ++k)
    check(at[k] < properties.size(), title, ": its vertices have no ", names[k], ", expected x, y and z");
  const bool coloured = at[3] < properties.size() && at[4] < properties.size() && at[5] < properties.size();
  std::size_t stride = 0;
  for (const Property& p : properties) stride += p.bytes();
  std::size_t byte = std::min(lines.byte(), bytes.size());
  if (binary && (bytes.size() - byte) / stride < count)
    fail(title, ": ends at byte ", bytes.size(), ", expected ", count, " points of ", stride, " bytes from byte ", byte,
         " on");
  std::vector<double> values(properties.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (binary) {
      for (std::size_t p = 0; p < properties.size(); ++p) {
        values[p] = binary_number(bytes.data() + byte, properties[p]);
        byte += properties[p].bytes();
      }
    } else {
      if (!lines.next(line)) fail(title, ": ends after ", i, " points, expected ", count);
      const auto words = words_of(line);
      for (std::size_t p = 0; p < properties.size(); ++p)
        if (p >= words.size() || !parse_number(words[p], values[p]))
          fail(title, " line ", lines.number(), ": found \"", line, "\", expected ", properties.size(), " numbers");
    }
    cloud.points.push_back({values[at[0]], values[at[1]], values[at[2]]});
    if (!coloured) continue;
    cloud.colors.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      cloud.colors.back()[k] = colour(values[at[3 + k]] * 255 / properties[at[3 + k]].full());
  }
  return cloud;
}

Cloud read_xyz(const std::string& bytes, const std::string& title) {
  Lines lines(bytes);
  std::string_view line;
  Cloud cloud;
  std::vector<std::array<double, 3>> colours;
  while (lines.next(line)) {
    const auto words = words_of(line);
    if (words.empty() || words[0].starts_with('#')) continue;
    std::array<double, 6> values{};
    bool good = words.size() == 3 || words.size() == 6;
    for (std::size_t k = 0; good && k < words.size(); ++k) good = parse_number(words[k], values[k]);
    if (!good) fail(title, " line ", lines.number(), ": found \"", line, "\", expected x y z, or x y z r g b");
    cloud.points.push_back({values[0], values[1], values[2]});
    if (words.size() == 6) colours.push_back({values[3], values[4], values[5]});
    check(colours.empty() || colours.size() == cloud.points.size(), title, " line ", lines.number(),
          ": some points have colours and some have none");
  }
  check(!cloud.points.empty(), title, ": holds no points");
  // Shares of full light, or 0 to 255.
  bool fractions = false;
  double largest = 0;
  for (const auto& c : colours)
    for (const double value : c) {
      fractions = fractions || value != std::floor(value);
      largest = std::max(largest, value);
    }
  const double scale = fractions && largest <= 1 ? 255 : 1;
  for (const auto& c : colours)
    cloud.colors.push_back({colour(scale * c[0]), colour(scale * c[1]), colour(scale * c[2])});
  return cloud;
}

}  // namespace

Cloud read_cloud(const std::string& bytes, const std::string& title) {
  return bytes.starts_with("ply") ? read_ply(bytes, title) : read_xyz(bytes, title);
}

}  // namespace face::decode
