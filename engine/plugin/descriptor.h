// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/declare/call.h"

namespace engine {

// Bumped whenever a type that crosses the border between engine and plugin changes.
inline constexpr std::uint32_t abi_version = 1;

// What must agree between the engine and a plugin. Read from the file, before any code of the plugin runs: plain bytes
// in a section of their own.
struct PluginTags {
  char magic[16];
  std::uint32_t abi;
  char compiler[48];
  char standard_library[48];
  char flags[48];
};
inline constexpr char plugin_magic[16] = "facegraph-node";
inline constexpr const char* plugin_tags_section = "facegraph_tags";
inline constexpr const char* plugin_entry_symbol = "facegraph_plugin";

#define ENGINE_TEXT_OF(x) #x
#define ENGINE_TEXT(x) ENGINE_TEXT_OF(x)

// The tags of the translation unit that includes this.
#if defined(__clang__)
#define ENGINE_COMPILER "clang " ENGINE_TEXT(__clang_major__)
#else
#define ENGINE_COMPILER "gcc " ENGINE_TEXT(__GNUC__)
#endif
#if defined(__SANITIZE_ADDRESS__)
#define ENGINE_SANITIZER " address-sanitizer"
#elif defined(__SANITIZE_THREAD__)
#define ENGINE_SANITIZER " thread-sanitizer"
#else
#define ENGINE_SANITIZER ""
#endif
#ifdef __AVX2__
#define ENGINE_INSTRUCTIONS "x86-64-v3"
#else
#define ENGINE_INSTRUCTIONS "x86-64"
#endif
inline constexpr PluginTags this_abi = {"facegraph-node", abi_version, ENGINE_COMPILER,
                                        "libstdc++ cxx11-abi " ENGINE_TEXT(_GLIBCXX_USE_CXX11_ABI),
                                        ENGINE_INSTRUCTIONS ENGINE_SANITIZER};

struct PluginDescriptor {
  // The plugin's nodes, in the order of its object files.
  std::vector<NodeDeclaration> (*nodes)();
};

}  // namespace engine
