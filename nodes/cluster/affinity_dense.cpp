// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/affinity_dense.h"

#include <immintrin.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "nodes/base/check.h"

namespace face::cluster {
namespace {

constexpr std::size_t lanes = 8;
constexpr std::size_t chunk = 1024;          // columns that stay in the first-level cache
constexpr std::size_t rows_per_block = 256;  // whose column sums are one partial sum, whatever the threads
constexpr float lowest = -std::numeric_limits<float>::infinity();

// A column of a row whose responsibility is larger than the row's formula says, because it was the row's maximum.
struct Bonus {
  std::size_t column;
  float value;
};

struct Top {
  float first = lowest, second = lowest;
  std::size_t column = 0;

  void add(float value, std::size_t at) {
    if (value > first) {
      second = first;
      first = value;
      column = at;
    } else {
      second = std::max(second, value);
    }
  }
};

// The largest two of a + s over a chunk. The column is looked for only where the largest is a new one.
void find_top(const float* a, const float* s, std::size_t begin, std::size_t end, Top& top) {
  __m256 first = _mm256_set1_ps(lowest), second = first;
  for (std::size_t k = begin; k < end; k += lanes) {
    const __m256 v = _mm256_add_ps(_mm256_loadu_ps(a + k), _mm256_loadu_ps(s + k));
    second = _mm256_max_ps(second, _mm256_min_ps(first, v));
    first = _mm256_max_ps(first, v);
  }
  alignas(32) std::array<float, lanes> firsts, seconds;
  _mm256_store_ps(firsts.data(), first);
  _mm256_store_ps(seconds.data(), second);
  const float largest = *std::max_element(firsts.begin(), firsts.end());
  if (largest <= top.second) return;
  if (largest > top.first) {
    top.second = top.first;
    top.first = largest;
    for (top.column = begin; a[top.column] + s[top.column] != largest;) ++top.column;
  } else {
    top.second = largest;
  }
  // The runner-up of this chunk: the largest lane's second, or another lane's first.
  const auto lane = static_cast<std::size_t>(std::max_element(firsts.begin(), firsts.end()) - firsts.begin());
  if (top.first != largest) return;
  for (std::size_t l = 0; l < lanes; ++l) top.second = std::max(top.second, l == lane ? seconds[l] : firsts[l]);
}

class Passing {
 public:
  Passing(const Similarities& s, const MessageOptions& options)
      : s_(s),
        keep_(static_cast<float>(options.damping)),
        take_(1 - keep_),
        blocks_((s.rows() + rows_per_block - 1) / rows_per_block),
        stride_(s.stride()),
        availabilities_(new float[s.rows() * s.stride()]),
        maxima_(s.rows(), 0.0f),
        bonuses_(s.rows()),
        own_responsibility_(s.columns(), 0.0f),
        own_availability_(s.columns(), 0.0f),
        limits_(s.stride(), 0.0f),
        sums_(blocks_ * s.stride()) {}

  // One round of both messages; is_exemplar is written, one flag per candidate.
  void iterate(bool first, std::vector<bool>& is_exemplar) {
    const float next_share = keep_ * share_ + take_;
    tbb::parallel_for(std::size_t{0}, blocks_, [&](std::size_t block) {
      float* sums = &sums_[block * stride_];
      std::fill(sums, sums + stride_, 0.0f);
      const std::size_t end = std::min((block + 1) * rows_per_block, s_.rows());
      for (std::size_t i = block * rows_per_block; i < end; ++i) pass_row(i, first, next_share, sums);
    });
    share_ = next_share;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, s_.columns(), 512), [&](const auto& range) {
      for (std::size_t k = range.begin(); k < range.end(); ++k) {
        double sum = 0;
        for (std::size_t block = 0; block < blocks_; ++block) sum += static_cast<double>(sums_[block * stride_ + k]);
        const auto total = static_cast<float>(sum);
        own_availability_[k] = first ? take_ * total : keep_ * own_availability_[k] + take_ * total;
        limits_[k] = own_responsibility_[k] + total;
      }
    });
    for (std::size_t k = 0; k < s_.columns(); ++k) is_exemplar[k] = own_availability_[k] + own_responsibility_[k] > 0;
  }

