// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/list_takes.h"

#include <set>

#include "nodes/base/check.h"
#include "nodes/decode/input_file.h"

namespace face::decode {

void list_takes(const engine::File& folder, engine::SeqWriter<std::string>& takes) {
  check(folder.is_folder(), title_of(folder), ": is a file, expected the folder of a recorded stream");
  std::set<std::string> names;
  for (const engine::File::Entry& entry : folder.entries())
    for (const std::string kind : {"depth/", "cloud/"}) {
      if (!entry.name.starts_with(kind)) continue;
      const std::size_t end = entry.name.find('/', kind.size());
      if (end != std::string::npos) names.insert(entry.name.substr(kind.size(), end - kind.size()));
    }
  check(!names.empty(), title_of(folder), ": has no files like depth/TAKE/17.png or cloud/TAKE/17.ply among its ",
        folder.entries().size());
  for (const std::string& name : names) takes.push(name, name);
}

}  // namespace face::decode
