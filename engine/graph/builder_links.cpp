// SPDX-License-Identifier: Apache-2.0
// What references lead to, through the inputs and outputs of subgraphs.
#include <algorithm>

#include "engine/graph/builder.h"
#include "engine/graph/reference.h"

namespace engine {
namespace {

using Kind = JsonValue::Kind;

void append(std::vector<std::string>& ids, const std::vector<std::string>& more) {
  ids.insert(ids.end(), more.begin(), more.end());
}

bool looks_like_a_path(const std::string& text) {
  return text.find('/') != std::string::npos || text.find('\\') != std::string::npos ||
         text.find('.') != std::string::npos || text.starts_with("~") || text.starts_with("$");
}

constexpr int most_hops = 200;  // of one reference through inputs and outputs of subgraphs: keeps the stack small

const char* const how_files_come_in =
    ": a file comes in as a parameter of type \"path\", written \"${name}\", or as {\"file\": \"path\"}";

}  // namespace

Link Builder::broken(const Place& place, std::string text) {
  problem(place, std::move(text));
  return {};
}

void Builder::link_nodes() {
  for (const Deferred& deferred : deferred_) {
    FlatNode& node = nodes_[deferred.node];
    const JsonMember* const inputs = deferred.member->value.find("inputs");
    const auto name_of = [](const InputInfo& input) { return input.name; };
    std::vector<std::string> names;
    std::transform(node.info->inputs.begin(), node.info->inputs.end(), std::back_inserter(names), name_of);
    std::vector<std::string> misspelt, missing;
    std::vector<bool> given(names.size(), false);
    if (inputs != nullptr && !inputs->value.is(Kind::object)) {
      problem(inputs->value.place(),
              "found " + found(inputs->value) + ", expected an object of inputs: {\"port\": \"node\"}");
      node.input_missing = true;
      continue;
    }
    for (std::size_t i = 0; inputs != nullptr && i < inputs->value.members.size(); ++i) {
      const JsonMember& member = inputs->value.members[i];
      const int port = node.info->find_input(member.key);
      if (port < 0) {
        const bool param = node.info->find_param(member.key) >= 0;
        problem(member.place(), "'" + node.info->name + "' has no input " + quoted_text(member.key) +
                                    (param ? "; it is one of its \"params\"" : did_you_mean_of(member.key, names)));
        misspelt.push_back(member.key);
        continue;
      }
      given[port] = true;
      std::vector<Link>& links = node.ports[port];
      if (!member.value.is(Kind::array)) {
        links.push_back(link(deferred.scope, member.value));
      } else if (!node.info->inputs[port].variadic) {
        links.push_back(broken(member.value.place(), "found a list, but the input '" + member.key + "' of '" +
                                                         node.info->name + "' takes one reference"));
      } else if (member.value.items.empty()) {
        links.push_back(broken(member.value.place(), "found an empty list, expected at least one reference"));
      } else {
        for (const JsonValue& item : member.value.items) links.push_back(link(deferred.scope, item));
      }
    }
    for (std::size_t port = 0; port < names.size(); ++port)
      if (!given[port] && !node.info->inputs[port].optional) missing.push_back(names[port]);
    node.input_missing = !missing.empty();
    forgive_missing(misspelt, names, missing);
    for (const std::string& name : missing)
      problem(node.place, "the input '" + name + "' of '" + node.info->name + "' is not connected");
  }
}

// All outputs of all subgraphs, whether somebody reads them or not: what is wrong with them is to be told.
void Builder::link_outputs(FlatGraph& flat) {
  for (std::size_t i = 1; i < scopes_.size(); ++i) {
    for (auto& [name, output] : scopes_[i].outputs) link_output(static_cast<int>(i), name);
    for (auto& [name, input] : scopes_[i].inputs)
      if (input.given != nullptr && input.state == Scope::State::open) {
        JsonValue reference = *input.given;
        reference.kind = Kind::string;
        reference.text = "@" + name;
        link_input(static_cast<int>(i), reference);
      }
  }
  flat.outputs_reported = scopes_[0].outputs.empty();
  const JsonMember* const outputs = scopes_[0].file->tree.find("outputs");
  for (std::size_t i = 0; outputs != nullptr && i < outputs->value.members.size(); ++i) {
    const JsonMember& member = outputs->value.members[i];
    flat.outputs.push_back({member.key, link_output(0, member.key), member.place()});
  }
}

Link Builder::link_output(int index, const std::string& name) {
  Scope::Output& output = scopes_[index].outputs.at(name);
  const JsonValue& written = output.member->value;
  if (output.state == Scope::State::open) {  // a ring of references passes through an input, which finds it
    std::string param;
    if (index == 0 && (!written.is(Kind::string) || is_substitution(written.text, param)))
      output.link =
          broken(written.place(), "found " + found(written) + ", expected a reference to a node that makes a file");
    else
      output.link = link(index, written);
    output.state = Scope::State::done;
  }
  return output.link;
}

Link Builder::link(int index, const JsonValue& written) {
  Link result;
  if (link_depth_ >= most_hops)
    return broken(written.place(),
                  "the reference passes through more than " + std::to_string(most_hops) + " subgraphs");
  ++link_depth_;
  if (written.is(Kind::string))
    result = link_text(index, written);
  else if (written.is(Kind::object))
    result = link_file(written);
  else
    result = broken(written.place(), "found " + found(written) +
                                         ", expected a reference such as \"node\", \"node.output\" or \"${name}\"");
  --link_depth_;
  result.place = written.place();
  return result;
}

Link Builder::link_file(const JsonValue& written) {
  const JsonMember* const file = written.find("file");
  if (!check_object(written, {"file"}, "a fixed file")) return {};
  if (file == nullptr) {
    if (written.members.empty())
      problem(written.place(), "found an empty object, expected a reference or {\"file\": \"path\"}");
    return {};
  }
  if (!file->value.is(Kind::string) || file->value.text.empty())
    return broken(file->value.place(), "found " + found(file->value) + ", expected a path");
  if (file->value.text.find("${") != std::string::npos)
    return broken(file->value.place(),
                  "found " + found(file->value) +
                      ": a parameter of type \"path\" is written as the input itself, without {\"file\": ...}");
  Link link;
  link.kind = Link::Kind::file;
  link.path = resolve_path(*file->value.source, file->value.text);
  link.shown_path = shown_path(*file->value.source, file->value.text);
  link.value_place = file->value.place();
  return link;
}

Link Builder::link_param(int index, const JsonValue& written) {
  const BoundParam* const bound = find_param(index, written);
  if (bound == nullptr || bound->broken) return {};
  if (!bound->path)
    return broken(written.place(),
                  "'" + bound->type.name + "' is no path: an input takes a reference or a parameter of type \"path\"");
  Link link;
  if (bound->value == nullptr) {
    link.kind = Link::Kind::unset;
    link.unset_param = bound->setting;
    return link;
  }
  link.kind = Link::Kind::file;
  link.path = resolve_path(*bound->value->source, bound->value->text);
  link.shown_path = shown_path(*bound->value->source, bound->value->text);
  link.value_place = bound->value->place();
  return link;
}

Link Builder::link_input(int index, const JsonValue& written) {
  Reference reference;
  std::string error;
  if (!parse_reference(written.text.substr(1), reference, error) || !reference.output.empty() ||
      !is_name(reference.node))
    return broken(written.place(), "found " + found(written) + ", expected \"@input\" or \"@input[id]\"");
  Scope& scope = scopes_[index];
  const auto known = scope.inputs.find(reference.node);
  if (known == scope.inputs.end()) {
    if (!scope.usable) return {};
    std::vector<std::string> names;
    for (const auto& entry : scope.inputs) names.push_back(entry.first);
    return broken(written.place(),
                  "the graph has no input '" + reference.node + "'" + did_you_mean_of(reference.node, names));
  }
  Scope::Input& input = known->second;
  if (input.given == nullptr) return {};
  if (input.state == Scope::State::under_way) return broken(input.given->place(), "the reference leads back to itself");
  if (input.state == Scope::State::open) {
    input.state = Scope::State::under_way;
    input.link = link(scope.parent, *input.given);
    input.state = Scope::State::done;
    if (input.link.kind != Link::Kind::broken) {
      input_checks_.push_back({reference.node, input.type, input.depth, input.link});
      input.link.input_check = static_cast<int>(input_checks_.size()) - 1;
    }
  }
  Link result = input.link;
  append(result.element, reference.element);
  return result;
}

Link Builder::link_text(int index, const JsonValue& written) {
  const std::string& text = written.text;
  if (text.starts_with('@')) return link_input(index, written);
  if (text.find("${") != std::string::npos) return link_param(index, written);
  Reference reference;
  std::string error;
  const bool readable = parse_reference(text, reference, error);
  const bool ids_wrong = !readable && text.find('[') != std::string::npos;
  if (!readable && !ids_wrong && looks_like_a_path(text))
    return broken(written.place(), "found " + found(written) + how_files_come_in);
  if (!readable) return broken(written.place(), error);

  const Scope& scope = scopes_[index];
  const auto known = scope.entries.find(reference.node);
  if (known == scope.entries.end()) {
    if (!scope.usable && scope.entries.empty()) return {};
    const std::string node = reference.node.substr(0, reference.node.find('/'));
    const auto outer = scope.entries.find(node);
    if (node != reference.node && outer != scope.entries.end() && outer->second.subgraph)
      return broken(written.place(), "'" + reference.node + "' is inside the subgraph '" + node +
                                         "': only its outputs can be read, as \"" + node + ".output\"");
    const std::string hint = did_you_mean(reference.node, scope.entry_names);
    if (hint.empty() && looks_like_a_path(text))
      return broken(written.place(),
                    "found " + found(written) + ", but there is no node '" + reference.node + "'" + how_files_come_in);
    if (scope.inputs.count(reference.node) != 0)
      return broken(written.place(), "the graph has no node '" + reference.node +
                                         "'; its input of that name is written \"@" + reference.node + "\"");
    if (scope.params.count(reference.node) != 0)
      return broken(written.place(), "the graph has no node '" + reference.node +
                                         "'; its parameter of that name is written \"${" + reference.node + "}\"");
    return broken(written.place(), "the graph has no node '" + reference.node + "'" + hint);
  }

  std::vector<std::string> names;
  if (known->second.subgraph) {
    const int inner = known->second.index;
    if (!scopes_[inner].usable) return {};
    for (const auto& entry : scopes_[inner].outputs)
      if (is_name(entry.first)) names.push_back(entry.first);
  } else if (const NodeInfo* const info = nodes_[known->second.index].info; info != nullptr) {
    for (const OutputInfo& output : info->outputs) names.push_back(output.name);
  } else {
    return {};
  }
  auto chosen = names.begin();
  if (!reference.output.empty()) {
    chosen = std::find(names.begin(), names.end(), reference.output);
    if (chosen == names.end()) {
      return broken(written.place(), "'" + reference.node + "' has no output '" + reference.output + "'" +
                                         did_you_mean_of(reference.output, names));
    }
  } else if (names.size() != 1) {
    if (names.empty()) return broken(written.place(), "'" + reference.node + "' has no output");
    return broken(written.place(), "'" + reference.node + "' has the outputs " + listed(names) + ": write \"" +
                                       reference.node + "." + names[0] + "\"");
  }
  if (known->second.subgraph) {
    Link result = link_output(known->second.index, *chosen);
    append(result.element, reference.element);
    return result;
  }
  Link result;
  result.kind = Link::Kind::node;
  result.node = known->second.index;
  result.output = static_cast<int>(chosen - names.begin());
  result.element = reference.element;
  return result;
}

}  // namespace engine
