// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_animation.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/decode/gltf_accessor.h"
#include "nodes/decode/gltf_file.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/read_table.h"
#include "nodes/decode/rig_shapes.h"
#include "nodes/types/arkit.h"

namespace face::decode {
namespace {

// One weight over time.
struct Curve {
  std::string name;  // ARKit's, or the file's own
  std::vector<double> time_s;
  std::vector<float> values;

  float at(double t) const {
    const auto after = std::upper_bound(time_s.begin(), time_s.end(), t);
    if (after == time_s.begin()) return values.front();
    const auto i = static_cast<std::size_t>(after - time_s.begin()) - 1;
    if (after == time_s.end() || time_s[i] == t) return values[i];
    const double share = (t - time_s[i]) / (time_s[i + 1] - time_s[i]);
    return static_cast<float>(values[i] + share * (double{values[i + 1]} - values[i]));
  }
};

// The order of a rig's shapes: the ARKit-52, then the others as they came.
ReadAnimationResult gathered(const std::vector<Curve>& curves, const std::string& title) {
  const Curve& longest = *std::max_element(
      curves.begin(), curves.end(), [](const Curve& a, const Curve& b) { return a.time_s.size() < b.time_s.size(); });
  ReadAnimationResult result;
  result.timeline.time_s = longest.time_s;
  const std::vector<double>& times = longest.time_s;
  for (std::size_t i = 0; i < times.size(); ++i)
    check(std::isfinite(times[i]) && (i == 0 ? times[i] >= 0 : times[i] > times[i - 1]), title, ": key ", i, " is at ",
          times[i], " s, expected ", i == 0 ? "0 or later" : "later than the one before");
  result.timeline.duration_s =
      times.size() > 1 ? times.back() + (times.back() - times.front()) / static_cast<double>(times.size() - 1)
                       : times.back() + 1.0 / 60;
  std::vector<std::size_t> place;
  std::size_t own = arkit_count;
  for (const Curve& curve : curves) {
    const std::size_t arkit = arkit_index(curve.name);
    place.push_back(arkit < arkit_count ? arkit : own++);
  }
  std::vector<Weights> frames(times.size());
  for (std::size_t f = 0; f < times.size(); ++f) {
    frames[f].values.assign(own, 0.0f);
    for (std::size_t c = 0; c < curves.size(); ++c) frames[f].values[place[c]] = curves[c].at(times[f]);
  }
  result.weights = engine::Seq<Weights>(std::move(frames));
  return result;
}

ReadAnimationResult read_gltf(const engine::File& file, const ShapeNames& names) {
  const engine::File main = gltf_main_file(file);
  const std::string title = title_of(main);
  const tinygltf::Model model = load_gltf(file, main);
  check(!model.animations.empty(), title, ": found no animation");
  const tinygltf::Animation& animation = model.animations[0];
  std::vector<Curve> curves;
  for (const tinygltf::AnimationChannel& channel : animation.channels) {
    if (channel.target_path != "weights") continue;
    const auto node = static_cast<std::size_t>(channel.target_node);
    if (node >= model.nodes.size() || static_cast<std::size_t>(model.nodes[node].mesh) >= model.meshes.size() ||
        static_cast<std::size_t>(channel.sampler) >= animation.samplers.size())
      fail(title, ": an animation of weights refers to what is not there");
    const tinygltf::Mesh& mesh = model.meshes[static_cast<std::size_t>(model.nodes[node].mesh)];
    const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
    const std::vector<float> times = read_floats(model, sampler.input, 1, title);
    const std::vector<float> values = read_floats(model, sampler.output, 1, title);
    const std::size_t targets = mesh.primitives.empty() ? 0 : mesh.primitives[0].targets.size();
    const bool spline = sampler.interpolation == "CUBICSPLINE";  // in-tangent, value, out-tangent at every key
    check(!times.empty() && targets > 0 && values.size() == times.size() * targets * (spline ? 3 : 1), title,
          ": found ", values.size(), " weights for ", times.size(), " keys of ", targets, " targets");
    for (std::size_t t = 0; t < targets; ++t) {
      const std::string found = gltf_target_name(model, mesh, mesh.primitives[0], t);
      const auto mapped = names.to_arkit.find(found);
      Curve curve{mapped != names.to_arkit.end() ? mapped->second : arkit_spelling(found), {}, {}};
      if (std::any_of(curves.begin(), curves.end(), [&](const Curve& c) { return c.name == curve.name; })) continue;
      curve.time_s.assign(times.begin(), times.end());
      for (std::size_t k = 0; k < times.size(); ++k)
        curve.values.push_back(values[(spline ? 3 * k + 1 : k) * targets + t]);
      curves.push_back(std::move(curve));
    }
  }
  check(!curves.empty(), title, ": its first animation moves no morph targets");
  return gathered(curves, title);
}

// "00:00:12:31.250", at so many frames per second.
double seconds_of(const std::string& timecode, double rate_hz, const std::string& place) {
  double parts[4] = {};
  const char *at = timecode.data(), *end = at + timecode.size();
  for (int i = 0; i < 4; ++i) {
    const auto [stop, error] = std::from_chars(at, end, parts[i]);
    if (error != std::errc() || (i < 3 ? stop == end || *stop != ':' : stop != end))
      fail(place, ": found the timecode \"", timecode, "\", expected hours:minutes:seconds:frames");
    at = stop + 1;
  }
  return parts[0] * 3600 + parts[1] * 60 + parts[2] + parts[3] / rate_hz;
}

ReadAnimationResult read_live_link(const engine::File& file, const ReadAnimationOptions& options) {
  const std::string title = title_of(file);
  const Table table = read_table(file);
  std::vector<Curve> curves;
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const std::string name = arkit_spelling(table.columns[c]);
    if (arkit_index(name) == arkit_count) continue;
    curves.push_back({name, {}, {}});
    columns.push_back(c);
  }
  check(!curves.empty() && !table.rows.empty(), title,
        ": found no column with an ARKit name (EyeBlinkLeft, ...), expected a table of Live Link Face");
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string place = title + ":" + std::to_string(r + 2);
    const double time_s = seconds_of(table.rows[r].name, options.timecode_rate_hz, place);
    for (std::size_t c = 0; c < curves.size(); ++c) {
      const double value = table.rows[r].values[columns[c]];
      check(std::isfinite(value), place, ": ", table.columns[columns[c]], " is empty, expected a number");
      curves[c].time_s.push_back(time_s);
      curves[c].values.push_back(static_cast<float>(value));
    }
  }
  const double start_s = curves[0].time_s[0];  // of the day that the recording began at
  for (Curve& curve : curves)
    for (double& time_s : curve.time_s) time_s -= start_s;
  return gathered(curves, title);
}

}  // namespace

ReadAnimationResult read_animation(const engine::File& file, const engine::File* names,
                                   const ReadAnimationOptions& options) {
  check(options.timecode_rate_hz > 0, "timecode_rate_hz is ", options.timecode_rate_hz, ", expected more than 0");
  if (lower_suffix(file) == ".csv") return read_live_link(file, options);
  return read_gltf(file, names ? read_shape_names(*names) : ShapeNames());
}

}  // namespace face::decode
