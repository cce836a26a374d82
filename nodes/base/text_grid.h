// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "nodes/types/phones.h"

namespace face {

struct TextGridInterval {
  double start_s = 0;
  double end_s = 0;
  std::string text;
};

// An interval tier. Point tiers of a file are read over.
struct TextGridTier {
  std::string name;
  std::vector<TextGridInterval> intervals;
};

// Praat's annotation file (Boersma and Weenink, Praat manual, "TextGrid file formats").
struct TextGrid {
  double start_s = 0;
  double end_s = 0;
  std::vector<TextGridTier> tiers;
};

// Reads the long and the short text format; UTF-8 or UTF-16 with or without byte order mark, any line ends. As Praat
// does: numbers, quoted texts and <flags> that stand free are the data, everything else is decoration. name: what
// messages call the file. Throws with name, line, what was found and what was expected.
TextGrid parse_text_grid(std::string_view bytes, const std::string& name);

// The long text format in UTF-8; times are written so that reading gives them back exactly.
std::string write_text_grid(const TextGrid& grid);

// Two tiers, "words" and "phones"; silence is an empty text. A word that is said twice in a row is told apart only
// where its phones repeat.
TextGrid text_grid_from_phones(const Phones& phones);

}  // namespace face
