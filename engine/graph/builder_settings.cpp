// SPDX-License-Identifier: Apache-2.0
// The settings of the command line.
#include "engine/graph/builder.h"

namespace engine {

void Builder::read_settings(const std::vector<Setting>& settings) {
  for (const Setting& setting : settings) {
    const std::size_t dot = setting.name.find_last_of('.');
    const bool of_node = dot != std::string::npos;
    const std::string node = of_node ? setting.name.substr(0, dot) : "";
    const std::string param = of_node ? setting.name.substr(dot + 1) : setting.name;
    Given given{param, setting.value, "--set " + setting.name};
    if (find_setting(node, param) != nullptr)
      problem({command_line_.shown, 0, 0, given.pointer}, "it is set twice");
    else
      settings_[node].push_back(std::move(given));
  }
}

Builder::Given* Builder::find_setting(const std::string& node, const std::string& param) {
  const auto known = settings_.find(node);
  if (known == settings_.end()) return nullptr;
  for (Given& given : known->second)
    if (given.name == param) return &given;
  return nullptr;
}

void Builder::report_unused_settings(FlatGraph& flat) {
  std::vector<std::string> node_ids;
  for (const FlatNode& node : nodes_) node_ids.push_back(node.id);
  for (std::size_t i = 1; i < scopes_.size(); ++i)
    node_ids.push_back(scopes_[i].prefix.substr(0, scopes_[i].prefix.size() - 1));
  for (const auto& [node, given] : settings_)
    for (const Given& setting : given) {
      if (setting.used) continue;
      const Place place{command_line_.shown, 0, 0, setting.pointer};
      if (node.empty()) {
        const std::vector<std::string> params = keys_of(scopes_[0].params);
        problem(place, "the graph has no parameter '" + setting.name + "'" + did_you_mean_of(setting.name, params));
        flat.misspelt.push_back(nearest_name(setting.name, params));
        continue;
      }
      std::vector<std::string> names;
      bool known = false, readable = true;
      for (const FlatNode& other : nodes_)
        if (other.id == node) {
          known = true;
          readable = other.info != nullptr;
          for (const ParamInfo& param : readable ? other.info->params : std::vector<ParamInfo>())
            names.push_back(param.name);
        }
      for (std::size_t i = 1; i < scopes_.size(); ++i) {
        const Scope& scope = scopes_[i];
        if (node + "/" == scope.prefix) {
          known = true;
          readable = scope.usable;
          names = keys_of(scope.params);
        } else if (!scope.usable && node.starts_with(scope.prefix)) {
          readable = false;
        }
      }
      if (!readable) continue;
      if (known)
        problem(place, "the node '" + node + "' has no parameter '" + setting.name + "'" +
                           did_you_mean_of(setting.name, names));
      else
        problem(place, "the graph has no node '" + node + "'" + did_you_mean(node, node_ids));
    }
}

}  // namespace engine
