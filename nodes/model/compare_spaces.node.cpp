// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/compare_spaces.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.compare_spaces", &compare_spaces, version{1},
     doc{"Angle between a model's expressions and identities, and what share of the expressions identities do not "
         "explain; with half of the identities against the other half as a control."},
     input{"model", "The morphable model"},
     output("table", "Rows: expression, control; columns: largest and smallest angle, residual ratio"));
