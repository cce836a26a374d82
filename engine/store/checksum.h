// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>

namespace engine::store {

// CRC-32C (Castagnoli), by the processor's own instruction: finds what a digest does not cover, torn frames of a
// journal and flipped bytes of the index.
std::uint32_t crc32c(const void* data, std::size_t size);

}  // namespace engine::store
