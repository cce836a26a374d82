// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace conformance {

// Notes which files this process opens for reading while it lives: opened_files.cpp stands before the C library's
// functions. The system's own places (/proc, /sys, /dev, shared libraries, time zones) are not noted.
class OpenedFiles {
 public:
  OpenedFiles();
  ~OpenedFiles();
  std::vector<std::string> paths() const;
};

}  // namespace conformance