  std::size_t likeliest_exemplar() const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < s_.columns(); ++k)
      if (own_availability_[k] + own_responsibility_[k] > own_availability_[best] + own_responsibility_[best]) best = k;
    return best;
  }

 private:
  float responsibility(std::size_t i, float s) const { return share_ * s - maxima_[i]; }

  void pass_row(std::size_t i, bool first, float next_share, float* sums) {
    const float* s = s_.row(i);
    float* a = &availabilities_[i * stride_];
    std::vector<Bonus>& bonuses = bonuses_[i];
    const std::size_t own = s_.own(i);
    Top top;
    if (first) {
      std::fill(a, a + stride_, 0.0f);
      for (std::size_t begin = 0; begin < stride_; begin += chunk)
        find_top(a, s, begin, std::min(begin + chunk, stride_), top);
    } else {
      update_availabilities(i, s, a, bonuses, own, top);
    }
    // The row's new responsibilities: for the largest column the second largest counts.
    maxima_[i] = keep_ * maxima_[i] + take_ * top.first;
    bool known = false;
    for (Bonus& bonus : bonuses) {
      bonus.value *= keep_;
      if (bonus.column != top.column) continue;
      known = true;
      bonus.value += take_ * (top.first - top.second);
    }
    if (!known && std::isfinite(top.second)) bonuses.push_back({top.column, take_ * (top.first - top.second)});
    // Below the last bit of what it is added to.
    std::erase_if(bonuses, [&](const Bonus& bonus) { return bonus.value < 1e-9f * std::abs(maxima_[i]); });
    add_positive(i, s, next_share, own, bonuses, sums);
  }

  void update_availabilities(std::size_t i, const float* s, float* a, const std::vector<Bonus>& bonuses,
                             std::size_t own, Top& top) {
    const __m256 keep = _mm256_set1_ps(keep_), take = _mm256_set1_ps(take_), zero = _mm256_setzero_ps();
    const __m256 share = _mm256_set1_ps(share_), maximum = _mm256_set1_ps(maxima_[i]);
    for (std::size_t begin = 0; begin < stride_; begin += chunk) {
      const std::size_t end = std::min(begin + chunk, stride_);
      const auto in_chunk = [&](std::size_t column) { return column >= begin && column < end; };
      std::array<float, 64> before;
      std::size_t count = 0;
      for (const Bonus& bonus : bonuses)
        if (in_chunk(bonus.column) && count < before.size()) before[count++] = a[bonus.column];
      for (std::size_t k = begin; k < end; k += lanes) {
        const __m256 r = _mm256_sub_ps(_mm256_mul_ps(share, _mm256_loadu_ps(s + k)), maximum);
        const __m256 next = _mm256_min_ps(zero, _mm256_sub_ps(_mm256_loadu_ps(&limits_[k]), _mm256_max_ps(zero, r)));
        _mm256_storeu_ps(a + k, _mm256_add_ps(_mm256_mul_ps(keep, _mm256_loadu_ps(a + k)), _mm256_mul_ps(take, next)));
      }
      count = 0;
      for (const Bonus& bonus : bonuses)
        if (in_chunk(bonus.column) && count < before.size()) {
          const float r = std::max(0.0f, responsibility(i, s[bonus.column]) + bonus.value);
          a[bonus.column] = keep_ * before[count++] + take_ * std::min(0.0f, limits_[bonus.column] - r);
        }
      if (in_chunk(own)) a[own] = own_availability_[own];
      find_top(a, s, begin, end, top);
    }
  }

  void add_positive(std::size_t i, const float* s, float next_share, std::size_t own, const std::vector<Bonus>& bonuses,
                    float* sums) {
    const __m256 share = _mm256_set1_ps(next_share), maximum = _mm256_set1_ps(maxima_[i]), zero = _mm256_setzero_ps();
    const float own_sum = own < s_.columns() ? sums[own] : 0;
    for (std::size_t k = 0; k < stride_; k += lanes) {
      const __m256 r = _mm256_sub_ps(_mm256_mul_ps(share, _mm256_loadu_ps(s + k)), maximum);
      _mm256_storeu_ps(sums + k, _mm256_add_ps(_mm256_loadu_ps(sums + k), _mm256_max_ps(zero, r)));
    }
    float own_bonus = 0;
    for (const Bonus& bonus : bonuses) {
      if (bonus.column == own) own_bonus = bonus.value;
      const float r = next_share * s[bonus.column] - maxima_[i];
      sums[bonus.column] += std::max(0.0f, r + bonus.value) - std::max(0.0f, r);
    }
    if (own == s_.columns()) return;
    sums[own] = own_sum;
    own_responsibility_[own] = next_share * s[own] - maxima_[i] + own_bonus;
  }

  const Similarities& s_;
  float keep_, take_, share_ = 0;  // share = 1 - damping^iterations
  std::size_t blocks_, stride_;
  std::unique_ptr<float[]> availabilities_;
  std::vector<float> maxima_;
  std::vector<std::vector<Bonus>> bonuses_;
  std::vector<float> own_responsibility_, own_availability_;
  std::vector<float> limits_;  // r(k, k) + sum of the positive r(i, k)
  std::vector<float> sums_;    // blocks x stride
};

}  // namespace

