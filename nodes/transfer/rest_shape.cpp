// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/rest_shape.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <sstream>
#include <vector>

#include "nodes/base/check.h"

namespace face::transfer {
namespace {

// "P B M, SIL" as {{"P", "B", "M"}, {"SIL"}}.
std::vector<std::vector<std::string>> choices_of(const std::string& text) {
  std::vector<std::vector<std::string>> choices;
  std::istringstream all(text);
  for (std::string part; std::getline(all, part, ',');) {
    std::istringstream labels(part);
    choices.emplace_back(std::istream_iterator<std::string>(labels), std::istream_iterator<std::string>());
  }
  return choices;
}

// A stop's label stands for its closure, too.
bool counts(const std::vector<std::string>& labels, const std::string& label) {
  return std::any_of(labels.begin(), labels.end(),
                     [&](const std::string& l) { return label == l || label == l + ".c"; });
}

std::vector<std::size_t> frames_within(const Timeline& timeline, const Phones& phones,
                                       const std::vector<std::string>& labels, double margin_s) {
  std::vector<std::size_t> frames;
  for (std::size_t t = 0; t < timeline.time_s.size(); ++t)
    for (const Phone& phone : phones.phones)
      if (counts(labels, phone.label) && timeline.time_s[t] >= phone.start_s + margin_s &&
          timeline.time_s[t] < phone.end_s - margin_s) {
        frames.push_back(t);
        break;
      }
  return frames;
}

}  // namespace

MeshPoints rest_shape(const engine::Seq<MeshPoints>& shapes, const Timeline& timeline, const Phones& phones,
                      const engine::Seq<bool>* known, const RestShapeOptions& options) {
  check(shapes.size() == timeline.time_s.size(), "shapes has ", shapes.size(), " frames, timeline ",
        timeline.time_s.size());
  check(!known || known->size() == shapes.size(), "shapes has ", shapes.size(), " frames, known ",
        known ? known->size() : 0);
  std::vector<std::size_t> frames;
  for (const std::vector<std::string>& labels : choices_of(options.label))
    for (const double margin_s : {options.margin_s, 0.0}) {
      if (!frames.empty()) break;
      frames = frames_within(timeline, phones, labels, margin_s);
      std::erase_if(frames, [&](std::size_t t) { return known && !*known->at(t); });
    }
  check(!frames.empty(), "no ", known ? "known " : "", "frame lies within a segment of \"", options.label, "\" of ",
        phones.phones.size(), " segments");
  std::vector<std::array<double, 3>> sum;
  for (const std::size_t t : frames) {
    const auto shape = shapes.at(t);
    sum.resize(sum.empty() ? shape->points_mm.size() : sum.size(), {0, 0, 0});
    check(shape->points_mm.size() == sum.size(), "shape ", shapes.id(t), " has ", shape->points_mm.size(),
          " points, expected ", sum.size(), " as the others");
    for (std::size_t v = 0; v < sum.size(); ++v)
      for (std::size_t k = 0; k < 3; ++k) sum[v][k] += static_cast<double>(shape->points_mm[v][k]);
  }
  MeshPoints rest;
  for (const auto& s : sum) {
    Vec3f p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = static_cast<float>(s[k] / static_cast<double>(frames.size()));
    rest.points_mm.push_back(p);
  }
  return rest;
}

}  // namespace face::transfer
