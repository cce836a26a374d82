// SPDX-License-Identifier: Apache-2.0
#include "engine/store/codec.h"

#include <stdexcept>

#include "engine/store/checksum.h"

namespace engine::store {
namespace {

constexpr std::uint8_t is_sequence = 1, has_warned = 2;

// Ends encoded bytes with their checksum.
Bytes sealed(Bytes bytes) {
  const std::uint32_t sum = crc32c(bytes.data(), bytes.size());
  ByteWriter(bytes).number(sum);
  return bytes;
}

std::span<const std::uint8_t> unsealed(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 4) throw std::runtime_error("the bytes of a record end too early");
  const auto content = bytes.first(bytes.size() - 4);
  std::uint32_t sum;
  std::memcpy(&sum, bytes.data() + content.size(), 4);
  if (crc32c(content.data(), content.size()) != sum) throw std::runtime_error("the bytes of a record are damaged");
  return content;
}

void write_parts(ByteWriter& writer, const std::vector<KeyPart>& parts) {
  writer.count(parts.size());
  for (const KeyPart& part : parts) {
    writer.text(part.label);
    writer.text(part.value);
    writer.text(part.origin);
  }
}

std::vector<KeyPart> read_parts(ByteReader& reader) {
  std::vector<KeyPart> parts(reader.count(24));
  for (KeyPart& part : parts) {
    part.label = reader.text();
    part.value = reader.text();
    part.origin = reader.text();
  }
  return parts;
}

}  // namespace

Bytes encode_outputs(const std::vector<OutputRecord>& outputs) {
  Bytes bytes;
  ByteWriter writer(bytes);
  writer.count(outputs.size());
  for (const OutputRecord& output : outputs) {
    writer.number(static_cast<std::uint8_t>((output.sequence ? is_sequence : 0) | (output.warned ? has_warned : 0)));
    writer.count(output.elements.size());
    for (const OutputRecord::Element& element : output.elements) {
      writer.raw(element.identity.bytes.data(), element.identity.bytes.size());
      writer.text(element.id);
    }
  }
  return sealed(std::move(bytes));
}

std::vector<OutputRecord> decode_outputs(std::span<const std::uint8_t> bytes) {
  ByteReader reader(unsealed(bytes));
  std::vector<OutputRecord> outputs(reader.count(9));
  for (OutputRecord& output : outputs) {
    const auto flags = reader.number<std::uint8_t>();
    output.sequence = (flags & is_sequence) != 0;
    output.warned = (flags & has_warned) != 0;
    output.elements.resize(reader.count(40));
    for (OutputRecord::Element& element : output.elements) {
      reader.raw(element.identity.bytes.data(), element.identity.bytes.size());
      element.id = reader.text();
    }
  }
  return outputs;
}

Bytes encode_details(const TaskRecord& record) {
  Bytes bytes;
  ByteWriter writer(bytes);
  writer.number(record.seconds);
  writer.count(record.warnings.size());
  for (const std::string& warning : record.warnings) writer.text(warning);
  write_parts(writer, record.parts);
  return sealed(std::move(bytes));
}

void decode_details(std::span<const std::uint8_t> bytes, TaskRecord& record) {
  ByteReader reader(unsealed(bytes));
  record.seconds = reader.number<double>();
  record.warnings.resize(reader.count(8));
  for (std::string& warning : record.warnings) warning = reader.text();
  record.parts = read_parts(reader);
}

Bytes encode_history(const NodeHistory& history) {
  Bytes bytes;
  ByteWriter writer(bytes);
  writer.count(history.entries.size());
  for (const NodeHistory::Entry& entry : history.entries) {
    writer.raw(entry.key.bytes.data(), entry.key.bytes.size());
    writer.text(entry.element);
  }
  write_parts(writer, history.parts);
  return sealed(std::move(bytes));
}

NodeHistory decode_history(std::span<const std::uint8_t> bytes) {
  ByteReader reader(unsealed(bytes));
  NodeHistory history;
  history.entries.resize(reader.count(40));
  for (NodeHistory::Entry& entry : history.entries) {
    reader.raw(entry.key.bytes.data(), entry.key.bytes.size());
    entry.element = reader.text();
  }
  history.parts = read_parts(reader);
  return history;
}

}  // namespace engine::store
