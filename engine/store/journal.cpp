// SPDX-License-Identifier: Apache-2.0
#include "engine/store/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "engine/store/checksum.h"

namespace engine::store {
namespace {

constexpr char kMagic[8] = {'F', 'G', 'J', 'R', 'N', 'L', '0', '1'};
enum Kind : std::uint8_t { kRecord = 1, kValue, kHistory, kFileDigest };

void write_digest(ByteWriter& writer, const Digest& digest) { writer.raw(digest.bytes.data(), digest.bytes.size()); }

Digest read_digest(ByteReader& reader) {
  Digest digest;
  reader.raw(digest.bytes.data(), digest.bytes.size());
  return digest;
}

void write_blob(ByteWriter& writer, const Bytes& bytes) {
  writer.count(bytes.size());
  writer.raw(bytes.data(), bytes.size());
}

Bytes read_blob(ByteReader& reader) {
  Bytes bytes(reader.count());
  reader.raw(bytes.data(), bytes.size());
  return bytes;
}

// Appends a frame: 32-bit length and checksum of the payload, then the payload that `fill` writes.
template <class Fill>
void frame(Bytes& into, Kind kind, const Fill& fill) {
  const std::size_t start = into.size();
  ByteWriter writer(into);
  writer.number<std::uint64_t>(0);
  writer.number<std::uint8_t>(kind);
  fill(writer);
  const auto length = static_cast<std::uint32_t>(into.size() - start - 8);
  const std::uint32_t sum = crc32c(into.data() + start + 8, length);
  std::memcpy(into.data() + start, &length, 4);
  std::memcpy(into.data() + start + 4, &sum, 4);
}

void take(std::span<const std::uint8_t> payload, Entries& into) {
  ByteReader reader(payload);
  into.bytes += payload.size();
  switch (reader.number<std::uint8_t>()) {
    case kRecord: {
      const Digest key = read_digest(reader);
      Bytes outputs = read_blob(reader);
      Bytes details = read_blob(reader);
      into.records[key] = std::make_shared<Entries::Record>(Entries::Record{std::move(outputs), std::move(details)});
      break;
    }
    case kValue: {
      const Digest digest = read_digest(reader);
      into.values[digest] = std::make_shared<Bytes>(read_blob(reader));
      break;
    }
    case kHistory: {
      std::string graph = reader.text();
      std::string node = reader.text();
      const auto written_ns = reader.number<std::int64_t>();
      into.histories[{std::move(graph), std::move(node)}] = {written_ns, read_blob(reader)};
      break;
    }
    case kFileDigest: {
      FileState state;
      state.device = reader.number<std::uint64_t>();
      state.inode = reader.number<std::uint64_t>();
      state.size = reader.number<std::uint64_t>();
      state.mtime_ns = reader.number<std::int64_t>();
      state.ctime_ns = reader.number<std::int64_t>();
      into.file_digests[{state.device, state.inode}] = {state, read_digest(reader)};
      break;
    }
    default:
      break;
  }
}

template <class Map, class Key>
auto look(const Map& map, const Key& key) -> const typename Map::mapped_type* {
  const auto found = map.find(key);
  return found == map.end() ? nullptr : &found->second;
}

}  // namespace

std::string Journal::path(std::uint64_t number) const {
  return folder_ + "/journals/" + owner_ + "-" + std::to_string(number);
}

void Journal::append(const Bytes& frames) {
  if (!file_) {
    const std::string name = path(number_ + 1);
    Fd made(open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666));
    if (!made) fail_store(folder_, name, errno);
    if (!write_all(made.get(), kMagic, sizeof kMagic)) {
      const int error = errno;
      unlink(name.c_str());
      fail_store(folder_, name, error);
    }
    file_ = std::move(made);
    size_ = sizeof kMagic;
    ++number_;
  }
  if (!write_all(file_.get(), frames.data(), frames.size())) {
    // Takes the torn frame back: whatever follows it would be lost. Where even that fails, a new file is begun.
    const int error = errno;
    if (ftruncate(file_.get(), static_cast<off_t>(size_)) != 0 && open_->empty()) file_.close();
    fail_store(folder_, path(number_), error);
  }
  size_ += frames.size();
}

void Journal::write_locked(const Bytes* record_frame) {
  const std::size_t before = waiting_.size();
  if (record_frame != nullptr) ByteWriter(waiting_).raw(record_frame->data(), record_frame->size());
  if (waiting_.empty()) return;
  try {
    append(waiting_);
  } catch (...) {
    waiting_.resize(before);
    throw;
  }
  waiting_.clear();
}

void Journal::add_record(const Digest& key, Entries::Record record) {
  Bytes bytes;
  bytes.reserve(record.outputs.size() + record.details.size() + 64);
  frame(bytes, kRecord, [&](ByteWriter& writer) {
    write_digest(writer, key);
    write_blob(writer, record.outputs);
    write_blob(writer, record.details);
  });
  auto held = std::make_shared<const Entries::Record>(std::move(record));
  const std::lock_guard lock(mutex_);
  write_locked(&bytes);
  open_->records[key] = std::move(held);
  open_->bytes += bytes.size();
}

