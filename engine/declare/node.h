// SPDX-License-Identifier: Apache-2.0
// Turns a function and its declaration into a NodeDeclaration.
#pragma once
#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "engine/declare/signature.h"
#include "engine/declare/words.h"

namespace engine {
using NodeEntry = NodeDeclaration (*)();
}

namespace engine::declare {
namespace detail {

struct no_options {};

template <class D>
struct declared {
  static constexpr bool param = false, member_output = false, whole = false, input_word = false, doc_word = false;
  using owner = no_options;
};
template <class S, class T>
struct declared<param_t<S, T>> : declared<void> {
  static constexpr bool param = true;
  using owner = S;
};
template <class S, class T>
struct declared<output_t<S, T>> : declared<void> {
  static constexpr bool member_output = true;
  using owner = S;
};
template <>
struct declared<whole_output> : declared<void> {
  static constexpr bool whole = true;
};
template <>
struct declared<input> : declared<void> {
  static constexpr bool input_word = true;
};
template <>
struct declared<doc> : declared<void> {
  static constexpr bool doc_word = true;
};

template <class... D>
struct options_of {
  using type = no_options;
};
template <class D, class... Rest>
struct options_of<D, Rest...> {
  using type = std::conditional_t<declared<D>::param, typename declared<D>::owner, typename options_of<Rest...>::type>;
};

// --- parameters
// -------------------------------------------------------------------------------------------------------

template <class E>
constexpr ParamKind param_kind() {
  if constexpr (std::is_same_v<E, bool>)
    return ParamKind::boolean;
  else if constexpr (std::is_enum_v<E>)
    return ParamKind::choice;
  else if constexpr (std::is_integral_v<E>)
    return ParamKind::integer;
  else if constexpr (std::is_floating_point_v<E>)
    return ParamKind::real;
  else
    return ParamKind::string;
}

// The type that carries an element of a parameter in a ParamValue.
template <class E>
using carried = std::conditional_t<std::is_same_v<E, bool>, bool,
                                   std::conditional_t<std::is_enum_v<E> || std::is_same_v<E, std::string>, std::string,
                                                      std::conditional_t<std::is_integral_v<E>, std::int64_t, double>>>;

template <class E>
carried<E> carry(const E& value, const std::vector<choice<E>>& choices) {
  if constexpr (std::is_enum_v<E>) {
    for (const choice<E>& c : choices)
      if (c.value == value) return c.name;
    return {};
  } else {
    return static_cast<carried<E>>(value);
  }
}

template <class E>
E uncarry(const carried<E>& value, const std::vector<choice<E>>& choices) {
  if constexpr (std::is_enum_v<E>) {
    for (const choice<E>& c : choices)
      if (value == c.name) return c.value;
    throw std::logic_error("no such choice: " + value);
  } else {
    return static_cast<E>(value);
  }
}

template <class S, class T>
ParamInfo describe_param(const param_t<S, T>& declared_param) {
  using E = typename element_of<T>::type;
  ParamInfo info;
  info.name = declared_param.name;
  info.doc = declared_param.text;
  info.kind = param_kind<E>();
  info.list = element_of<T>::list;
  info.unit = declared_param.unit;
  info.low = declared_param.low;
  info.high = declared_param.high;
  info.inert = declared_param.inert;
  for (const auto& c : declared_param.choices) info.choices.push_back(c.name);
  const T initial = S{}.*(declared_param.member);
  if constexpr (element_of<T>::list) {
    std::vector<carried<E>> list;
    for (const E& element : initial) list.push_back(carry<E>(element, declared_param.choices));
    info.initial = list;
  } else {
    info.initial = carry<E>(initial, declared_param.choices);
  }
  return info;
}

template <class S, class T>
void set_param(S& options, const param_t<S, T>& declared_param, const ParamValue& value) {
  using E = typename element_of<T>::type;
  if constexpr (element_of<T>::list) {
    T list;
    for (const auto& element : std::get<std::vector<carried<E>>>(value))
      list.push_back(uncarry<E>(element, declared_param.choices));
    options.*(declared_param.member) = std::move(list);
  } else {
    options.*(declared_param.member) = uncarry<E>(std::get<carried<E>>(value), declared_param.choices);
  }
}

// --- outputs
// ----------------------------------------------------------------------------------------------------------

template <class T>
void add_output(NodeDeclaration& node, const char* name, const char* text, bool streamed) {
  OutputInfo info;
  info.name = name;
  info.doc = text;
  const TypeInfo& type = type_of<typename nested<T>::type>();
  info.type = type.name;
  info.depth = nested<T>::depth + (streamed ? 1 : 0);
  static_assert(nested<T>::depth <= 1, "a node adds at most one level of Seq");
  node.info.outputs.push_back(std::move(info));
  node.output_types.push_back(&type);
}

// Hands a result over: a value, or a sequence element by element.
template <class T>
void give(Call& call, std::size_t output, T& value) {
  if constexpr (nested<T>::depth == 1) {
    // Copies: an element that stays in memory must not hold the whole sequence.
    using Element = typename nested<T>::type;
    for (std::size_t i = 0; i < value.size(); ++i)
      call.push(output, value.id(i), std::make_shared<const Element>(*value.at(i)));
  } else {
    call.result(output, std::make_shared<const T>(std::move(value)));
  }
}

// --- words
// ------------------------------------------------------------------------------------------------------------

inline void add_word(NodeInfo& info, const doc& d) { info.doc = d.text; }
inline void add_word(NodeInfo& info, const version& v) { info.version = v.number; }
inline void add_word(NodeInfo& info, const cheap&) { info.cheap = true; }
inline void add_word(NodeInfo& info, const memory& m) { info.memory_bytes = m.bytes; }
inline void add_word(NodeInfo& info, const threads& t) { info.threads = t.count; }
template <class S, class T>
void add_word(NodeInfo& info, const param_t<S, T>& p) {
  info.params.push_back(describe_param(p));
}
inline void add_word(NodeInfo&, const input&) {}
inline void add_word(NodeInfo&, const whole_output&) {}
template <class S, class T>
void add_word(NodeInfo&, const output_t<S, T>&) {}

inline void collect_input(std::vector<input>& list, const input& i) { list.push_back(i); }
template <class D>
void collect_input(std::vector<input>&, const D&) {}
inline void collect_whole(std::vector<whole_output>& list, const whole_output& o) { list.push_back(o); }
template <class D>
void collect_whole(std::vector<whole_output>&, const D&) {}

// --- arguments
// --------------------------------------------------------------------------------------------------------

// What the engine keeps alive for one argument while the function runs.
template <class A, class Options>
struct Holder {
  using Argument = argument<A>;
  using T = typename Argument::type;
  static constexpr bool options = std::is_same_v<T, Options>;

