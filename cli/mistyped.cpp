// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "engine/base/problem.h"

namespace cli {

std::string what_is_wrong(const CommandTree& tree, const Mistyped& mistyped, const Common& common) {
  const CommandTree* command = &tree;
  std::string typed;  // "cache gc: "
  std::vector<std::string> options;
  const auto add_options = [&] {
    for (const CommandTree::Option& option : command->options)
      options.insert(options.end(), option.names.begin(), option.names.end());
  };
  add_options();
  for (const std::string& name : mistyped.commands) {
    command = &*std::find_if(command->commands.begin(), command->commands.end(),
                             [&](const CommandTree& inner) { return inner.name == name; });
    typed += (typed.empty() ? "" : " ") + name;
    add_options();
  }
  if (!typed.empty()) typed += ": ";
  std::vector<std::string> commands;
  for (const CommandTree& inner : command->commands) commands.push_back(inner.name);

  const std::vector<std::string>& rest = mistyped.rest;
  const auto is_option = [](const std::string& text) { return text.starts_with("-"); };
  const auto word = std::find_if_not(rest.begin(), rest.end(), is_option);
  if (!commands.empty() && word != rest.end()) {
    if (command == &tree)
      for (const PluginCommand& other : plugin_commands(common)) commands.push_back(other.name);
    return typed + "there is no command '" + *word + "'" + engine::did_you_mean(*word, commands);
  }
  if (const auto option = std::find_if(rest.begin(), rest.end(), is_option); option != rest.end())
    return typed + "there is no option '" + *option + "'" + engine::did_you_mean(*option, options);
  if (!commands.empty()) return typed + "expected one of the commands " + engine::listed(commands, "or");
  return typed + (word == rest.end() ? mistyped.problem : "found a word too much: '" + *word + "'");
}

}  // namespace cli
