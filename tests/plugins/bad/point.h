// SPDX-License-Identifier: Apache-2.0
// The type "tiny_point" of the good plugin.
#pragma once
#include "engine/node.h"

namespace tiny {

struct Point {
  double x = 0;
#ifdef TINY_POINT_IN_SPACE
  double z = 0;
#endif
};

}  // namespace tiny

template <>
inline const engine::TypeInfo& engine::type_of<tiny::Point>() {
  using namespace engine::declare;
#ifdef TINY_POINT_IN_SPACE
  static const engine::TypeInfo info = type<tiny::Point>("tiny_point", codec_version{1}, doc{"A point"},
                                                         field<&tiny::Point::x>(), field<&tiny::Point::z>());
#else
  static const engine::TypeInfo info =
      type<tiny::Point>("tiny_point", codec_version{1}, doc{"A point"}, field<&tiny::Point::x>());
#endif
  return info;
}
