// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/bytes.h"

namespace engine {

// A shared library as bytes: it is never loaded, and nothing in it is trusted. Throws PluginError, which names the file
// and what is wrong with it.
class ElfFile {
 public:
  explicit ElfFile(const std::string& path) : ElfFile(path, false) {}
  // The build-id of a library by its first pages, where the linker puts it; empty where it is not there.
  static Bytes build_id_at_start(const std::string& path) { return ElfFile(path, true).build_id_; }

  struct Segment {
    std::uint64_t address = 0, size_in_memory = 0;
    std::uint32_t flags = 0;
    std::span<const std::uint8_t> bytes;
  };
  // What the loader maps, with everything zeroed that tells nothing of the code: where the sections are (they move with
  // the debugging information, which is not mapped) and the build-id.
  std::vector<Segment> loadable_segments() const;

  std::vector<std::string> needed() const;             // DT_NEEDED, in order
  std::vector<std::string> run_path() const;           // DT_RUNPATH, else DT_RPATH; $ORIGIN is not replaced
  const Bytes& build_id() const { return build_id_; }  // empty where there is none

  // The bytes of a named section; empty where there is none.
  std::string section(std::string_view name) const;

 private:
  struct Range {
    std::uint64_t offset = 0, size = 0;
  };
  struct ProgramHeader {
    std::uint32_t type = 0, flags = 0;
    std::uint64_t address = 0, size_in_memory = 0;
    Range file;
  };
  ElfFile(const std::string& path, bool start_only);
  [[noreturn]] void fail(const std::string& what) const;
  template <class T>
  T read(std::uint64_t offset, const char* what) const;
  std::span<const std::uint8_t> part(Range range, const char* what) const;
  std::string text(Range table, std::uint64_t at, const char* what) const;
  std::uint64_t offset_of(std::uint64_t address) const;
  void read_dynamic();
  void read_build_id(bool start_only);

  std::string path_;
  Bytes bytes_, build_id_;
  std::vector<ProgramHeader> program_headers_;
  std::uint64_t sections_offset_ = 0;
  std::uint32_t section_count_ = 0, section_names_ = 0;
  std::vector<std::string> needed_;
  std::string run_path_;
};

}  // namespace engine
