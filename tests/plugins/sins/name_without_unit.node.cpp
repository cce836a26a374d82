// SPDX-License-Identifier: Apache-2.0
#include "tests/plugins/sins/sins.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("sins.name_without_unit", &sins::name_without_unit, version{1}, doc{"Has a length without a unit in its name."},
     input{"number", "A number"},
     param("radius", &sins::NameWithoutUnitOptions::radius, range{0, 10}, unit{"mm"}, "A length"),
     output("scaled", "The number times the radius"));
