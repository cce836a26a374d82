// SPDX-License-Identifier: Apache-2.0
// The words of a declaration.
#pragma once
#include <cstdint>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <vector>

namespace engine::declare {

struct doc {
  const char* text;
};
struct version {
  int number;
};
struct unit {
  const char* text;
};
struct range {
  double low, high;
};
// How many neighbours a Window argument gets at each side.
struct window {
  int before = 0, after = 0;
};
struct input {
  const char* name;
  const char* text;
  window neighbours = {};
};
// Values of this node's outputs are neither hashed nor stored, and recomputed when somebody must read them.
struct cheap {};
// What one task needs beside its inputs and outputs.
struct memory {
  std::int64_t bytes;
};
// Threads that the function uses itself.
struct threads {
  int count;
};
// Why changing a parameter may leave every output alone.
struct inert {
  const char* reason = "";
};

template <class T>
struct element_of {
  using type = T;
  static constexpr bool list = false;
};
template <class T>
struct element_of<std::vector<T>> {
  using type = T;
  static constexpr bool list = true;
};

template <class E>
struct choice {
  const char* name;
  E value;
};

template <class S, class T>
struct param_t {
  const char* name;
  T S::*member;
  const char* text;
  const char* unit = "";
  double low = 0, high = 0;
  std::vector<choice<typename element_of<T>::type>> choices = {};
  const char* inert = "";
};

// A number or a list of numbers.
template <class S, class T>
param_t<S, T> param(const char* name, T S::*member, range limits, unit in, const char* text, inert why = {}) {
  using E = typename element_of<T>::type;
  static_assert(std::is_arithmetic_v<E> && !std::is_same_v<E, bool>, "range and unit belong to a number");
  return {name, member, text, in.text, limits.low, limits.high, {}, why.reason};
}
// An enum: the choices by name.
template <class S, class T>
param_t<S, T> param(const char* name, T S::*member, std::initializer_list<choice<typename element_of<T>::type>> choices,
                    const char* text, inert why = {}) {
  static_assert(std::is_enum_v<typename element_of<T>::type>, "a list of choices needs an enum");
  return {name, member, text, "", 0, 0, choices, why.reason};
}
// A bool or a string, or a list of them.
template <class S, class T>
param_t<S, T> param(const char* name, T S::*member, const char* text, inert why = {}) {
  using E = typename element_of<T>::type;
  static_assert(std::is_same_v<E, bool> || std::is_same_v<E, std::string>,
                "a number needs range and unit, an enum its choices");
  return {name, member, text, "", 0, 0, {}, why.reason};
}

template <class S, class T>
struct output_t {
  const char* name;
  T S::*member;
  const char* text;
};
// A member of the result struct.
template <class S, class T>
output_t<S, T> output(const char* name, T S::*member, const char* text) {
  return {name, member, text};
}
// The whole result, or (in order) a SeqWriter argument.
struct whole_output {
  const char* name;
  const char* text;
};
inline whole_output output(const char* name, const char* text) { return {name, text}; }

}  // namespace engine::declare
