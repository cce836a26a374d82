// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <compare>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace engine {

// A SHA-256.
struct Digest {
  std::array<std::uint8_t, 32> bytes{};

  auto operator<=>(const Digest&) const = default;
  bool empty() const { return *this == Digest{}; }
  std::string hex() const;
  // The first 12 hexadecimal digits, for messages.
  std::string brief() const { return hex().substr(0, 12); }
  static Digest from_hex(std::string_view text);  // throws std::invalid_argument
};

Digest digest_of(std::span<const std::uint8_t> bytes);
Digest digest_of(std::string_view text);

// SHA-256 of what is written to it piece by piece.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;
  Hasher& write(std::span<const std::uint8_t> bytes);
  Hasher& write(std::string_view text);
  Digest finish();

 private:
  void* context_;
};

}  // namespace engine

template <>
struct std::hash<engine::Digest> {
  std::size_t operator()(const engine::Digest& digest) const noexcept {
    std::size_t value;
    std::memcpy(&value, digest.bytes.data(), sizeof value);
    return value;
  }
};
