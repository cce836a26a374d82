// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/zip_file.h"

#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "nodes/base/check.h"
#include "nodes/decode/input_file.h"

namespace face::decode {
namespace {

constexpr std::size_t end_size = 22, entry_size = 46, local_size = 30;
constexpr std::size_t longest_comment = 65535;
constexpr std::size_t most_inflated = std::size_t{1} << 32;

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& title) : bytes_(bytes), title_(title) {}

  std::map<std::string, std::string> read() {
    const std::size_t end = find_end();
    const std::size_t count = number(end + 10, 2);
    std::size_t at = number(end + 16, 4);
    std::map<std::string, std::string> files;
    for (std::size_t i = 0; i < count; ++i) {
      expect(at, entry_size, "PK\x01\x02", "an entry of the archive's list");
      const std::size_t name_size = number(at + 28, 2);
      const std::string_view name = part(at + entry_size, name_size);
      files[std::string(name)] = content(at, name);
      at += entry_size + name_size + number(at + 30, 2) + number(at + 32, 2);
    }
    return files;
  }

 private:
  std::string_view part(std::size_t at, std::size_t size) const {
    if (at > bytes_.size() || size > bytes_.size() - at)
      fail(title_, " byte ", at, ": the archive is cut off, expected ", size, " bytes more");
    return bytes_.substr(at, size);
  }
  std::size_t number(std::size_t at, std::size_t size) const {
    std::size_t value = 0;
    for (std::size_t i = 0; const char c : part(at, size))
      value |= static_cast<std::size_t>(static_cast<std::uint8_t>(c)) << (8 * i++);
    return value;
  }
  void expect(std::size_t at, std::size_t size, std::string_view mark, const char* what) const {
    if (!part(at, size).starts_with(mark)) fail(title_, " byte ", at, ": found no ", what);
  }

  // The archive's list is found from its end, before a comment of any length.
  std::size_t find_end() const {
    const std::size_t first = bytes_.size() - std::min(bytes_.size(), end_size + longest_comment);
    const std::size_t end = bytes_.rfind("PK\x05\x06");
    if (end == std::string_view::npos || end < first || bytes_.size() - end < end_size)
      fail(title_, ": is no ZIP archive, or cut off: found no end of its list");
    return end;
  }

  std::string content(std::size_t entry, std::string_view name) const {
    const std::size_t flags = number(entry + 8, 2), method = number(entry + 10, 2), sum = number(entry + 16, 4);
    const std::size_t packed = number(entry + 20, 4), size = number(entry + 24, 4), local = number(entry + 42, 4);
    check((flags & 1) == 0, title_, ": ", name, " is encrypted, which is not read");
    check(packed != 0xffffffff && size != 0xffffffff && local != 0xffffffff, title_, ": ", name,
          " is larger than 4 GB, which is not read");
    expect(local, local_size, "PK\x03\x04", "file of the archive");
    const std::string_view data = part(local + local_size + number(local + 26, 2) + number(local + 28, 2), packed);
    check(method == 0 || method == 8, title_, ": ", name, " is packed by method ", method,
          ", expected 0 (stored) or 8 (deflate)");
    std::string result = method == 0 ? std::string(data) : inflated(data, size, name);
    check(result.size() == size, title_, ": ", name, " has ", result.size(), " bytes, expected ", size);
    const auto found = crc32_z(0, reinterpret_cast<const Bytef*>(result.data()), result.size());
    check(found == sum, title_, ": ", name, " is damaged: its checksum is ", found, ", expected ", sum);
    return result;
  }

  std::string inflated(std::string_view data, std::size_t size, std::string_view name) const {
    // Deflate packs at most about 1032 to 1: a size beyond that is a lie that must not cost memory.
    check(size < most_inflated && size / 1100 <= data.size(), title_, ": ", name, " cannot have ", size, " bytes");
    std::string result(size, '\0');
    z_stream stream{};
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
    stream.avail_in = static_cast<uInt>(data.size());
    stream.next_out = reinterpret_cast<Bytef*>(result.data());
    stream.avail_out = static_cast<uInt>(size);
    check(inflateInit2(&stream, -MAX_WBITS) == Z_OK, title_, ": ", name, " cannot be unpacked");
    const int state = ::inflate(&stream, Z_FINISH);
    const std::size_t left = stream.avail_out;
    inflateEnd(&stream);
    check(state == Z_STREAM_END && left == 0, title_, ": ", name, " is damaged: it cannot be unpacked");
    return result;
  }

  std::string_view bytes_;
  const std::string& title_;
};

}  // namespace

std::map<std::string, std::string> read_zip(const engine::File& file) {
  const std::string title = title_of(file), bytes = read_bytes(file);
  return Reader(bytes, title).read();
}

}  // namespace face::decode
