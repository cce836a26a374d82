// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace face {

// One segment of speech. Labels are ARPAbet without stress ("AA", "SIL"); a stop is two segments, closure and release
// ("P.c", "P.r"). Segments tile [0, duration_s] without gap or overlap.
struct Phone {
  std::string label;
  double start_s = 0;
  double end_s = 0;
  std::string word;  // the word it belongs to, lower case; empty in silence
  double score = 0;  // mean log likelihood per frame relative to the best path; 0 where unknown, lower is worse
};

struct Phones {
  std::vector<Phone> phones;
  double duration_s = 0;
  bool confident = true;  // false when recognised without a transcript
};

}  // namespace face
