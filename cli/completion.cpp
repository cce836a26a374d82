// SPDX-License-Identifier: Apache-2.0
// Completion scripts, made from the command line's own declarations, so that they cannot fall behind.
#include <stdexcept>

#include "cli/experiments.h"

namespace cli {
namespace {

std::string without(std::string text, const char* characters) {
  std::erase_if(text, [&](char c) { return std::string_view(characters).find(c) != std::string_view::npos; });
  return text;
}

// Options of a command and those of the program, which any command takes.
std::vector<CommandTree::Option> options_of(const CommandTree& command, const CommandTree& root) {
  std::vector<CommandTree::Option> options = command.options;
  for (const CommandTree::Option& option : root.options) {
    bool known = false;
    for (const CommandTree::Option& own : options) known |= own.names == option.names;
    if (!known) options.push_back(option);
  }
  return options;
}

std::string bash_case(const CommandTree& command, const CommandTree& root, const std::string& path) {
  std::string words;
  for (const CommandTree& inner : command.commands) words += inner.name + " ";
  for (const CommandTree::Option& option : options_of(command, root))
    for (const std::string& name : option.names) words += name + " ";
  std::string text = "    '" + path + "') words='" + without(words, "'") + "' ;;\n";
  for (const CommandTree& inner : command.commands) text += bash_case(inner, root, path + inner.name + " ");
  return text;
}

std::string bash_script(const CommandTree& root) {
  std::string known, folders, files;
  const auto note = [&](const auto& self, const CommandTree& command, const std::string& path) -> void {
    for (const CommandTree& inner : command.commands) {
      known += "'" + path + inner.name + "'|";
      self(self, inner, path + inner.name + " ");
    }
    for (const CommandTree::Option& option : command.options)
      for (const std::string& name : option.names) {
        if (option.value == "FOLDER" && folders.find(name + "|") == std::string::npos) folders += name + "|";
        if (!option.value.empty() && option.value != "FOLDER" && files.find(name + "|") == std::string::npos)
          files += name + "|";
      }
  };
  note(note, root, "");
  for (std::string* list : {&known, &folders, &files})
    if (!list->empty()) list->pop_back();
  return R"(# bash completion for facegraph: source it, or put it into ~/.local/share/bash-completion/completions/facegraph
_facegraph() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} path= word words=
  COMPREPLY=()
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case "$path$word" in
      )" +
         known + R"() path="$path$word " ;;
    esac
  done
  case "$previous" in
    )" + folders +
         R"() compopt -o filenames; COMPREPLY=($(compgen -d -- "$current")); return ;;
    )" + files +
         R"() compopt -o filenames; COMPREPLY=($(compgen -f -- "$current")); return ;;
  esac
  case "$path" in
)" + bash_case(root, root, "") +
         R"(  esac
  if [[ $path == 'describe ' && $current != -* ]]; then
    words=$(facegraph nodes 2>/dev/null | cut -d' ' -f1)
  fi
  COMPREPLY=($(compgen -W "$words" -- "$current"))
  if [[ -n $path && $current != -* ]]; then
    compopt -o filenames
    COMPREPLY+=($(compgen -f -- "$current"))
  fi
}
complete -F _facegraph facegraph
)";
}

std::string zsh_options(const CommandTree& command, const CommandTree& root) {
  std::string text;
  for (const CommandTree::Option& option : options_of(command, root))
    for (const std::string& name : option.names)
      text += " '*" + name + "[" + without(option.doc, "'[]:\\") + "]" +
              (option.value.empty()       ? ""
               : option.value == "FOLDER" ? ":folder:_files -/"
                                          : ":" + without(option.value, "'[]:\\") + ":_files") +
              "'";
  return text;
}

std::string zsh_function(const CommandTree& command, const CommandTree& root, const std::string& name) {
  std::string text = name + "() {\n";
  if (command.commands.empty()) {
    text += "  _arguments -s" + zsh_options(command, root) +
            (command.name == "describe" ? " '*:node:_facegraph_nodes'" : " '*:file:_files'") + "\n}\n";
    return text;
  }
  text += "  local -a commands=(";
  for (const CommandTree& inner : command.commands) text += " '" + inner.name + ":" + without(inner.doc, "':\\") + "'";
  text +=
      ")\n  local line state\n  _arguments -C" + zsh_options(command, root) +
      " '1:command:->command' '*::argument:->argument'\n  case $state in\n    command) _describe command commands ;;\n"
      "    argument) case $line[1] in\n";
  for (const CommandTree& inner : command.commands)
    text += "      " + inner.name + ") " + name + "_" + inner.name + " ;;\n";
  text += "    esac ;;\n  esac\n}\n";
  for (const CommandTree& inner : command.commands) text += zsh_function(inner, root, name + "_" + inner.name);
  return text;
}

}  // namespace

std::string completion_script(const CommandTree& root, const std::string& shell) {
  if (shell == "bash") return bash_script(root);
  if (shell == "zsh")
    return "#compdef facegraph\n# zsh completion for facegraph: put it as _facegraph into a folder of $fpath\n" +
           zsh_function(root, root, "_facegraph") +
           "_facegraph_nodes() {\n  compadd -- ${(f)\"$(facegraph nodes 2>/dev/null | cut -d' ' -f1)\"}\n}\n"
           // Loaded from $fpath at its first use, or sourced.
           "if [[ $funcstack[1] == _facegraph ]]; then\n  _facegraph \"$@\"\nelse\n  compdef _facegraph "
           "facegraph\nfi\n";
  throw std::invalid_argument("command line: completion " + shell + ": expected bash or zsh");
}

}  // namespace cli
