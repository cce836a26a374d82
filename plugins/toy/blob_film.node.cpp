// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/trials.h"
using namespace engine::declare;

NODE("toy.blob_film", &toy::blob_film, version{1}, cheap{},
     doc{"Makes large values one by one that are not stored, as a film has frames."},
     param("count", &toy::BlobFilmOptions::count, range{0, 1000000}, unit{"1"}, "How many"),
     param("size_mb", &toy::BlobFilmOptions::size_mb, range{0, 1000}, unit{"MB"}, "How large each is"),
     param("seconds", &toy::BlobFilmOptions::seconds, range{0, 60}, unit{"s"}, "How long each takes",
           inert{"it only takes time"}),
     output("blobs", "Large texts"));
