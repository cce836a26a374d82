// SPDX-License-Identifier: Apache-2.0
#include "engine/plugin/elf_file.h"

#include <elf.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "engine/base/problem.h"

namespace engine {
namespace {

constexpr std::streamoff kStartBytes = 16384;

Bytes read_file(const std::string& path, bool start_only) {
  std::error_code folder;
  if (std::filesystem::is_directory(path, folder)) throw PluginError("cannot read " + path + ": it is a folder");
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw PluginError("cannot read " + path + ": " + std::strerror(errno));
  const std::streamoff size =
      start_only ? std::min<std::streamoff>(file.tellg(), kStartBytes) : std::streamoff(file.tellg());
  Bytes bytes(size > 0 ? static_cast<std::size_t>(size) : 0);
  file.seekg(0);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
    throw PluginError("cannot read " + path + ": the disk fails");
  return bytes;
}

constexpr std::uint64_t aligned(std::uint64_t size) { return (size + 3) & ~std::uint64_t{3}; }

}  // namespace

void ElfFile::fail(const std::string& what) const {
  throw PluginError(path_ + " is no usable shared library: " + what);
}

std::span<const std::uint8_t> ElfFile::part(Range range, const char* what) const {
  if (range.offset > bytes_.size() || range.size > bytes_.size() - range.offset)
    fail("it is truncated: expected " + std::string(what) + " at bytes " + std::to_string(range.offset) + " to " +
         std::to_string(range.offset + range.size) + ", the file has " + std::to_string(bytes_.size()));
  return std::span(bytes_).subspan(range.offset, range.size);
}

template <class T>
T ElfFile::read(std::uint64_t offset, const char* what) const {
  T value;
  std::memcpy(&value, part({offset, sizeof value}, what).data(), sizeof value);
  return value;
}

std::string ElfFile::text(Range table, std::uint64_t at, const char* what) const {
  const auto strings = part(table, what);
  if (at >= strings.size()) fail(std::string("a name lies outside ") + what);
  const auto* const start = strings.data() + at;
  const auto* const end = std::find(start, strings.data() + strings.size(), std::uint8_t{0});
  return {start, end};
}

ElfFile::ElfFile(const std::string& path, bool start_only) : path_(path), bytes_(read_file(path, start_only)) {
  if (bytes_.size() < SELFMAG || std::memcmp(bytes_.data(), ELFMAG, SELFMAG) != 0) fail("it is not an ELF file");
  if (bytes_.size() < sizeof(Elf64_Ehdr))
    fail("it is truncated: the file has " + std::to_string(bytes_.size()) + " bytes");
  const auto header = read<Elf64_Ehdr>(0, "the header");
  if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_ident[EI_DATA] != ELFDATA2LSB || header.e_machine != EM_X86_64)
    fail("it is not for x86-64 (its machine is " + std::to_string(header.e_machine) + ", expected " +
         std::to_string(EM_X86_64) + ")");
  if (header.e_type != ET_DYN)
    fail("its type is " + std::to_string(header.e_type) + ", expected " + std::to_string(ET_DYN) +
         " (a shared object)");
  if (header.e_phentsize != sizeof(Elf64_Phdr) || header.e_phnum == 0) fail("it has no program headers");
  for (std::uint64_t i = 0; i < header.e_phnum; ++i) {
    if (header.e_phoff > bytes_.size()) fail("it is truncated: the program headers lie behind its end");
    const auto raw = read<Elf64_Phdr>(header.e_phoff + i * sizeof(Elf64_Phdr), "the program headers");
    program_headers_.push_back({raw.p_type, raw.p_flags, raw.p_vaddr, raw.p_memsz, {raw.p_offset, raw.p_filesz}});
  }
  sections_offset_ = header.e_shoff;
  section_count_ = header.e_shentsize == sizeof(Elf64_Shdr) ? header.e_shnum : 0;
  section_names_ = header.e_shstrndx;
  if (!start_only) read_dynamic();
  read_build_id(start_only);
  std::fill_n(bytes_.begin() + offsetof(Elf64_Ehdr, e_shoff), sizeof header.e_shoff, std::uint8_t{0});
  std::fill_n(bytes_.begin() + offsetof(Elf64_Ehdr, e_shnum), sizeof header.e_shnum, std::uint8_t{0});
  std::fill_n(bytes_.begin() + offsetof(Elf64_Ehdr, e_shstrndx), sizeof header.e_shstrndx, std::uint8_t{0});
}