Similarities::Similarities(const Matrix& points, std::vector<std::size_t> candidates)
    : candidates_(std::move(candidates)), own_(points.rows, candidates_.size()) {
  const std::size_t columns = candidates_.size(), dims = points.columns;
  stride_ = (columns + lanes - 1) / lanes * lanes;
  values_.reset(new float[points.rows * stride_]);
  for (std::size_t k = 0; k < columns; ++k) own_[candidates_[k]] = k;
  // About the mean, so that single precision has its digits where the differences are; coordinate by coordinate.
  std::vector<float> row_values(points.values.size()), column_values(dims * stride_, 0.0f);
  for (std::size_t d = 0; d < dims; ++d) {
    double mean = 0;
    for (std::size_t i = 0; i < points.rows; ++i) mean += points.at(i, d);
    mean /= static_cast<double>(points.rows);
    for (std::size_t i = 0; i < points.rows; ++i) row_values[i * dims + d] = static_cast<float>(points.at(i, d) - mean);
    for (std::size_t k = 0; k < columns; ++k) column_values[d * stride_ + k] = row_values[candidates_[k] * dims + d];
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.rows, 64), [&](const auto& range) {
    for (std::size_t begin = 0; begin < stride_; begin += 128) {
      const std::size_t end = std::min(begin + 128, stride_);
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        float* to = row(i);
        for (std::size_t k = begin; k < end; k += lanes) {
          __m256 sum = _mm256_setzero_ps();
          for (std::size_t d = 0; d < dims; ++d) {
            const __m256 difference = _mm256_sub_ps(_mm256_loadu_ps(&column_values[d * stride_ + k]),
                                                    _mm256_set1_ps(row_values[i * dims + d]));
            sum = _mm256_add_ps(sum, _mm256_mul_ps(difference, difference));
          }
          _mm256_storeu_ps(to + k, _mm256_sub_ps(_mm256_setzero_ps(), sum));
        }
      }
    }
  });
  for (std::size_t i = 0; i < points.rows; ++i) std::fill(row(i) + columns, row(i) + stride_, lowest);
}

float Similarities::minimum() const {
  std::vector<float> least(rows(), 0.0f);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows(), 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      for (std::size_t k = 0; k < columns(); ++k)
        if (k != own_[i]) least[i] = std::min(least[i], row(i)[k]);
  });
  return *std::min_element(least.begin(), least.end());
}

float Similarities::median() const {
  // The bits of floats that are not positive fall as the numbers rise: the middle one is counted out in two halves.
  std::uint64_t pairs = 0;
  std::uint32_t upper = 0;
  std::uint64_t below = 0;
  for (const int pass : {0, 1}) {
    std::vector<std::uint64_t> counts(1 << 16, 0);
    for (std::size_t i = 0; i < rows(); ++i)
      for (std::size_t k = 0; k < columns(); ++k) {
        if (k == own_[i]) continue;
        const auto bits = std::bit_cast<std::uint32_t>(std::abs(row(i)[k]));
        if (pass == 0) ++pairs;
        if (pass == 0 || bits >> 16 == upper) ++counts[pass == 0 ? bits >> 16 : bits & 0xFFFF];
      }
    if (pairs == 0) return 0;
    std::uint32_t at = 0;
    while (below + counts[at] <= pairs / 2) below += counts[at++];
    if (pass == 1) return -std::bit_cast<float>(upper << 16 | at);
    upper = at;
  }
  return 0;
}

Messages pass_messages(Similarities& similarities, float preference, const MessageOptions& options,
                       engine::Progress& progress) {
  for (std::size_t i = 0; i < similarities.rows(); ++i)
    if (similarities.own(i) < similarities.columns()) similarities.row(i)[similarities.own(i)] = preference;
  Passing passing(similarities, options);
  Messages result;
  std::vector<bool> is_exemplar(similarities.columns()), last;
  std::int64_t unchanged = 0;
  while (result.iterations < options.max_iterations && !result.converged) {
    passing.iterate(result.iterations == 0, is_exemplar);
    ++result.iterations;
    unchanged = is_exemplar == last ? unchanged + 1 : 1;
    last = is_exemplar;
    const bool any = std::find(last.begin(), last.end(), true) != last.end();
    result.converged = any && unchanged >= options.patience && result.iterations > options.patience;
    progress.report(static_cast<double>(result.iterations) / static_cast<double>(options.max_iterations));
    if (progress.stop_requested()) throw std::runtime_error("stopped");
  }
  for (std::size_t k = 0; k < last.size(); ++k)
    if (last[k]) result.exemplars.push_back(k);
  if (result.exemplars.empty()) result.exemplars.push_back(passing.likeliest_exemplar());
  return result;
}

}  // namespace face::cluster
