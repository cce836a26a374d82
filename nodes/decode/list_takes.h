// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"

namespace face::decode {

struct ListTakesResult {
  std::string report;  // a line for everything that was left out or given another id
};

// The takes of a recorded stream of scans: the folders below depth/, cloud/ or pattern/, see depth_take. takes: their
// names, as the folders have them, in the order of their ids. An id is the name; letters that ids cannot have (spaces,
// umlauts) become "_", and of names that become alike the later get "_2", "_3". sound, texts: folders with a recording
// and a .txt of every take, named as it is (or with the same id: 01.wav of take 1), which come out as sounds and
// scripts; null = none. A take without its sound or text is left out, as is one whose sound or text cannot be read
// (decode.audio, decode.text), and a file that no take has; a warning names it. Throws where folder has no takes, and where no take is left.
ListTakesResult list_takes(const engine::File& folder, const engine::File* sound, const engine::File* texts,
                           engine::SeqWriter<std::string>& takes, engine::SeqWriter<engine::File>& sounds,
                           engine::SeqWriter<engine::File>& scripts, engine::Progress& progress);

}  // namespace face::decode
