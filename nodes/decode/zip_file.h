// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <string>

#include "engine/port.h"

namespace face::decode {

// The files of a ZIP archive by name, stored or deflated (PKWARE, .ZIP File Format Specification 6.3, sections 4.3.12
// and 4.4.5), as numpy.savez and savez_compressed write them. Sizes beyond 4 GB, encryption and archives in parts are
// not read. Throws, naming the file, where it is none, is cut off, or a file's checksum is not what the archive says.
std::map<std::string, std::string> read_zip(const engine::File& file);

}  // namespace face::decode
