// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/bytes.h"

namespace engine {

// Everything the engine knows of a value type. Two libraries that declare one name with different codec_version or
// layout are in conflict.
struct TypeInfo {
  std::string name;  // "mesh"
  int codec_version = 1;
  std::string doc;
  std::string layout;  // sizeof, alignof and the fields, as text
  struct View {
    std::string suffix;  // "png"
    std::string node;    // turns the value into a File with that suffix
  };
  std::vector<View> views;
  std::string difference;  // node that compares two values; may be empty

  std::size_t (*size_bytes)(const void* value) = nullptr;           // memory that it takes
  void (*encode)(const void* value, ByteWriter& writer) = nullptr;  // canonical bytes, lossless
  std::shared_ptr<const void> (*decode)(ByteReader& reader) = nullptr;
  std::string (*show)(const void* value) = nullptr;  // as JSON, for people
};

// The declared type of T. TYPE defines it; a link error "undefined reference to engine::type_of<T>()" means that T has
// no TYPE declaration (nodes/types/NAME.type.cpp).
template <class T>
__attribute__((visibility("default"))) const TypeInfo& type_of();

}  // namespace engine
