// SPDX-License-Identifier: Apache-2.0
#include "engine/store/checksum.h"

#include <nmmintrin.h>

#include <cstring>

namespace engine::store {

std::uint32_t crc32c(const void* data, std::size_t size) {
  const auto* at = static_cast<const std::uint8_t*>(data);
  std::uint64_t sum = 0xffffffffU;
  for (; size >= 8; size -= 8, at += 8) {
    std::uint64_t word;
    std::memcpy(&word, at, 8);
    sum = _mm_crc32_u64(sum, word);
  }
  auto narrow = static_cast<std::uint32_t>(sum);
  for (; size > 0; --size, ++at) narrow = _mm_crc32_u8(narrow, *at);
  return ~narrow;
}

}  // namespace engine::store
