// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>
#include <vector>

#include "engine/store/store.h"

namespace engine::store {

// Byte forms of what the index and the journals hold. The outputs stand apart from the rest of a record: a rerun that
// does nothing reads them alone. All end with a checksum; decoding throws std::runtime_error for damaged bytes.
Bytes encode_outputs(const std::vector<OutputRecord>& outputs);
std::vector<OutputRecord> decode_outputs(std::span<const std::uint8_t> bytes);

Bytes encode_details(const TaskRecord& record);  // warnings, parts, seconds
void decode_details(std::span<const std::uint8_t> bytes, TaskRecord& record);

Bytes encode_history(const NodeHistory& history);
NodeHistory decode_history(std::span<const std::uint8_t> bytes);

}  // namespace engine::store