  static auto make(Call& call, std::size_t input, std::size_t output, const Options& chosen, auto&& prior_of) {
    if constexpr (options) {
      return &chosen;
    } else if constexpr (Argument::role == Role::value || Argument::role == Role::optional) {
      return std::static_pointer_cast<const T>(call.value(input));
    } else if constexpr (Argument::role == Role::sequence) {
      return sequence_opener<T>::open(call.sequence(input));
    } else if constexpr (Argument::role == Role::optional_sequence) {
      auto access = call.sequence(input);
      return access ? std::optional<T>(sequence_opener<T>::open(access)) : std::optional<T>();
    } else if constexpr (Argument::role == Role::window) {
      Call::WindowValues values = call.window(input);
      std::vector<std::shared_ptr<const T>> typed;
      for (auto& value : values.values) typed.push_back(std::static_pointer_cast<const T>(std::move(value)));
      return Window<T>(std::move(typed), values.centre);
    } else if constexpr (Argument::role == Role::prior) {
      return Prior<T>(prior_of(call));
    } else if constexpr (Argument::role == Role::writer) {
      return SeqWriter<T>([&call, output](std::string id, T value) {
        call.push(output, std::move(id), std::make_shared<const T>(std::move(value)));
      });
    } else {
      return &call.progress();
    }
  }

  template <class Held>
  static decltype(auto) get(Held& held) {
    if constexpr (options || Argument::role == Role::value || Argument::role == Role::progress)
      return *held;
    else if constexpr (Argument::role == Role::optional)
      return held.get();
    else if constexpr (Argument::role == Role::optional_sequence)
      return held ? &*held : nullptr;
    else
      return (held);
  }
};

// --- the whole
// --------------------------------------------------------------------------------------------------------

template <class F, class... D>
struct Binding {
  using Signature = signature<F>;
  using Arguments = typename Signature::arguments;
  using Result = std::remove_cv_t<std::remove_reference_t<typename Signature::result>>;
  using Options = typename options_of<D...>::type;
  static constexpr std::size_t count = std::tuple_size_v<Arguments>;
  template <std::size_t I>
  using Arg = std::tuple_element_t<I, Arguments>;
  template <std::size_t I>
  static constexpr bool is_options = std::is_same_v<typename argument<Arg<I>>::type, Options>;
  template <std::size_t I>
  static constexpr bool is_input_argument = is_input(argument<Arg<I>>::role) && !is_options<I>;

