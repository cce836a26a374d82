// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/trials.h"
using namespace engine::declare;

NODE("toy.blob_size", &toy::blob_size, version{1}, doc{"Measures a large value, slowly."},
     input{"blob", "A large text"},
     param("seconds", &toy::BlobSizeOptions::seconds, range{0, 60}, unit{"s"}, "How long it takes",
           inert{"it only takes time"}),
     output("size", "Its bytes"));
