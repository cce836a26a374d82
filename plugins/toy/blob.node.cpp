// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/trials.h"
using namespace engine::declare;

NODE("toy.blob", &toy::blob, version{1}, doc{"Makes a large value."}, input{"number", "A number"},
     param("size_mb", &toy::BlobOptions::size_mb, range{0, 1000}, unit{"MB"}, "How large"),
     output("blob", "A large text"));
