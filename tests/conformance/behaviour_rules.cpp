// SPDX-License-Identifier: Apache-2.0
#include <tbb/global_control.h>

#include <cmath>
#include <set>
#include <stdexcept>
#include <type_traits>
#include <variant>

#include "engine/port.h"
#include "tests/conformance/node_samples.h"
#include "tests/conformance/opened_files.h"
#include "tests/conformance/rules.h"

namespace conformance {
namespace {

using engine::NodeDeclaration;
using engine::NodeInfo;
using engine::ParamInfo;
using engine::ParamKind;
using engine::ParamValue;

constexpr int threads = 4;
constexpr int variants = 4;

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// Numbers of the kind that a parameter holds, near its default first: the ends of a range may ask for hours.
std::vector<double> numbers_near(const ParamInfo& param, double initial) {
  const double scale = std::max(1.0, std::abs(initial));
  std::vector<double> numbers = {initial + 1,
                                 initial - 1,
                                 1.3 * initial,
                                 0.7 * initial,
                                 initial + 0.1 * (param.high - initial),
                                 2 * initial,
                                 initial / 2,
                                 0.5 * (initial + param.low)};
  if (param.high <= 20 * scale) numbers.push_back(param.high);
  if (param.low >= -20 * scale) numbers.push_back(param.low);
  std::vector<double> fitting;
  for (double number : numbers) {
    if (param.kind == ParamKind::integer) number = std::round(number);
    if (number >= param.low && number <= param.high && number != initial && std::abs(number) <= 100 * scale)
      fitting.push_back(number);
  }
  return fitting;
}

// Other values that a parameter may have.
std::vector<ParamValue> other_values(const NodeInfo& node, const ParamInfo& param, const ParamValue& initial) {
  std::vector<ParamValue> values = further_values(node.name, param.name);
  std::visit(
      [&](const auto& held) {
        using T = std::decay_t<decltype(held)>;
        if constexpr (std::is_same_v<T, bool>) {
          values.push_back(!held);
        } else if constexpr (std::is_same_v<T, std::int64_t> || std::is_same_v<T, double>) {
          for (const double number : numbers_near(param, static_cast<double>(held)))
            values.push_back(static_cast<T>(number));
        } else if constexpr (std::is_same_v<T, std::string>) {
          if (param.kind == ParamKind::choice) {
            for (const std::string& choice : param.choices)
              if (choice != held) values.push_back(choice);
          } else {
            for (const std::string& text : {held + "b", std::string("a"), std::string()})
              if (text != held) values.push_back(text);
          }
        } else if constexpr (std::is_same_v<T, std::vector<double>> || std::is_same_v<T, std::vector<std::int64_t>>) {
          using Number = typename T::value_type;
          if (held.empty()) {
            for (const double number : {1.0, 4.0, 0.5})
              if (number >= param.low && number <= param.high) {
                values.push_back(T{static_cast<Number>(number)});
                values.push_back(T{static_cast<Number>(number), static_cast<Number>(number)});
              }
          } else {
            for (const double number : numbers_near(param, static_cast<double>(held[0]))) {
              T list = held;
              list[0] = static_cast<Number>(number);
              values.push_back(list);
            }
            values.push_back(T{});
          }
        } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
          if (!held.empty()) values.push_back(T{});
          for (const std::string& choice : param.choices) values.push_back(T{choice});
          if (param.choices.empty()) values.push_back(T{"a", "b"});
        } else if constexpr (std::is_same_v<T, std::vector<bool>>) {
          values.push_back(T{true});
          values.push_back(T{false, true});
        }
      },
      initial);
  return values;
}

class Subject {
 public:
  Subject(engine::Plugins& plugins, const std::string& node)
      : plugins_(plugins), node_(plugins.load(node)), params_(sample_params(node_.info)) {}

  // False, and a line, where there is nothing to call it with.
  bool prepare() {
    try {
      for (int v = 0; v < variants; ++v) {
        inputs_.emplace_back();
        for (std::size_t p = 0; p < node_.info.inputs.size(); ++p) {
          const auto sample = port_sample(plugins_, node_, p, v);
          const engine::InputInfo& port = node_.info.inputs[p];
          if (!sample)
            return tell("input " + port.name, "sample: type " + port.type +
                                                  " has none, or its file is not installed (tests/support/samples.cpp, "
                                                  "tests/conformance/samples)");
          inputs_.back().push_back(*sample);
        }
      }
    } catch (const std::exception& error) {
      return tell("inputs", std::string("sample: ") + first_line(error.what()));
    }
    return true;
  }

