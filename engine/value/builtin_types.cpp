// SPDX-License-Identifier: Apache-2.0
#include <cstdint>

#include "engine/port.h"
#include "engine/value/codec.h"

namespace engine {
namespace codec {

void append_quoted(std::string& out, std::string_view text) {
  constexpr char digits[] = "0123456789abcdef";
  out += '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += "\\u00";
      out += digits[static_cast<unsigned char>(c) >> 4];
      out += digits[c & 15];
    } else {
      out += c;
    }
  }
  out += '"';
}

}  // namespace codec

namespace {

template <class T>
TypeInfo builtin(const char* name, const char* doc) {
  TypeInfo info;
  info.name = name;
  info.doc = doc;
  codec::derive<T>(info);
  return info;
}

// A file's content is kept by the store, not by a codec: the run module encodes what identifies it.
TypeInfo file_type() {
  TypeInfo info;
  info.name = "file";
  info.doc = "A file (content and suffix) or a folder of files.";
  info.layout = "file";
  info.size_bytes = [](const void* value) {
    const File& file = *static_cast<const File*>(value);
    return sizeof(File) + (file.in_memory() ? file.bytes().size() : 0);
  };
  info.show = [](const void* value) {
    std::string out;
    codec::append_quoted(out, static_cast<const File*>(value)->path());
    return out;
  };
  return info;
}

}  // namespace

template <>
const TypeInfo& type_of<double>() {
  static const TypeInfo info = builtin<double>("number", "A real number.");
  return info;
}
template <>
const TypeInfo& type_of<std::int64_t>() {
  static const TypeInfo info = builtin<std::int64_t>("integer", "A whole number of 64 bits.");
  return info;
}
template <>
const TypeInfo& type_of<bool>() {
  static const TypeInfo info = builtin<bool>("flag", "True or false.");
  return info;
}
template <>
const TypeInfo& type_of<std::string>() {
  static const TypeInfo info = builtin<std::string>("text", "UTF-8 text.");
  return info;
}
template <>
const TypeInfo& type_of<File>() {
  static const TypeInfo info = file_type();
  return info;
}

}  // namespace engine
