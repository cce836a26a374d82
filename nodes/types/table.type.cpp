// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/table.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(Table, "table", codec_version{1}, doc{"A small table of numbers."}, field<&Table::columns>(),
     field<&Table::rows>(field<&TableRow::name>(), field<&TableRow::values>()), view{"csv", "export.table"},
     difference{"evaluate.table_difference"});