std::uint64_t ElfFile::offset_of(std::uint64_t address) const {
  for (const ProgramHeader& header : program_headers_)
    if (header.type == PT_LOAD && address >= header.address && address - header.address < header.file.size)
      return header.file.offset + (address - header.address);
  fail("address " + std::to_string(address) + " lies in no loadable segment");
}

void ElfFile::read_dynamic() {
  std::vector<std::uint64_t> names;
  std::uint64_t strings_address = 0;
  Range strings;
  std::uint64_t run_path = 0;
  bool new_run_path = false;
  for (const ProgramHeader& header : program_headers_) {
    if (header.type != PT_DYNAMIC) continue;
    const auto table = part(header.file, "the dynamic section");
    for (std::size_t at = 0; at + sizeof(Elf64_Dyn) <= table.size(); at += sizeof(Elf64_Dyn)) {
      Elf64_Dyn entry;
      std::memcpy(&entry, table.data() + at, sizeof entry);
      if (entry.d_tag == DT_NULL) break;
      if (entry.d_tag == DT_NEEDED) names.push_back(entry.d_un.d_val);
      if (entry.d_tag == DT_STRTAB) strings_address = entry.d_un.d_ptr;
      if (entry.d_tag == DT_STRSZ) strings.size = entry.d_un.d_val;
      if (entry.d_tag == DT_RUNPATH) {
        run_path = entry.d_un.d_val;
        new_run_path = true;
      }
      if (entry.d_tag == DT_RPATH && !new_run_path) run_path = entry.d_un.d_val;
    }
  }
  if (strings_address == 0) return;
  strings.offset = offset_of(strings_address);
  for (const std::uint64_t name : names) needed_.push_back(text(strings, name, "the dynamic strings"));
  if (run_path != 0) run_path_ = text(strings, run_path, "the dynamic strings");
}

void ElfFile::read_build_id(bool start_only) {
  for (const ProgramHeader& header : program_headers_) {
    if (header.type != PT_NOTE) continue;
    if (start_only && (header.file.offset > bytes_.size() || header.file.size > bytes_.size() - header.file.offset))
      continue;
    const auto notes = part(header.file, "a note");
    for (std::size_t at = 0; at + sizeof(Elf64_Nhdr) <= notes.size();) {
      Elf64_Nhdr note;
      std::memcpy(&note, notes.data() + at, sizeof note);
      const std::uint64_t name = at + sizeof note;
      const std::uint64_t content = name + aligned(note.n_namesz);
      if (content + note.n_descsz > notes.size()) break;
      if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 && std::memcmp(notes.data() + name, "GNU", 4) == 0) {
        const auto id = notes.subspan(content, note.n_descsz);
        build_id_.assign(id.begin(), id.end());
        std::fill_n(bytes_.begin() + static_cast<std::ptrdiff_t>(header.file.offset + content), note.n_descsz,
                    std::uint8_t{0});
      }
      at = content + aligned(note.n_descsz);
    }
    if (!build_id_.empty()) return;
  }
}

std::vector<ElfFile::Segment> ElfFile::loadable_segments() const {
  std::vector<Segment> segments;
  for (const ProgramHeader& header : program_headers_)
    if (header.type == PT_LOAD)
      segments.push_back(
          {header.address, header.size_in_memory, header.flags, part(header.file, "a loadable segment")});
  return segments;
}

std::vector<std::string> ElfFile::needed() const { return needed_; }

std::vector<std::string> ElfFile::run_path() const {
  std::vector<std::string> folders;
  for (std::size_t at = 0; at < run_path_.size();) {
    const std::size_t end = std::min(run_path_.find(':', at), run_path_.size());
    if (end > at) folders.push_back(run_path_.substr(at, end - at));
    at = end + 1;
  }
  return folders;
}

std::string ElfFile::section(std::string_view name) const {
  if (section_count_ == 0) return {};
  if (sections_offset_ > bytes_.size()) fail("it is truncated: the section headers lie behind its end");
  if (section_names_ >= section_count_)
    fail("the section names lie in section " + std::to_string(section_names_) + " of " +
         std::to_string(section_count_));
  const auto header = [&](std::uint64_t index) {
    return read<Elf64_Shdr>(sections_offset_ + index * sizeof(Elf64_Shdr), "the section headers");
  };
  const auto names = header(section_names_);
  for (std::uint64_t i = 0; i < section_count_; ++i) {
    const auto found = header(i);
    if (text({names.sh_offset, names.sh_size}, found.sh_name, "the section names") != name) continue;
    if (found.sh_type == SHT_NOBITS) return {};
    const auto bytes = part({found.sh_offset, found.sh_size}, "the section");
    return {bytes.begin(), bytes.end()};
  }
  return {};
}

}  // namespace engine
