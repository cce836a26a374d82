// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>

#include "engine/port.h"
#include "nodes/base/check.h"
#include "nodes/types/mesh_points.h"

namespace face::model {

// Position of the element with an id; empty = the first. Throws, with `name`, where there is none.
template <class T>
std::size_t index_of(const engine::Seq<T>& all, const std::string& id, const char* name) {
  check(!all.empty(), name, " is empty, expected at least 1 element");
  for (std::size_t i = 0; i < all.size(); ++i)
    if (id.empty() || all.id(i) == id) return i;
  fail(name, " has no element \"", id, "\"; the first is \"", all.id(0), "\"");
}

struct PickShapeOptions {
  std::string id;  // empty = the first
};

// One shape of many.
MeshPoints pick_shape(const engine::Seq<MeshPoints>& shapes, const PickShapeOptions& options = {});

// The mean of many, vertex by vertex. Throws where they differ in size, or there are none.
MeshPoints mean_shape(const engine::Seq<MeshPoints>& shapes);

}  // namespace face::model