  void look() {
    const std::vector<engine::Digest> before = digests();
    look_at_files();
    if (base_.threw) {
      tell("call", "sample: refused: " + first_line(base_.what));
      return;
    }
    const std::vector<engine::Digest> after = digests();
    for (std::size_t p = 0; p < before.size(); ++p)
      if (before[p] != after[p])
        tell("input " + node_.info.inputs[p].name, "inputs unchanged: it was changed by the call");
    if (before != after) return;  // nothing else can be told
    if (!(call(inputs_[0], params_) == base_)) {
      tell("result", "same result twice: the second differs");
      return;
    }
    look_at_threads();
    for (std::size_t p = 0; p < params_.size(); ++p)
      if (node_.info.params[p].inert.empty())
        judge("parameter", node_.info.params[p].name, effect_of_param(p), "value",
              ", and it is not declared inert{\"why\"}");
    for (std::size_t p = 0; p < inputs_[0].size(); ++p)
      judge("input", node_.info.inputs[p].name, effect_of_input(p), "sample", "");
  }

  Lines lines() const { return lines_; }
  const PortValues& inputs() const { return inputs_[0]; }
  const NodeDeclaration& node() const { return node_; }
  Outcome call(const PortValues& inputs, const Params& params) const { return call_node(node_, inputs, params); }
  const Params& params() const { return params_; }

 private:
  bool tell(const std::string& where, const std::string& text) {
    lines_.push_back(node_.info.name + ": " + where + ": " + text);
    return false;
  }

  std::vector<engine::Digest> digests() const {
    std::vector<engine::Digest> all;
    for (std::size_t p = 0; p < inputs_[0].size(); ++p) {
      const engine::TypeInfo& type = *node_.input_types[p];
      std::string whole = digest_of_value(type, inputs_[0][p].value).hex();
      for (const AnyValue& element : inputs_[0][p].elements) whole += digest_of_value(type, element).hex();
      all.push_back(engine::digest_of(whole));
    }
    return all;
  }

  void look_at_threads() {
    for (const int most : {1, threads}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(most));
      if (call(inputs_[0], params_) == base_) continue;
      tell("result", "same result with 1 and " + std::to_string(threads) + " threads: with " + std::to_string(most) +
                         " it differs");
      return;
    }
  }

  // Calls it for the first time, and sees what it opens.
  void look_at_files() {
    std::set<std::string> given;
    for (std::size_t p = 0; p < inputs_[0].size(); ++p) {
      if (node_.info.inputs[p].type != "file") continue;
      std::vector<AnyValue> values = inputs_[0][p].elements;
      values.push_back(inputs_[0][p].value);
      for (const AnyValue& value : values) {
        if (!value) continue;
        const auto& file = *static_cast<const engine::File*>(value.get());
        given.insert(file.path());
        for (const auto& entry : file.entries()) given.insert(entry.path);
      }
    }
    const OpenedFiles opened;
    base_ = call(inputs_[0], params_);
    for (const std::string& path : opened.paths())
      if (!given.count(path) && path.find("/facegraph-test-") == std::string::npos)
        tell("call", "only its inputs are read: it opened " + path);
  }

  // A setting in which something is looked at: some parameters and inputs count only in one mode.
  struct Setting {
    PortValues inputs;
    Params params;
  };
  std::vector<Setting> settings(std::size_t without_param) const {
    std::vector<Setting> all = {{inputs_[0], params_}};
    PortValues bare = inputs_[0];
    bool optional = false;
    for (std::size_t p = 0; p < bare.size(); ++p)
      if (node_.info.inputs[p].optional) bare[p].absent = optional = true;
    if (optional) all.push_back({bare, params_});
    for (std::size_t p = 0; p < bare.size(); ++p) {
      if (!bare[p].absent) continue;
      all.push_back({inputs_[0], params_});
      all.back().inputs[p].absent = true;
      all.push_back({bare, params_});
      all.back().inputs[p].absent = false;
    }
    for (std::size_t p = 0; p < params_.size(); ++p) {
      const ParamKind kind = node_.info.params[p].kind;
      if (p == without_param || node_.info.params[p].list || (kind != ParamKind::boolean && kind != ParamKind::choice))
        continue;
      for (const ParamValue& other : other_values(node_.info, node_.info.params[p], params_[p])) {
        all.push_back({inputs_[0], params_});
        all.back().params[p] = other;
      }
    }
    for (const ParamValues& setting : further_settings(node_.info.name))
      all.push_back({inputs_[0], with_params(node_.info, setting)});
    return all;
  }

