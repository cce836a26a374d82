// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/node_samples.h"

#include <stdexcept>

#include "tests/conformance/samples/area_samples.h"
#include "tests/support/samples.h"

namespace conformance {
namespace {

AreaSamples& areas() {
  static AreaSamples all;
  return all;
}

template <class Map>
void add(Map& all, const Map& of_area) {
  for (const auto& [name, value] : of_area)
    if (!all.emplace(name, value).second) throw std::logic_error("samples: " + name + " is there twice");
}

AnyValue sample_of(engine::Plugins& plugins, const std::string& port, const std::string& type, int variant) {
  if (const auto own = areas().inputs.find(port); own != areas().inputs.end())
    return checked_sample(own->second(plugins, variant), port, type);
  if (const auto made = areas().types.find(type); made != areas().types.end())
    return checked_sample(made->second(plugins, variant), port, type);
  return test::sample(type, variant);
}

}  // namespace

AnyValue checked_sample(const Sample& sample, const std::string& port, const std::string& type) {
  if (sample.value && sample.type != type)
    throw std::logic_error("the sample of " + port + " is " + sample.type + ", expected " + type);
  return sample.value;
}

Registered::Registered(AreaSamples area) {
  AreaSamples& all = areas();
  add(all.inputs, area.inputs);
  add(all.types, area.types);
  add(all.lengths, area.lengths);
  add(all.sequences, area.sequences);
  add(all.before, area.before);
  add(all.params, area.params);
  add(all.values, area.values);
  add(all.settings, area.settings);
  add(all.shown_elsewhere, area.shown_elsewhere);
  add(all.only_refuses, area.only_refuses);
  add(all.sins, area.sins);
}

const AreaSamples& all_samples() { return areas(); }

Params sample_params(const engine::NodeInfo& info) { return with_params(info, {}); }

Params with_params(const engine::NodeInfo& info, const ParamValues& setting) {
  Params params = defaults_of(info);
  for (std::size_t i = 0; i < params.size(); ++i) {
    if (const auto own = areas().params.find(info.name + "." + info.params[i].name); own != areas().params.end())
      params[i] = own->second;
    if (const auto set = setting.find(info.params[i].name); set != setting.end()) params[i] = set->second;
  }
  return params;
}

std::vector<engine::ParamValue> further_values(const std::string& node, const std::string& param) {
  const auto at = areas().values.find(node + "." + param);
  return at == areas().values.end() ? std::vector<engine::ParamValue>() : at->second;
}

std::vector<ParamValues> further_settings(const std::string& node) {
  const auto at = areas().settings.find(node);
  return at == areas().settings.end() ? std::vector<ParamValues>() : at->second;
}

std::optional<PortValue> port_sample(engine::Plugins& plugins, const engine::NodeDeclaration& node, std::size_t port,
                                     int variant) {
  const engine::InputInfo& info = node.info.inputs[port];
  const std::string name = node.info.name + "." + info.name;
  PortValue sample;
  if (info.depth > 1) return std::nullopt;
  if (info.depth == 0 && !info.window) {
    sample.value = sample_of(plugins, name, info.type, variant);
    if (!sample.value) return std::nullopt;
    if (const auto own = areas().before.find(name); own != areas().before.end())
      sample.before = checked_sample(own->second(plugins, variant), name, info.type);
    return sample;
  }
  if (const auto own = areas().sequences.find(name); own != areas().sequences.end()) {
    for (const Sample& element : own->second(plugins, variant))
      sample.elements.push_back(checked_sample(element, name, info.type));
  } else {
    const auto length = areas().lengths.find(name);
    const int count = length == areas().lengths.end() ? 4 : length->second;
    for (int e = 0; e < count; ++e) sample.elements.push_back(sample_of(plugins, name, info.type, variant + e));
  }
  for (const AnyValue& element : sample.elements)
    if (!element) return std::nullopt;
  if (info.window) {
    const auto most = static_cast<std::size_t>(info.before + info.after + 1);
    if (sample.elements.size() > most) sample.elements.resize(most);
  }
  return sample;
}

}  // namespace conformance
