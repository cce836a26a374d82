// SPDX-License-Identifier: Apache-2.0
// What a node file (NAME.node.cpp) or a type file (NAME.type.cpp) includes: NODE(...) and TYPE(...). Standard library
// only.
#pragma once
#include "engine/declare/node.h"
#include "engine/declare/type.h"

// Binds a pure function to the engine. One per file. Leaves nothing but a constant pointer in a linker section: loading
// a plugin runs no code of ours.
#define NODE(...)                                                                                       \
  namespace {                                                                                           \
  ::engine::NodeDeclaration engine_declare_this_node() { return ::engine::declare::node(__VA_ARGS__); } \
  [[gnu::used, gnu::section("facegraph_nodes")]] constinit const ::engine::NodeEntry engine_this_node = \
      &engine_declare_this_node;                                                                        \
  }                                                                                                     \
  static_assert(true, "NODE(...) ends with a semicolon")

// Makes a struct a value type.
#define TYPE(T, ...)                                                                        \
  template <>                                                                               \
  __attribute__((visibility("default"))) const ::engine::TypeInfo& ::engine::type_of<T>() { \
    static const ::engine::TypeInfo info = ::engine::declare::type<T>(__VA_ARGS__);         \
    return info;                                                                            \
  }                                                                                         \
  static_assert(true, "TYPE(...) ends with a semicolon")
