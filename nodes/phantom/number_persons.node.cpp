// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/number_persons.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.number_persons", &number_persons, version{1}, doc{"Numbers from 1, as ids that make many persons."},
     param("count", &NumberPersonsOptions::count, range{1, 100000}, unit{"1"}, "How many"),
     output("ids", "Texts 1, 2, ..., each under itself"));
