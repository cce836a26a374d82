// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/head_rig.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.head_rig", &head_rig, version{1},
     doc{"The mean head of a morphable model and its expressions as a rig: to show, to export, and for texture's "
         "nodes."},
     input{"model", "The model"}, output("rig", "Mean and expressions, one standard deviation each"));
