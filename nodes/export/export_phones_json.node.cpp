// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_phones_json.h"

#include "engine/node.h"
#include "nodes/types/phones.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.phones_json", &export_phones_json, version{1}, doc{"Writes an alignment as JSON, one phone per line."},
     input{"phones", "The alignment"}, output("file", "The .json file"));
