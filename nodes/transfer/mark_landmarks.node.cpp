// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/mark_landmarks.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.mark_landmarks", &mark_landmarks, version{2},
     doc{"Finds the 68 landmarks of a head that lacks them, so that points of a video can move it."},
     input{"rig", "The head; one with landmarks stays as it is"},
     input{"reference", "A head with landmarks, such as phantom.make_head"}, output("rig", "The head with landmarks"));
