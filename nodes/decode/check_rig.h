// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "engine/port.h"

namespace face::decode {

struct CheckRigResult {
  std::string text;    // what was found, a finding per line
  bool sound = false;  // read_rig takes it as it is, and it stands, looks to +z and is as large as a face
  engine::File names;  // names.json to fill in, for read_rig
};

// Looks at a head before it is used: what read_rig makes of it, which of ARKit's shapes it has and lacks, how large it
// is, and whether its mouth was found. names: as in read_rig, or null. The file that comes with it has an entry for
// every shape of the head whose name is none of ARKit's: what names says of it, else ARKit's shape with the most alike
// name that the head lacks (guess_arkit), else "" (read_rig skips those): to be looked over and filled in. Never throws
// for what is wrong with the rig: it says so.
CheckRigResult check_rig(const engine::File& file, const engine::File* names);

// The shape of ARKit, of these, that a name most likely means: the same words in another order or form ("Blink_Left",
// "mouth.open", "lip pucker"). Empty where no two share enough words, or two do equally.
std::string guess_arkit(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace face::decode
