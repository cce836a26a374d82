// SPDX-License-Identifier: Apache-2.0
#include "nodes/weights/fit_key_shapes.h"

#include <algorithm>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/weights/least_squares.h"
#include "nodes/weights/nnls.h"

namespace face::weights {
namespace {

void append(const Landmarks& landmarks, const Landmarks& expected, const std::string& name, std::vector<double>& to) {
  check(landmarks.points.size() == expected.points.size(), name, " has ", landmarks.points.size(),
        " landmarks, expected ", expected.points.size(), " as the first key shape");
  for (std::size_t i = 0; i < landmarks.points.size(); ++i) {
    check(landmarks.points[i].name == expected.points[i].name, "landmark ", i, " of ", name, " is ",
          landmarks.points[i].name, ", expected ", expected.points[i].name, " as in the first key shape");
    to.push_back(landmarks.points[i].x_px);
    to.push_back(landmarks.points[i].y_px);
  }
}

}  // namespace

void fit_key_shapes(const engine::Seq<Landmarks>& tracks, const KeyShapes& key_shapes, const Landmarks* neutral,
                    engine::SeqWriter<Weights>& weights, const FitKeyShapesOptions& options) {
  check(!key_shapes.shapes.empty(), "there are no key shapes");
  const Landmarks& first = key_shapes.shapes[0].landmarks;
  const std::size_t numbers = 2 * first.points.size(), count = key_shapes.shapes.size();
  Matrix basis{numbers, count, std::vector<double>(numbers * count)}, targets{0, numbers, {}}, rest{1, numbers, {}};
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<double> column;
    append(key_shapes.shapes[k].landmarks, first, "key shape " + key_shapes.shapes[k].frame, column);
    for (std::size_t m = 0; m < numbers; ++m) basis.at(m, k) = column[m];
  }
  if (neutral) append(*neutral, first, "neutral", rest.values);
  std::vector<bool> valid;
  for (const Landmarks& frame : tracks) {
    const auto lost =
        std::count_if(frame.points.begin(), frame.points.end(), [](const Landmark& p) { return !p.valid; });
    valid.push_back(lost <= options.max_lost);
    if (!valid.back()) continue;
    append(frame, first, "frame " + tracks.id(valid.size() - 1), targets.values);
    ++targets.rows;
  }
  const Matrix* about = neutral ? &rest : nullptr;
  const Matrix found = options.method == FitMethod::nonnegative
                           ? nnls(basis, targets, about, {options.sum_to_one}).weights
                           : least_squares(basis, targets, about, {options.sum_to_one}).weights;
  std::size_t row = 0;
  for (std::size_t t = 0; t < valid.size(); ++t) {
    Weights frame;
    if (valid[t]) {
      for (std::size_t k = 0; k < count; ++k) frame.values.push_back(static_cast<float>(found.at(row, k)));
      ++row;
    }
    weights.push(tracks.id(t), std::move(frame));
  }
}

}  // namespace face::weights
