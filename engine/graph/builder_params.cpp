// SPDX-License-Identifier: Apache-2.0
// Parameters of graphs and nodes.
#include <algorithm>

#include "engine/graph/builder.h"
#include "engine/graph/param_value.h"
#include "engine/graph/reference.h"

namespace engine {
namespace {

using Kind = JsonValue::Kind;

constexpr double no_bound = 9007199254740991.0;

const std::vector<std::string>& type_names() {
  static const std::vector<std::string> names = {"path", "integer", "real", "string", "boolean", "choice"};
  return names;
}

std::string type_name(const BoundParam& param) {
  if (param.path) return "path";
  const std::string list = param.type.list ? "list of " : "";
  switch (param.type.kind) {
    case ParamKind::boolean:
      return list + "boolean";
    case ParamKind::integer:
      return list + "integer";
    case ParamKind::real:
      return list + "real";
    case ParamKind::string:
      return list + "string";
    case ParamKind::choice:
      return list + "choice";
  }
  return {};
}

// Whether every value of one kind can be a value of the other, ranges and choices aside.
bool agrees(const ParamInfo& from, const ParamInfo& to) {
  if (from.list != to.list) return false;
  const auto texts = [](ParamKind kind) { return kind == ParamKind::string || kind == ParamKind::choice; };
  return from.kind == to.kind || (from.kind == ParamKind::integer && to.kind == ParamKind::real) ||
         (texts(from.kind) && texts(to.kind));
}

}  // namespace

bool is_substitution(const std::string& text, std::string& name) {
  if (!text.starts_with("${") || !text.ends_with("}")) return false;
  name = text.substr(2, text.size() - 3);
  return is_name(name);
}

std::optional<BoundParam> Builder::declare_param(const JsonMember& member) {
  BoundParam bound;
  bound.type.name = member.key;
  bound.type.low = -no_bound;
  bound.type.high = no_bound;
  const std::size_t before = problems_.size();
  if (!is_name(member.key))
    problem(member.place(),
            quoted_text(member.key) +
                " is no name of a parameter: names are made of letters, digits and '_', and start with no digit");
  if (!check_object(member.value, {"type", "default", "optional", "choices", "list", "doc"}, "a parameter")) return {};
  const JsonMember* const type = member.value.find("type");
  if (type == nullptr) {
    if (problems_.size() == before)
      problem(member.place(), "the key \"type\" is missing: one of " + listed(type_names(), "or"));
    return {};
  }
  const auto& names = type_names();
  const auto known =
      type->value.is(Kind::string) ? std::find(names.begin(), names.end(), type->value.text) : names.end();
  if (known == names.end()) {
    problem(type->value.place(), "found " + found(type->value) + ", expected one of " + listed(names, "or") +
                                     did_you_mean(type->value.text, names));
    return {};
  }
  bound.path = *known == "path";
  bound.type.kind = *known == "integer"   ? ParamKind::integer
                    : *known == "real"    ? ParamKind::real
                    : *known == "boolean" ? ParamKind::boolean
                    : *known == "choice"  ? ParamKind::choice
                                          : ParamKind::string;
  const auto flag = [&](const char* key, bool& value) {
    const JsonMember* const given = member.value.find(key);
    if (given == nullptr) return;
    if (!given->value.is(Kind::boolean))
      problem(given->value.place(), "found " + found(given->value) + ", expected true or false");
    value = given->value.boolean;
  };
  flag("optional", bound.optional);
  flag("list", bound.type.list);
  if (bound.type.list && bound.path)
    problem(member.value.find("list")->place(), "a path cannot be a list: give a folder to the node files.list");
  if (const JsonMember* const doc = member.value.find("doc")) {
    if (!doc->value.is(Kind::string)) problem(doc->value.place(), "found " + found(doc->value) + ", expected a text");
    bound.type.doc = doc->value.text;
  }
  const JsonMember* const choices = member.value.find("choices");
  if (bound.type.kind == ParamKind::choice) {
    if (choices == nullptr) problem(member.place(), "the key \"choices\" is missing: a list of strings");
  } else if (choices != nullptr) {
    problem(choices->place(),
            "only a parameter of type \"choice\" has choices; this one is of type " + quoted_text(*known));
  }
  if (choices != nullptr && bound.type.kind == ParamKind::choice) {
    const bool usable = choices->value.is(Kind::array) && !choices->value.items.empty() &&
                        std::all_of(choices->value.items.begin(), choices->value.items.end(),
                                    [](const JsonValue& item) { return item.is(Kind::string); });
    if (!usable) problem(choices->value.place(), "found " + found(choices->value) + ", expected a list of strings");
    if (usable)
      for (const JsonValue& item : choices->value.items) bound.type.choices.push_back(item.text);
  }
  if (problems_.size() != before) return {};
  return bound;
}

void Builder::read_params(int index, const JsonMember* embedding) {
  Scope& scope = scopes_[index];
  const JsonMember* const given = embedding != nullptr ? embedding->value.find("params") : nullptr;
  const bool given_usable = given == nullptr || given->value.is(Kind::object);
  if (!given_usable)
    problem(given->value.place(), "found " + found(given->value) + ", expected an object of parameters");
  if (const JsonMember* const params = scope.file->tree.find("params")) {
    if (!params->value.is(Kind::object)) {
      problem(params->value.place(),
              "found " + found(params->value) + ", expected an object of parameters: {\"name\": {\"type\": ...}}");
      scope.usable = false;
      return;
    }
    for (const JsonMember& member : params->value.members) {
      std::optional<BoundParam> declared = declare_param(member);
      const bool sound = declared.has_value();
      BoundParam& bound = scope.params[member.key] = sound ? std::move(*declared) : BoundParam{};
      bound.setting =
          scope.prefix.empty() ? member.key : scope.prefix.substr(0, scope.prefix.size() - 1) + "." + member.key;
      bound.broken = !sound || !given_usable;
      if (!bound.broken)
        bind_param(index, bound, member, embedding);
      else if (Given* const setting = find_setting(
                   scope.prefix.empty() ? "" : scope.prefix.substr(0, scope.prefix.size() - 1), member.key))
        setting->used = true;
    }
  }
  if (given == nullptr || !given_usable) return;
  for (const JsonMember& member : given->value.members)
    if (scope.params.count(member.key) == 0)
      problem(member.place(), scope.file->source.shown + " has no parameter " + quoted_text(member.key) +
                                  did_you_mean_of(member.key, keys_of(scope.params)));
}

// The value of a graph's parameter: what is set, else what the embedding node gives, else the default.
void Builder::bind_param(int index, BoundParam& bound, const JsonMember& declared, const JsonMember* embedding) {
  const Scope& scope = scopes_[index];
  const auto check = [&](const JsonValue& value) {
    std::string error;
    if (value.line > 0 && value.is(Kind::string) && value.text.find("${") != std::string::npos)
      error = "found " + found(value) + ": nothing is put in place of \"${name}\" here";
    else if (bound.path && (!value.is(Kind::string) || value.text.empty()))
      error = "found " + found(value) + ", expected a path";
    else
      read_param(value, bound.type, error);
    if (error.empty()) return true;
    problem(value.place(), error);
    bound.broken = true;
    return false;
  };
  if (const JsonMember* const initial = declared.value.find("default"); initial != nullptr && check(initial->value))
    bound.value = &initial->value;

  const JsonMember* const params = embedding != nullptr ? embedding->value.find("params") : nullptr;
  const JsonMember* const given = params != nullptr ? params->value.find(declared.key) : nullptr;
  if (given != nullptr) {
    std::string name;
    if (given->value.is(Kind::string) && given->value.text.find("${") != std::string::npos) {
      const BoundParam* const outer = find_param(scope.parent, given->value);
      if (outer == nullptr || outer->broken) {
        bound.broken = true;
      } else if (outer->path != bound.path || !agrees(outer->type, bound.type)) {
        problem(given->value.place(), "'" + outer->type.name + "' is a parameter of type " + type_name(*outer) +
                                          ", expected " + type_name(bound));
        bound.broken = true;
      } else if (outer->value != nullptr) {
        if (std::string error; !bound.path && !read_param(*outer->value, bound.type, error)) {
          if (blamed_.insert(outer->value).second)
            problem(outer->value->place(), error + " (it goes to '" + bound.setting + "')");
          bound.broken = true;
        }
        bound.value = outer->value;
      } else if (bound.value == nullptr) {
        if (!bound.path && !bound.optional) {
          problem(given->value.place(), "'" + outer->type.name + "' is optional and unset, but '" + declared.key +
                                            "' of " + scope.file->source.shown + " needs a value");
          bound.broken = true;
        }
        bound.optional = true;
        bound.setting = outer->setting;
      }
    } else if (check(given->value)) {
      bound.value = &given->value;
    }
  }

  const std::string node = scope.prefix.empty() ? "" : scope.prefix.substr(0, scope.prefix.size() - 1);
  if (Given* const setting = find_setting(node, declared.key)) {
    setting->used = true;
    typed_.push_back(value_of_text(setting->value, bound.type, command_line_, setting->pointer));
    if (check(typed_.back())) bound.value = &typed_.back();
  }
  if (bound.value != nullptr || bound.optional || bound.broken) return;
  bound.broken = true;
  if (embedding != nullptr)
    problem(embedding->place(),
            "the parameter '" + declared.key + "' of " + scope.file->source.shown + " needs a value");
  else
    problem(declared.place(), "the parameter '" + declared.key + "' needs a value: --set " + declared.key + "=" +
                                  (bound.path ? "PATH" : "VALUE"));
}

// The graph's parameter that a "${x}" names; null for what names none, which is reported.
const BoundParam* Builder::find_param(int index, const JsonValue& written) {
  std::string name;
  if (!is_substitution(written.text, name)) {
    problem(written.place(), "found " + found(written) + ": \"${name}\" stands only as a whole value");
    return nullptr;
  }
  const auto known = scopes_[index].params.find(name);
  if (known != scopes_[index].params.end()) return &known->second;
  if (const JsonMember* const params = scopes_[index].file->tree.find("params");
      params == nullptr || params->value.is(Kind::object))
    problem(written.place(),
            "the graph has no parameter '" + name + "'" + did_you_mean_of(name, keys_of(scopes_[index].params)));
  return nullptr;
}

// A node's parameter as written, "${x}" included. False when there is none to take: it is wrong, which is reported, or
// it is bound to an optional parameter that is unset.
bool Builder::read_value(int index, const JsonValue& written, const ParamInfo& param, ParamValue& value) {
  std::string error;
  const JsonValue* read = &written;
  for (const JsonValue& item : written.items)
    if (item.is(Kind::string) && item.text.find("${") != std::string::npos) {
      problem(item.place(), "found " + found(item) + ": \"${name}\" stands only as a whole value, not inside a list");
      return false;
    }
  if (written.is(Kind::string) && written.text.find("${") != std::string::npos) {
    const BoundParam* const bound = find_param(index, written);
    if (bound == nullptr || bound->broken) return false;
    if (bound->path) {
      problem(written.place(),
              "'" + bound->type.name + "' is a path: a node takes a file as an input, never as a parameter");
      return false;
    }
    if (!agrees(bound->type, param)) {
      problem(written.place(), "'" + bound->type.name + "' is a parameter of type " + type_name(*bound) +
                                   ", expected " + expected_value(param));
      return false;
    }
    if (bound->value == nullptr) return false;
    read = bound->value;
  }
  std::optional<ParamValue> taken = read_param(*read, param, error);
  if (taken) {
    value = std::move(*taken);
    return true;
  }
  if (read == &written)
    problem(written.place(), error);
  else if (blamed_.insert(read).second)
    problem(read->place(), error + " (used at " + written.pointer + ")");
  return false;
}

void Builder::read_node_params(int index, const JsonMember& member, FlatNode& node, bool swapped) {
  std::vector<std::string> names;
  for (const ParamInfo& param : node.info->params) {
    names.push_back(param.name);
    node.params.push_back(param.initial);
  }
  const JsonMember* const params = member.value.find("params");
  if (params != nullptr && !params->value.is(Kind::object)) {
    problem(params->value.place(), "found " + found(params->value) + ", expected an object of parameters");
  } else if (params != nullptr) {
    for (const JsonMember& given : params->value.members) {
      const int param = node.info->find_param(given.key);
      if (param >= 0)
        read_value(index, given.value, node.info->params[param], node.params[param]);
      else if (swapped && node.info->find_input(given.key) < 0)
        notes_.push_back(node.id + ": " + node.info->name + " has no parameter '" + given.key + "'; that of the graph is left out");
      else if (node.info->find_input(given.key) >= 0)
        problem(given.place(), "'" + node.info->name + "' has no parameter " + quoted_text(given.key) +
                                   "; it is one of its \"inputs\"");
      else
        problem(given.place(), "'" + node.info->name + "' has no parameter " + quoted_text(given.key) +
                                   did_you_mean_of(given.key, names));
    }
  }
  const auto settings = settings_.find(node.id);
  if (settings == settings_.end()) return;
  for (Given& setting : settings->second) {
    const int param = node.info->find_param(setting.name);
    if (param < 0) continue;  // reported with the unused ones
    setting.used = true;
    const JsonValue value = value_of_text(setting.value, node.info->params[param], command_line_, setting.pointer);
    std::string error;
    if (std::optional<ParamValue> taken = read_param(value, node.info->params[param], error))
      node.params[param] = std::move(*taken);
    else
      problem(value.place(), error);
  }
}

}  // namespace engine
