// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/build.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "nodes/base/check.h"
#include "nodes/mmm/check_picture.h"
#include "nodes/mmm/morph.h"

namespace face::mmm {
namespace {

// RMS, grey values: more than a camera's noise, less than lips that part.
constexpr double least_difference = 4;

std::int64_t difference(const Image& a, const Image& b) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += (a.pixels[i] - b.pixels[i]) * (a.pixels[i] - b.pixels[i]);
  return sum;
}

std::int16_t fixed_point(float px) {
  return static_cast<std::int16_t>(std::clamp(std::lround(64.0 * static_cast<double>(px)), -32767L, 32767L));
}

}  // namespace

Mmm build(const engine::Seq<Image>& images, const Matrix& exemplars, engine::Progress& progress) {
  check(exemplars.rows > 0, "there are no exemplars, expected at least one");
  check(exemplars.columns == 1 && exemplars.values.size() == exemplars.rows, "exemplars is ", exemplars.rows, " x ",
        exemplars.columns, " with ", exemplars.values.size(), " values, expected one column");
  std::set<std::size_t> chosen;
  for (std::size_t i = 0; i < exemplars.rows; ++i) {
    const double number = exemplars.at(i, 0);
    check(number >= 0 && number < static_cast<double>(images.size()) && number == std::floor(number), "exemplar ", i,
          " is image ", number, ", expected one of ", images.size());
    chosen.insert(static_cast<std::size_t>(number));
  }
  Mmm model;
  for (const std::size_t frame : chosen) {
    const auto image = images.at(frame);
    const std::string name = "image " + images.id(frame);
    if (model.prototypes.empty())
      check_picture(*image, name);
    else
      check_size(*image, name, model.prototypes[0].image, "the first one");
    model.prototypes.push_back({images.id(frame), *image, {}});
  }
  const std::size_t count = model.prototypes.size();
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 0; i < count; ++i) {
    std::int64_t sum = 0;
    for (std::size_t j = 0; j < count; ++j) sum += difference(model.prototypes[i].image, model.prototypes[j].image);
    if (sum < least) least = sum, model.reference = static_cast<std::int64_t>(i);
  }
  const auto reference = static_cast<std::size_t>(model.reference);
  const Image& middle = model.prototypes[reference].image;
  double most = 0;
  for (const MmmPrototype& prototype : model.prototypes)
    most = std::max(most, std::sqrt(static_cast<double>(difference(middle, prototype.image)) /
                                    static_cast<double>(middle.pixels.size())));
  if (most < least_difference)
    progress.warn(message("the pictures hardly differ (by ", most,
                          " grey values RMS at most): there is no mouth in them, or it does not move"));
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    MmmPrototype& prototype = model.prototypes[i];
    prototype.flow_64th_px.assign(prototype.image.pixels.size() / 3 * 2, 0);
    if (i == reference) return;
    const std::vector<Vec2f> flow = follow_mouth(model.prototypes[reference].image, prototype.image);
    for (std::size_t p = 0; p < flow.size(); ++p) {
      prototype.flow_64th_px[2 * p] = fixed_point(flow[p][0]);
      prototype.flow_64th_px[2 * p + 1] = fixed_point(flow[p][1]);
    }
  });
  return model;
}

}  // namespace face::mmm
