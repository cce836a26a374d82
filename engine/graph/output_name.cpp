// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/output_name.h"

#include "engine/graph/json_tree.h"

namespace engine {

std::string output_name_error(std::string_view name) {
  const std::string start = quoted_text(name) + " is no name of an output: ";
  if (name.find_first_of("/\\") != std::string_view::npos)
    return start + "it is one file in the output folder, without slashes";
  if (name.find("..") != std::string_view::npos) return start + "'..' is not allowed";
  for (const char c : name)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F || c == ':' || c == '*' || c == '?' || c == '"' || c == '<' ||
        c == '>' || c == '|')
      return start + "some disks cannot hold it";
  if (name.starts_with('.') || name.starts_with('-') || name.starts_with(' '))
    return start + "it starts with '" + std::string(1, name[0]) + "'";
  const std::size_t dot = name.find_last_of('.');
  if (dot == std::string_view::npos || dot + 1 == name.size())
    return start + "it has no suffix, such as \"" + std::string(name.substr(0, dot)) + ".txt\"";
  if (name.ends_with(' ')) return start + "it ends with a space";
  return {};
}

std::string folded(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

}  // namespace engine
