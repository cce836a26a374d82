// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/declare/words.h"
#include "engine/value/codec.h"

namespace engine::declare {

struct codec_version {
  int number;
};
// A node that shows a value as a file with this suffix.
struct view {
  const char* suffix;
  const char* node;
};
// A node that compares two values.
struct difference {
  const char* node;
};

// A member of the type: field<&Mesh::points>(). The fields of a member that is a struct (or a list of structs) go
// inside.
template <auto Member, class... Fields>
constexpr codec::Field<Member, Fields...> field(Fields...) {
  return {};
}

namespace detail {

inline void add(TypeInfo& info, const codec_version& version) { info.codec_version = version.number; }
inline void add(TypeInfo& info, const doc& text) { info.doc = text.text; }
inline void add(TypeInfo& info, const view& v) { info.views.push_back({v.suffix, v.node}); }
inline void add(TypeInfo& info, const difference& d) { info.difference = d.node; }
template <auto Member, class... Fields>
void add(TypeInfo&, const codec::Field<Member, Fields...>&) {}

template <class... Fields>
struct field_list {};
template <class List, class... Declarations>
struct fields_of {
  using type = List;
};
template <class... Found, class D, class... Rest>
struct fields_of<field_list<Found...>, D, Rest...> : fields_of<field_list<Found...>, Rest...> {};
template <class... Found, auto Member, class... Fields, class... Rest>
struct fields_of<field_list<Found...>, codec::Field<Member, Fields...>, Rest...>
    : fields_of<field_list<Found..., codec::Field<Member, Fields...>>, Rest...> {};

template <class T, class... Fields>
void derive(TypeInfo& info, field_list<Fields...>) {
  codec::derive<T, Fields...>(info);
}

}  // namespace detail

template <class T, class... Declarations>
TypeInfo type(const char* name, const Declarations&... declarations) {
  TypeInfo info;
  info.name = name;
  (detail::add(info, declarations), ...);
  detail::derive<T>(info, typename detail::fields_of<detail::field_list<>, Declarations...>::type{});
  return info;
}

}  // namespace engine::declare
