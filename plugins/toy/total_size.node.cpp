// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/trials.h"
using namespace engine::declare;

NODE("toy.total_size", &toy::total_size, version{1}, doc{"Measures many large values."}, input{"blobs", "Large texts"},
     param("seconds", &toy::BlobSizeOptions::seconds, range{0, 60}, unit{"s"}, "How long each takes",
           inert{"it only takes time"}),
     output("size", "Their bytes"));
