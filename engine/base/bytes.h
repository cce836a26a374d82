// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace engine {

static_assert(std::endian::native == std::endian::little, "the canonical byte form is little-endian");

using Bytes = std::vector<std::uint8_t>;

// Appends values in their canonical byte form: fixed-width little-endian numbers, lengths as 64-bit counts.
class ByteWriter {
 public:
  explicit ByteWriter(Bytes& bytes) : bytes_(bytes) {}
  void raw(const void* data, std::size_t size) {
    if (size == 0) return;
    const std::size_t at = bytes_.size();
    bytes_.resize(at + size);
    std::memcpy(bytes_.data() + at, data, size);
  }
  template <class T>
  void number(T value) {
    static_assert(std::is_arithmetic_v<T>);
    raw(&value, sizeof value);
  }
  void count(std::size_t value) { number(static_cast<std::uint64_t>(value)); }
  void text(std::string_view value) {
    count(value.size());
    raw(value.data(), value.size());
  }

 private:
  Bytes& bytes_;
};

// Reads what ByteWriter wrote; throws std::runtime_error where the bytes end too early.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  void raw(void* data, std::size_t size) {
    need(size);
    if (size != 0) std::memcpy(data, bytes_.data() + at_, size);
    at_ += size;
  }
  template <class T>
  T number() {
    T value;
    raw(&value, sizeof value);
    return value;
  }
  // A count of things that take at least `least` bytes each: checked against what is left, so that damaged bytes cannot
  // ask for more memory than there is data.
  std::size_t count(std::size_t least = 1) {
    const auto value = number<std::uint64_t>();
    if (least != 0 && value > left() / least) throw std::runtime_error("the bytes of a value end too early");
    return static_cast<std::size_t>(value);
  }
  std::string text() {
    std::string value(count(), '\0');
    raw(value.data(), value.size());
    return value;
  }
  std::size_t left() const { return bytes_.size() - at_; }

 private:
  void need(std::size_t size) const {
    if (size > left()) throw std::runtime_error("the bytes of a value end too early");
  }
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

}  // namespace engine