  template <std::size_t... I>
  static constexpr std::size_t count_inputs(std::index_sequence<I...>) {
    return (std::size_t{0} + ... + std::size_t{is_input_argument<I>});
  }
  template <std::size_t... I>
  static constexpr std::size_t count_role(Role role, std::index_sequence<I...>) {
    return (std::size_t{0} + ... + std::size_t{argument<Arg<I>>::role == role && !is_options<I>});
  }
  template <std::size_t... I>
  static constexpr std::size_t count_options(std::index_sequence<I...>) {
    return (std::size_t{0} + ... + std::size_t{is_options<I>});
  }
  using Indices = std::make_index_sequence<count>;
  static constexpr std::size_t inputs = count_inputs(Indices{});
  static constexpr std::size_t writers = count_role(Role::writer, Indices{});
  static constexpr std::size_t member_outputs = (std::size_t{0} + ... + std::size_t{declared<D>::member_output});
  static constexpr std::size_t whole_outputs = (std::size_t{0} + ... + std::size_t{declared<D>::whole});
  static constexpr bool returns = !std::is_void_v<Result>;
  static constexpr bool returns_whole = returns && member_outputs == 0;

  static_assert((std::size_t{0} + ... + std::size_t{declared<D>::doc_word}) == 1, "declare doc{...} exactly once");
  static_assert((std::size_t{0} + ... + std::size_t{declared<D>::input_word}) == inputs,
                "declare one input{...} per input of the function, in the function's order");
  static_assert(member_outputs + whole_outputs > 0, "declare at least one output(...)");
  static_assert(
      whole_outputs == writers + (returns_whole ? 1 : 0),
      "declare one output(name, text) for the result (unless its members are declared) and one per SeqWriter");
  static_assert(((!declared<D>::member_output || std::is_same_v<typename declared<D>::owner, Result>)&&...),
                "output(...) members must belong to the function's return type");
  static_assert(((!declared<D>::param || std::is_same_v<typename declared<D>::owner, Options>)&&...),
                "all param(...) members must belong to one options struct");
  static_assert(std::is_same_v<Options, no_options> || count_options(Indices{}) == 1,
                "param(...) members must belong to the function's options argument");

  F function;
  std::tuple<D...> declarations;

  template <std::size_t I>
  static constexpr std::size_t input_index() {
    return []<std::size_t... J>(std::index_sequence<J...>) {
      return (std::size_t{0} + ... + std::size_t{is_input_argument<J>});
    }
    (std::make_index_sequence<I>{});
  }
  // Outputs in the order of the node: members and the whole result first, then writers.
  template <std::size_t I>
  static constexpr std::size_t output_index() {
    return member_outputs + (returns_whole ? 1 : 0) + []<std::size_t... J>(std::index_sequence<J...>) {
      return (std::size_t{0} + ... + std::size_t{argument<Arg<J>>::role == Role::writer});
    }
    (std::make_index_sequence<I>{});
  }

  // The result struct, put together again from stored outputs.
  template <class R>
  std::shared_ptr<const R> prior_of(Call& call) const {
    static_assert(std::is_same_v<R, Result>, "Prior<...> holds the function's own result type");
    std::vector<std::shared_ptr<const void>> values = call.prior();
    if (values.empty()) return nullptr;
    auto result = std::make_shared<R>();
    std::size_t output = 0;
    std::apply([&](const auto&... d) { (restore(*result, d, values, output), ...); }, declarations);
    return result;
  }
  template <class R, class S, class T>
  static void restore(R& result, const output_t<S, T>& o, const std::vector<std::shared_ptr<const void>>& values,
                      std::size_t& output) {
    static_assert(nested<T>::depth == 0, "a node with a Prior returns no sequences");
    result.*(o.member) = *static_cast<const T*>(values[output++].get());
  }
  template <class R, class Word>
  static void restore(R& result, const Word&, const std::vector<std::shared_ptr<const void>>& values,
                      std::size_t& output) {
    if constexpr (std::is_same_v<Word, whole_output>) result = *static_cast<const R*>(values[output++].get());
  }

