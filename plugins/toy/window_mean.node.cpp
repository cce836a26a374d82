// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/numbers.h"
using namespace engine::declare;

NODE("toy.window_mean", &toy::window_mean, version{1}, doc{"Smooths a sequence of numbers."},
     input{"values", "Numbers", window{2, 2}}, output("mean", "Mean of the number and its neighbours"));
