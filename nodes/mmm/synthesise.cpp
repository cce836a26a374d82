// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/synthesise.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/base/sample_image.h"
#include "nodes/mmm/add_grain.h"
#include "nodes/mmm/keep_detail.h"
#include "nodes/mmm/morph.h"

namespace face::mmm {

Image synthesise(const Mmm& model, const Weights& parameters, const SynthesiseOptions& options) {
  check_model(model);
  const std::size_t n = model.prototypes.size();
  check(parameters.values.size() == 2 * n, "there are ", parameters.values.size(), " parameters, expected ", 2 * n,
        " for ", n, " prototypes");
  for (std::size_t i = 0; i < 2 * n; ++i)
    check(std::isfinite(parameters.values[i]), "parameter ", i, " is ", parameters.values[i],
          ", expected finite numbers");
  const Image& shape = model.prototypes[0].image;
  const std::vector<Vec2f> inverse = invert_flow(mix_flows(model, parameters.values.data()), shape.width, shape.height);
  const float* beta = parameters.values.data() + n;
  double sum = 0, positive = 0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += static_cast<double>(beta[i]);
    positive += static_cast<double>(std::max(beta[i], 0.0f));
  }
  const double scale = positive > 0 && sum > 0 ? sum / positive : 1;
  std::vector<float> mixed(shape.pixels.size(), 0);
  std::vector<MixedPicture> pictures;
  for (std::size_t i = 0; i < n; ++i) {
    // A share this small moves no pixel by a tenth of a grey level.
    const auto share = static_cast<float>(scale * static_cast<double>(beta[i]));
    if (!(share > 4e-4f)) continue;
    std::vector<float> morphed = morph_prototype(model, i, inverse, 1);
    for (std::size_t p = 0; p < mixed.size(); ++p) mixed[p] += share * morphed[p];
    if (options.most_gain > 1) {
      const std::vector<std::uint8_t>& own = model.prototypes[i].image.pixels;
      const double energy = detail_energy({own.begin(), own.end()}, shape.width, shape.height);
      pictures.push_back({std::move(morphed), static_cast<double>(share), energy});
    }
  }
  // One picture is its own mean.
  if (pictures.size() > 1) {
    const Image& reference = model.prototypes[static_cast<std::size_t>(model.reference)].image;
    keep_detail(mixed, pictures, shape.width, shape.height, grain_level(reference, 1), options.most_gain);
  }
  Image image{shape.width, shape.height, 3, {}};
  for (const float value : mixed) image.pixels.push_back(to_byte(static_cast<double>(value)));
  return image;
}

}  // namespace face::mmm
