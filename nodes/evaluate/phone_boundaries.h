// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/phones.h"
#include "nodes/types/table.h"

namespace face::evaluate {

// Compares an alignment with the true one. Phones are matched first, by the edits of least number (Levenshtein, 1966)
// and, among equals, by the nearest middles; boundaries are compared between two phones that are next to each other and
// rightly matched in both, so that a system gains nothing by leaving hard phones out. Stops are whole ("P.c" and "P.r"
// are "P") unless both alignments split all of them.
//   boundaries        compared
//   mae_ms, median_ms mean and median size of the error; bias_ms its mean with its sign (positive = late)
//   within_10ms_percent, 20, 25, 50: share of these with an error up to that
//   unmatched_percent share of the truth's inner boundaries that are not compared
//   per_percent       phone error rate: substitutions, deletions and insertions of phones other than SIL over the
//   truth's f1_20ms_percent   of inner boundaries matched by time alone, one to one within 20 ms r_value           of
//   the same (Rasanen, Laine and Altosaar, An Improved Speech Segmentation Quality Measure: the
//                     R-value, Interspeech 2009, eqs. 5-7): 1 is perfect, over-segmentation lowers it
Table phone_boundaries(const Phones& phones, const Phones& truth);

}  // namespace face::evaluate