  template <class S, class T>
  static void give_member(Call& call, S& result, const output_t<S, T>& o, std::size_t& output) {
    give(call, output++, result.*(o.member));
  }
  template <class S, class Word>
  static void give_member(Call&, S&, const Word&, std::size_t&) {}

  template <class S, class T>
  static void choose(S& options, const param_t<S, T>& p, Call& call, std::size_t& index) {
    set_param(options, p, call.param(index++));
  }
  template <class S, class Word>
  static void choose(S&, const Word&, Call&, std::size_t&) {}

  void operator()(Call& call) const { run(call, Indices{}); }

  template <std::size_t... I>
  void run(Call& call, std::index_sequence<I...>) const {
    Options options{};
    std::size_t index = 0;
    std::apply([&](const auto&... d) { (choose(options, d, call, index), ...); }, declarations);
    auto held = std::make_tuple(
        Holder<Arg<I>, Options>::make(call, input_index<I>(), output_index<I>(), options, [this](Call& c) {
          if constexpr (argument<Arg<I>>::role == Role::prior)
            return prior_of<typename argument<Arg<I>>::type>(c);
          else
            return std::shared_ptr<const void>();
        })...);
    if constexpr (!returns) {
      function(Holder<Arg<I>, Options>::get(std::get<I>(held))...);
    } else {
      Result result = function(Holder<Arg<I>, Options>::get(std::get<I>(held))...);
      if constexpr (returns_whole) {
        give(call, 0, result);
      } else {
        std::size_t output = 0;
        std::apply([&](const auto&... d) { (give_member(call, result, d, output), ...); }, declarations);
      }
    }
  }

  template <std::size_t I>
  static void describe_argument(NodeDeclaration& node, const std::vector<input>& words,
                                const std::vector<whole_output>& wholes, std::size_t& next_whole) {
    using A = argument<Arg<I>>;
    using T = typename A::type;
    if constexpr (is_options<I>) {
    } else if constexpr (A::role == Role::writer) {
      add_output<T>(node, wholes[next_whole].name, wholes[next_whole].text, true);
      ++next_whole;
    } else if constexpr (A::role == Role::prior) {
      node.info.prior = true;
    } else if constexpr (A::role != Role::progress) {
      const input& word = words[input_index<I>()];
      InputInfo info;
      info.name = word.name;
      info.doc = word.text;
      const TypeInfo& type = type_of<typename nested<T>::type>();
      info.type = type.name;
      info.depth = nested<T>::depth;
      info.optional = A::role == Role::optional || A::role == Role::optional_sequence;
      info.window = A::role == Role::window;
      info.before = word.neighbours.before;
      info.after = word.neighbours.after;
      node.info.inputs.push_back(std::move(info));
      node.input_types.push_back(&type);
    }
  }

  template <std::size_t... I>
  void describe(NodeDeclaration& node, std::index_sequence<I...>) const {
    std::vector<input> words;
    std::vector<whole_output> wholes;
    std::apply(
        [&](const auto&... d) {
          (add_word(node.info, d), ...);
          (collect_input(words, d), ...);
          (collect_whole(wholes, d), ...);
          (add_member_output(node, d), ...);
        },
        declarations);
    std::size_t next_whole = 0;
    if constexpr (returns_whole) {
      add_output<Result>(node, wholes[0].name, wholes[0].text, false);
      next_whole = 1;
    }
    (describe_argument<I>(node, words, wholes, next_whole), ...);
  }
  template <class S, class T>
  static void add_member_output(NodeDeclaration& node, const output_t<S, T>& o) {
    add_output<T>(node, o.name, o.text, false);
  }
  template <class Word>
  static void add_member_output(NodeDeclaration&, const Word&) {}
};

}  // namespace detail

template <class F, class... D>
NodeDeclaration node(const char* name, F function, D... declarations) {
  NodeDeclaration declaration;
  declaration.info.name = name;
  detail::Binding<F, D...> binding{function, std::make_tuple(std::move(declarations)...)};
  binding.describe(declaration, typename detail::Binding<F, D...>::Indices{});
  declaration.run = std::move(binding);
  return declaration;
}

}  // namespace engine::declare
