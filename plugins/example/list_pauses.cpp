// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "engine/node.h"
#include "nodes/types/phones.h"

namespace example {

struct ListPausesOptions {
  double shortest_s = 0.2;
};

// A table of the silences that last at least shortest_s.
engine::File list_pauses(const face::Phones& phones, const ListPausesOptions& options) {
  std::string table = "start_s,end_s\n";
  for (const face::Phone& phone : phones.phones)
    if (phone.label == "SIL" && phone.end_s - phone.start_s >= options.shortest_s)
      table += std::to_string(phone.start_s) + "," + std::to_string(phone.end_s) + "\n";
  return engine::File::from_bytes(table, ".csv");
}

}  // namespace example

using namespace engine::declare;
NODE("example.list_pauses", &example::list_pauses, version{1},
     doc{"Lists the pauses of a recording as a table: start_s,end_s."},
     input{"phones", "When each phone is spoken"},
     param("shortest_s", &example::ListPausesOptions::shortest_s, range{0, 60}, unit{"s"}, "Shortest pause in the table"),
     output("table", "One line per pause"));
