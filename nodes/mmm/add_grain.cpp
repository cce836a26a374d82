// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/add_grain.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/random.h"
#include "nodes/base/sample_image.h"
#include "nodes/mmm/check_picture.h"
#include "nodes/mmm/morph.h"

namespace face::mmm {
namespace {

// FNV-1a (Fowler, Noll, Vo).
std::uint64_t hash(const std::string& text) {
  std::uint64_t sum = 0xcbf29ce484222325ull;
  for (const char c : text) sum = (sum ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return sum;
}

// sum beta^2, of shares as synthesise uses them: none below 0, and 1 in all.
double squared_shares(const Weights& parameters, std::size_t n) {
  double sum = 0, squares = 0;
  for (std::size_t i = n; i < 2 * n; ++i) {
    const double share = std::max(0.0, static_cast<double>(parameters.values[i]));
    sum += share, squares += share * share;
  }
  return sum > 0 ? squares / (sum * sum) : 1;
}

}  // namespace

double grain_level(const Image& image, int channel) {
  std::vector<int> sizes;
  const auto at = [&](int x, int y) {
    return static_cast<int>(image.pixels[static_cast<std::size_t>((y * image.width + x) * image.channels + channel)]);
  };
  for (int y = 1; y + 1 < image.height; ++y)
    for (int x = 1; x + 1 < image.width; ++x)
      sizes.push_back(std::abs(at(x - 1, y - 1) + at(x + 1, y - 1) + at(x - 1, y + 1) + at(x + 1, y + 1) -
                               2 * (at(x, y - 1) + at(x, y + 1) + at(x - 1, y) + at(x + 1, y)) + 4 * at(x, y)));
  if (sizes.empty()) return 0;
  // Whole numbers: the median of their distribution, linear within the step that it falls into.
  std::sort(sizes.begin(), sizes.end());
  const std::size_t half = sizes.size() / 2;
  const int step = sizes[half];
  const auto [first, last] = std::equal_range(sizes.begin(), sizes.end(), step);
  const double within =
      static_cast<double>(half - static_cast<std::size_t>(first - sizes.begin())) / static_cast<double>(last - first);
  const double median = std::max(0.0, step == 0 ? 0.5 * within : step - 0.5 + within);
  // The median of |normal| is 0.6745 sigma; the weights' squares add up to 36.
  return median / 0.6745 / 6;
}

Image add_grain(const Mmm& model, const Weights& parameters, const Image& image, const std::string* id,
                const AddGrainOptions& options) {
  check_model(model);
  const std::size_t n = model.prototypes.size();
  check_size(image, "image", model.prototypes[0].image, "the model");
  check(parameters.values.size() == 2 * n, "there are ", parameters.values.size(), " parameters, expected ", 2 * n,
        " for ", n, " prototypes");
  const double missing = std::sqrt(std::max(0.0, 1 - squared_shares(parameters, n)));
  double deviation[3];
  for (int c = 0; c < 3; ++c)
    deviation[c] =
        options.amount * missing * grain_level(model.prototypes[static_cast<std::size_t>(model.reference)].image, c);
  Random random(static_cast<std::uint64_t>(options.seed), hash(id ? *id : std::string()));
  Image grainy = image;
  for (std::size_t p = 0; p < grainy.pixels.size(); ++p)
    grainy.pixels[p] = to_byte(grainy.pixels[p] + deviation[p % 3] * random.normal());
  return grainy;
}

}  // namespace face::mmm
