// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>

#include "engine/base/bytes.h"
#include "engine/port.h"
#include "engine/store/store.h"
#include "engine/value/value.h"

namespace engine::run {

// A file or folder of the user's: its identity is that of content and suffix.
struct SourceFile {
  File file;
  Digest identity;
  std::vector<std::string> paths;  // every file read, to see that none changed during the run
};
// Throws EngineError where it cannot be read, and for symbolic links in a folder.
SourceFile open_source(const std::string& path, Store& store);

// Where tasks write files of their own; the store may move them.
std::string scratch_root(const Store& store);

// The canonical bytes of a value. The content of a File goes to the store at once; its bytes name it. A file outside
// scratch_root stays where it is.
Bytes encode_value(const Value& value, Store& store);
// What identifies a File that a node made. known = false where the store has lost it.
struct StoredFile {
  bool known = false;
  std::string suffix;
  Digest content;
};
StoredFile stored_file(const Digest& identity, Store& store);

// nullopt where the store no longer has the value.
std::optional<Value> load_value(const TypeInfo& type, const Digest& identity, Store& store);

}  // namespace engine::run