  // What the values tried for a parameter or an input lead to. An error alone is none: a node that refused every value
  // but one would pass, though nothing that it makes depends on it.
  enum class Effect { none, refusal, result };

  void judge(const std::string& kind, const std::string& name, Effect effect, const std::string& tried,
             const std::string& unless) {
    const AreaSamples& samples = all_samples();
    const std::string full = node_.info.name + "." + name, every = "every " + kind + " counts: ";
    const bool shown = samples.shown_elsewhere.count(full) > 0, refuses = samples.only_refuses.count(full) > 0;
    if (effect == Effect::none && !shown)
      tell(kind + " " + name, every + "no " + tried + " changes the result" + unless);
    if (effect == Effect::refusal && !shown && !refuses)
      tell(kind + " " + name, every + "some " + tried + "s are refused, none changes the result");
    if (effect == Effect::result && (shown || refuses))
      tell(kind + " " + name,
           std::string("it does count: strike it out of ") + (shown ? "shown_elsewhere" : "only_refuses"));
    if (effect == Effect::none && refuses)
      tell(kind + " " + name, every + "it is in only_refuses, and no " + tried + " is refused");
  }

  static void note(const Outcome& plain, const Outcome& changed, Effect& effect) {
    if (changed == plain) return;
    if (!plain.threw && !changed.threw)
      effect = Effect::result;
    else if (effect == Effect::none)
      effect = Effect::refusal;
  }

  Effect effect_of_param(std::size_t p) {
    const ParamInfo& info = node_.info.params[p];
    const std::string text = engine::to_text(params_[p]);
    Effect effect = Effect::none;
    for (const Setting& setting : settings(p)) {
      const Outcome plain =
          setting.params == params_ && !any_absent(setting.inputs) ? base_ : call(setting.inputs, setting.params);
      for (const ParamValue& other : other_values(node_.info, info, params_[p])) {
        if (engine::to_text(other) == text) {
          tell("parameter " + info.name, "key changes: another value has the same text, " + text);
          return Effect::result;
        }
        Params changed = setting.params;
        changed[p] = other;
        note(plain, call(setting.inputs, changed), effect);
        if (effect == Effect::result) return effect;
      }
    }
    return effect;
  }

  Effect effect_of_input(std::size_t p) {
    Effect effect = Effect::none;
    for (const Setting& setting : settings(params_.size())) {
      if (setting.inputs[p].absent) continue;
      const Outcome plain = call(setting.inputs, setting.params);
      for (int v = 1; v < variants; ++v) {
        Setting changed = setting;
        changed.inputs[p] = inputs_[static_cast<std::size_t>(v)][p];
        note(plain, call(changed.inputs, changed.params), effect);
        if (effect == Effect::result) return effect;
      }
      if (node_.info.inputs[p].optional) {
        Setting changed = setting;
        changed.inputs[p].absent = true;
        note(plain, call(changed.inputs, changed.params), effect);
        if (effect == Effect::result) return effect;
      }
    }
    return effect;
  }

  static bool any_absent(const PortValues& inputs) {
    for (const PortValue& input : inputs)
      if (input.absent) return true;
    return false;
  }

  engine::Plugins& plugins_;
  const NodeDeclaration& node_;
  const Params params_;
  std::vector<PortValues> inputs_;  // per variant
  Outcome base_;
  Lines lines_;
};

}  // namespace

Lines broken_by_behaviour(engine::Plugins& plugins, const std::string& node) {
  Subject subject(plugins, node);
  if (subject.prepare()) subject.look();
  return subject.lines();
}

}  // namespace conformance
