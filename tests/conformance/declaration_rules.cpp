// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <regex>
#include <sstream>
#include <type_traits>
#include <variant>

#include "tests/conformance/rules.h"

namespace conformance {
namespace {

using engine::NodeInfo;
using engine::ParamInfo;
using engine::ParamKind;

bool is_number(const ParamInfo& param) { return param.kind == ParamKind::integer || param.kind == ParamKind::real; }

// The numbers in a parameter's default, whether it is a list or not.
std::vector<double> numbers_of(const engine::ParamValue& value) {
  std::vector<double> numbers;
  std::visit(
      [&](const auto& held) {
        using T = std::decay_t<decltype(held)>;
        if constexpr (std::is_same_v<T, std::int64_t> || std::is_same_v<T, double>)
          numbers.push_back(static_cast<double>(held));
        else if constexpr (std::is_same_v<T, std::vector<std::int64_t>> || std::is_same_v<T, std::vector<double>>)
          for (const auto element : held) numbers.push_back(static_cast<double>(element));
      },
      value);
  return numbers;
}

std::vector<std::string> texts_of(const engine::ParamValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return {*text};
  if (const auto* list = std::get_if<std::vector<std::string>>(&value)) return *list;
  return {};
}

// Which unit a name promises by its end: radius_px -> px. Empty where none.
std::string unit_of_name(const std::string& name) {
  static const std::map<std::string, std::string> units = {
      {"px", "px"}, {"mm", "mm"},       {"cm", "cm"},     {"m", "m"},      {"s", "s"},   {"ms", "ms"},
      {"hz", "Hz"}, {"khz", "kHz"},     {"deg", "deg"},   {"rad", "rad"},  {"db", "dB"}, {"mb", "MB"},
      {"kb", "kB"}, {"bytes", "bytes"}, {"percent", "%"}, {"seconds", "s"}};
  const std::size_t per = name.find("_per_");
  if (per != std::string::npos) {
    const std::size_t before = name.rfind('_', per - 1);
    const std::string above =
        before == std::string::npos ? name.substr(0, per) : name.substr(before + 1, per - before - 1);
    return above + "/" + name.substr(per + 5);
  }
  const auto found = units.find(name.substr(name.rfind('_') + 1));
  return found == units.end() ? std::string() : found->second;
}

class Told {
 public:
  explicit Told(const NodeInfo& node) : node_(node.name) {}
  void unless(bool kept, const std::string& text) {
    if (!kept) lines_.push_back(node_ + ": " + text);
  }
  Lines lines() const { return lines_; }

 private:
  std::string node_;
  Lines lines_;
};

void look_at_texts(const NodeInfo& node, Told& told) {
  told.unless(!node.doc.empty(), "no doc");
  for (const auto& input : node.inputs) told.unless(!input.doc.empty(), "input " + input.name + ": no doc");
  for (const auto& param : node.params) told.unless(!param.doc.empty(), "parameter " + param.name + ": no doc");
  for (const auto& output : node.outputs) told.unless(!output.doc.empty(), "output " + output.name + ": no doc");
  told.unless(!node.outputs.empty(), "no output");
}

void look_at_names(const NodeInfo& node, const std::string& plugin, Told& told) {
  static const std::regex whole("[a-z][a-z0-9]*\\.[a-z][a-z0-9]*(_[a-z0-9]+)*");
  static const std::regex part("[a-z][a-z0-9]*(_[a-z0-9]+)*");
  if (!plugin.empty()) {  // else the engine's own
    told.unless(std::regex_match(node.name, whole), "its name is no area.verb_noun or area.noun");
    told.unless(node.name.starts_with(plugin + "."), "is in plugin " + plugin);
    told.unless(node.version >= 1, "version " + std::to_string(node.version) + " (expected 1 or more)");
  }
  std::map<std::string, int> inputs, outputs;
  for (const auto& input : node.inputs) ++inputs[input.name];
  for (const auto& param : node.params) ++inputs[param.name];
  for (const auto& output : node.outputs) ++outputs[output.name];
  for (const auto* names : {&inputs, &outputs})
    for (const auto& [name, count] : *names) {
      told.unless(std::regex_match(name, part), name + ": not snake_case");
      told.unless(count == 1, name + ": declared more than once");
    }
}

void look_at_unit(const ParamInfo& param, Told& told) {
  const std::string where = "parameter " + param.name;
  if (!is_number(param)) return told.unless(param.unit.empty(), where + ": is no number and has a unit");
  told.unless(!param.unit.empty(), where + ": no unit (\"1\" where dimensionless)");
  const std::string promised = unit_of_name(param.name);
  if (promised.empty()) {
    // Compound units such as 1/px^2 have no suffix.
    told.unless(param.unit == "1" || param.unit.find_first_of("/^") != std::string::npos,
                where + ": its name does not end with its unit, " + param.unit);
  } else if (promised.find('/') != std::string::npos) {
    std::string unit = param.unit;
    unit.erase(std::remove(unit.begin(), unit.end(), ' '), unit.end());
    const std::size_t slash = unit.find('/');
    told.unless(slash != std::string::npos && unit.substr(slash) == promised.substr(promised.find('/')),
                where + ": its name promises " + promised + ", its unit is " + param.unit);
  } else {
    told.unless(param.unit == promised, where + ": its name promises " + promised + ", its unit is " + param.unit);
  }
}

void look_at_default(const ParamInfo& param, Told& told) {
  const std::string where = "parameter " + param.name;
  if (is_number(param)) {
    told.unless(param.low < param.high, where + ": empty range");
    for (const double number : numbers_of(param.initial)) {
      std::ostringstream text;
      text << where << ": default " << number << " is outside [" << param.low << ", " << param.high << "]";
      told.unless(number >= param.low && number <= param.high, text.str());
    }
  }
  if (param.kind == ParamKind::choice) {
    told.unless(param.choices.size() >= 2, where + ": nothing to choose");
    for (const std::string& text : texts_of(param.initial))
      told.unless(std::find(param.choices.begin(), param.choices.end(), text) != param.choices.end(),
                  where + ": default \"" + text + "\" is none of its choices");
  }
}

}  // namespace

Lines broken_by_declaration(const NodeInfo& node, const std::string& plugin) {
  Told told(node);
  look_at_texts(node, told);
  look_at_names(node, plugin, told);
  for (const ParamInfo& param : node.params) {
    look_at_unit(param, told);
    look_at_default(param, told);
  }
  return told.lines();
}

}  // namespace conformance
