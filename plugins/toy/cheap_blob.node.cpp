// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/trials.h"
using namespace engine::declare;

NODE("toy.cheap_blob", &toy::blob, version{1}, cheap{}, doc{"Makes a large value that is not stored."},
     input{"number", "A number"}, param("size_mb", &toy::BlobOptions::size_mb, range{0, 1000}, unit{"MB"}, "How large"),
     output("blob", "A large text"));
