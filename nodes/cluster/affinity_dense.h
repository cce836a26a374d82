// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/port.h"
#include "nodes/types/matrix.h"

namespace face::cluster {

struct MessageOptions {
  double damping = 0.5;
  std::int64_t max_iterations = 200;
  std::int64_t patience = 15;
};

struct Messages {
  std::vector<std::size_t> exemplars;  // indices into candidates
  bool converged = false;
  std::int64_t iterations = 0;
};

// -|a - b|^2 of every point to every candidate (candidates ascending), one row per point, every row `stride` floats
// long. A candidate's own entry is 0 here.
class Similarities {
 public:
  Similarities(const Matrix& points, std::vector<std::size_t> candidates);
  std::size_t rows() const { return own_.size(); }
  std::size_t columns() const { return candidates_.size(); }
  std::size_t stride() const { return stride_; }
  const std::vector<std::size_t>& candidates() const { return candidates_; }
  // Column of a point's own candidacy, or columns().
  std::size_t own(std::size_t row) const { return own_[row]; }
  float* row(std::size_t i) { return &values_[i * stride_]; }
  const float* row(std::size_t i) const { return &values_[i * stride_]; }

  // Least and median of the entries but the own ones. The median of all pairs, exactly.
  float minimum() const;
  float median() const;

 private:
  std::vector<std::size_t> candidates_, own_;
  std::size_t stride_ = 0;
  std::unique_ptr<float[]> values_;
};

// Passes messages until the exemplars have not changed for a while. A point without a candidacy of its own can only be
// represented. `similarities` gets the preference as the candidates' own entries.
Messages pass_messages(Similarities& similarities, float preference, const MessageOptions& options,
                       engine::Progress& progress);

}  // namespace face::cluster
