// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/digest.h"

namespace engine {

// What a plugin's results may depend on: its loadable segments (without the places of its sections and its build-id, so
// that comments, -g and moving the file change nothing), the same of our own libraries that it needs, and the build-ids
// of the foreign ones that it needs directly. The engine and the C and C++ runtime do not count. Own is what lies in
// one of own_library_folders or is found through a run path relative to the library ($ORIGIN). The library is not
// loaded. Throws PluginError for what is no x86-64 shared library.
Digest library_digest(const std::string& path, const std::vector<std::string>& own_library_folders);

// The bytes of a library's section, or empty where it has no such section.
std::string read_section(const std::string& path, std::string_view name);

}  // namespace engine
