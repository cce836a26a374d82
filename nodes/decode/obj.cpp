// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/obj.h"

#include <charconv>
#include <cmath>
#include <cstring>

#include "nodes/base/check.h"

namespace face::decode {
namespace {

constexpr std::uint32_t no_uv = UINT32_MAX;

// One pass over the text; keeps the line number for messages.
class Reader {
 public:
  Reader(std::string_view text, const std::string& name) : at_(text.data()), end_(at_ + text.size()), name_(name) {}

  Obj read() {
    obj_.polygon_starts.push_back(0);
    for (; at_ < end_; ++line_) {
      const void* newline = std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_));
      stop_ = newline ? static_cast<const char*>(newline) : end_;
      const char* next = newline ? stop_ + 1 : end_;
      while (stop_ > at_ && (stop_[-1] == '\r' || is_space(stop_[-1]))) --stop_;
      skip_spaces();
      read_line();
      at_ = next;
    }
    if (!all_have_uvs_) obj_.corner_uvs.clear();
    return std::move(obj_);
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t'; }
  void skip_spaces() {
    while (at_ < stop_ && is_space(*at_)) ++at_;
  }
  bool takes(std::string_view keyword) {
    const auto size = static_cast<std::ptrdiff_t>(keyword.size());
    if (stop_ - at_ <= size || std::memcmp(at_, keyword.data(), keyword.size()) != 0 || !is_space(at_[size]))
      return false;
    at_ += size;
    skip_spaces();
    return true;
  }
  std::string rest() const { return std::string(at_, stop_); }

  void read_line() {
    if (takes("v")) {
      obj_.points.push_back({number(), number(), number()});
    } else if (takes("vt")) {
      obj_.uvs.push_back({number(), number()});
    } else if (takes("f")) {
      read_polygon();
    } else if (takes("usemtl")) {
      obj_.materials.push_back({rest(), static_cast<std::uint32_t>(obj_.polygon_starts.size() - 1)});
    }
  }

  float number() {
    skip_spaces();
    float value = 0;
    const auto [end, error] = std::from_chars(at_, stop_, value);
    if (error != std::errc() || !std::isfinite(value) || (end < stop_ && !is_space(*end)))
      fail(name_, " line ", line_, ": found \"", rest(), "\", expected a finite number");
    at_ = end;
    return value;
  }

  // A 1-based index, or a negative one that counts from the last element read so far.
  std::uint32_t index(std::size_t count, const char* what) {
    long value = 0;
    const auto [end, error] = std::from_chars(at_, stop_, value);
    if (error != std::errc()) fail(name_, " line ", line_, ": found \"", rest(), "\", expected the index of a ", what);
    const long found = value;
    if (value < 0) value += static_cast<long>(count) + 1;
    if (value < 1 || value > static_cast<long>(count))
      fail(name_, " line ", line_, ": found ", what, " ", found, ", expected one of 1 to ", count);
    at_ = end;
    return static_cast<std::uint32_t>(value - 1);
  }

  void read_polygon() {
    const std::size_t first = obj_.corners.size();
    for (skip_spaces(); at_ < stop_; skip_spaces()) {
      obj_.corners.push_back(index(obj_.points.size(), "vertex"));
      std::uint32_t uv = no_uv;
      if (at_ < stop_ && *at_ == '/') {
        ++at_;
        if (at_ < stop_ && *at_ != '/' && !is_space(*at_)) uv = index(obj_.uvs.size(), "texture coordinate");
        while (at_ < stop_ && !is_space(*at_)) ++at_;  // the normal
      }
      if (at_ < stop_ && !is_space(*at_)) fail(name_, " line ", line_, ": found \"", rest(), "\", expected a space");
      all_have_uvs_ = all_have_uvs_ && uv != no_uv;
      obj_.corner_uvs.push_back(uv);
    }
    const std::size_t count = obj_.corners.size() - first;
    if (count < 3) fail(name_, " line ", line_, ": found a polygon of ", count, " corners, expected 3 or more");
    obj_.polygon_starts.push_back(static_cast<std::uint32_t>(obj_.corners.size()));
  }

  const char* at_;
  const char* end_;
  const char* stop_ = nullptr;  // end of the current line
  const std::string& name_;
  std::size_t line_ = 1;
  bool all_have_uvs_ = true;
  Obj obj_;
};

}  // namespace

Obj read_obj(std::string_view text, const std::string& name) { return Reader(text, name).read(); }

}  // namespace face::decode
