// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/speak_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/trajectory/speak_gaussian.h"

namespace face::trajectory {
namespace {

constexpr double slot_s = 0.01;
constexpr int slots_per_frame = 4;
struct Tap {
  int offset;
  double weight;
};
// Bargmann, Blanz and Seidel, section 5.
constexpr std::array<Tap, 4> kernel = {{{-1, 0.1}, {0, 0.5}, {1, 0.3}, {3, 0.1}}};

// Mean of a phone's frames; of closure and release together where they are not told apart.
std::vector<double> viseme_of(const PhoneStatistics& statistics, const std::string& label, bool split_stops) {
  if (split_stops) return find_statistic(statistics, label).mean;
  const std::string base = label.substr(0, label.find('.'));
  std::vector<double> sum(statistics.all.mean.size(), 0.0);
  double frames = 0;
  for (const PhoneStatistic& phone : statistics.phones) {
    if (phone.label.substr(0, phone.label.find('.')) != base) continue;
    frames += static_cast<double>(phone.frames);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += static_cast<double>(phone.frames) * phone.mean[k];
  }
  if (!(frames > 0)) return statistics.all.mean;
  for (double& x : sum) x /= frames;
  return sum;
}

}  // namespace

Timeline speak_kernel(const Phones& phones, const PhoneStatistics& statistics, engine::SeqWriter<Weights>& weights,
                      const SpeakKernelOptions& options) {
  const std::size_t dims = statistics.all.mean.size();
  check(dims > 0, "statistics has no animation parameters");
  const auto slots = static_cast<std::ptrdiff_t>(std::max(1.0, std::ceil(phones.duration_s / slot_s - 1e-6)));
  std::vector<std::vector<double>> visemes;
  for (const Phone& phone : phones.phones) visemes.push_back(viseme_of(statistics, phone.label, options.split_stops));
  // The phone at the middle of every slot.
  std::vector<std::size_t> at;
  std::size_t p = 0;
  for (std::ptrdiff_t i = 0; i < slots; ++i) {
    const double middle_s = (static_cast<double>(i) + 0.5) * slot_s;
    while (p + 1 < phones.phones.size() && phones.phones[p].end_s <= middle_s) ++p;
    at.push_back(p);
  }
  const auto smoothed = [&](std::ptrdiff_t i) {
    std::vector<double> out(dims, 0.0);
    for (const Tap& tap : kernel) {
      const auto slot = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i + tap.offset, 0, slots - 1));
      const std::vector<double>& a = visemes.empty() ? statistics.all.mean : visemes[at[slot]];
      for (std::size_t k = 0; k < dims; ++k) out[k] += tap.weight * a[k];
    }
    return out;
  };
  const int step = options.blur == Blur::none ? 1 : slots_per_frame;
  Timeline timeline;
  timeline.duration_s = phones.duration_s;
  for (std::ptrdiff_t i = 0; i < slots; i += step) {
    std::vector<double> mean(dims, 0.0);
    for (int n = 0; n < step; ++n) {
      const std::vector<double> a = smoothed(std::min(i + n, slots - 1));
      for (std::size_t k = 0; k < dims; ++k) mean[k] += a[k] / step;
    }
    timeline.time_s.push_back(static_cast<double>(i) * slot_s);
    weights.push({std::vector<float>(mean.begin(), mean.end())});
  }
  return timeline;
}

}  // namespace face::trajectory