void Journal::add_value(const Digest& digest, const Bytes& value) {
  Bytes bytes;
  bytes.reserve(value.size() + 64);
  frame(bytes, kValue, [&](ByteWriter& writer) {
    write_digest(writer, digest);
    write_blob(writer, value);
  });
  auto held = std::make_shared<const Bytes>(value);
  const std::lock_guard lock(mutex_);
  if (!open_->values.emplace(digest, std::move(held)).second) return;
  ByteWriter(waiting_).raw(bytes.data(), bytes.size());
  open_->bytes += bytes.size();
}

void Journal::add_history(const std::string& graph, const std::string& node, Entries::History history) {
  const std::lock_guard lock(mutex_);
  const std::size_t before = waiting_.size();
  frame(waiting_, kHistory, [&](ByteWriter& writer) {
    writer.text(graph);
    writer.text(node);
    writer.number(history.written_ns);
    write_blob(writer, history.entries);
  });
  open_->bytes += waiting_.size() - before;
  open_->histories[{graph, node}] = std::move(history);
}

void Journal::add_file_digest(const FileState& state, const Digest& digest) {
  const std::lock_guard lock(mutex_);
  const std::size_t before = waiting_.size();
  frame(waiting_, kFileDigest, [&](ByteWriter& writer) {
    for (const std::uint64_t number : {state.device, state.inode, state.size}) writer.number(number);
    for (const std::int64_t number : {state.mtime_ns, state.ctime_ns}) writer.number(number);
    write_digest(writer, digest);
  });
  open_->bytes += waiting_.size() - before;
  open_->file_digests[{state.device, state.inode}] = {state, digest};
}

void Journal::write_waiting() {
  const std::lock_guard lock(mutex_);
  write_locked(nullptr);
}

std::shared_ptr<const Entries::Record> Journal::record(const Digest& key) const {
  const std::lock_guard lock(mutex_);
  if (const auto* found = look(open_->records, key)) return *found;
  if (sealed_ != nullptr)
    if (const auto* found = look(sealed_->records, key)) return *found;
  return nullptr;
}

std::shared_ptr<const Bytes> Journal::value(const Digest& digest) const {
  const std::lock_guard lock(mutex_);
  if (const auto* found = look(open_->values, digest)) return *found;
  if (sealed_ != nullptr)
    if (const auto* found = look(sealed_->values, digest)) return *found;
  return nullptr;
}

std::optional<Entries::History> Journal::history(const std::string& graph, const std::string& node) const {
  const std::lock_guard lock(mutex_);
  if (const auto* found = look(open_->histories, std::pair(graph, node))) return *found;
  if (sealed_ != nullptr)
    if (const auto* found = look(sealed_->histories, std::pair(graph, node))) return *found;
  return std::nullopt;
}

std::optional<Entries::FileDigest> Journal::file_digest(std::uint64_t device, std::uint64_t inode) const {
  const std::lock_guard lock(mutex_);
  if (const auto* found = look(open_->file_digests, std::pair(device, inode))) return *found;
  if (sealed_ != nullptr)
    if (const auto* found = look(sealed_->file_digests, std::pair(device, inode))) return *found;
  return std::nullopt;
}

bool Journal::reaches(std::size_t records, std::size_t bytes) const {
  const std::lock_guard lock(mutex_);
  return open_->records.size() >= records || open_->bytes >= bytes;
}

std::shared_ptr<const Entries> Journal::seal() {
  const std::lock_guard lock(mutex_);
  if (sealed_ != nullptr) return sealed_;
  if (open_->empty()) return nullptr;
  write_locked(nullptr);
  file_.close();
  sealed_number_ = number_;
  sealed_ = std::exchange(open_, std::make_shared<Entries>());
  return sealed_;
}

void Journal::taken() {
  const std::lock_guard lock(mutex_);
  unlink(path(sealed_number_).c_str());
  sealed_.reset();
}

JournalReader::JournalReader(const std::string& path) : file_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}

bool JournalReader::read(Entries& into) {
  struct stat found;
  if (fstat(file_.get(), &found) != 0) return false;
  const auto size = static_cast<std::uint64_t>(found.st_size);
  if (size <= offset_) return false;
  Bytes bytes(size - offset_);
  const ssize_t got = pread(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset_));
  if (got <= 0) return false;
  bytes.resize(static_cast<std::size_t>(got));
  std::size_t at = 0;
  if (offset_ == 0) {
    if (bytes.size() < sizeof kMagic || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0) return false;
    at = sizeof kMagic;
  }
  const std::size_t first = at;
  while (bytes.size() - at >= 8) {
    std::uint32_t length;
    std::uint32_t sum;
    std::memcpy(&length, bytes.data() + at, 4);
    std::memcpy(&sum, bytes.data() + at + 4, 4);
    if (length == 0 || length > bytes.size() - at - 8 || crc32c(bytes.data() + at + 8, length) != sum) break;
    try {
      take(std::span(bytes).subspan(at + 8, length), into);
    } catch (const std::runtime_error&) {
      break;
    }
    at += 8 + length;
  }
  offset_ += at;
  return at > first;
}

}  // namespace engine::store
