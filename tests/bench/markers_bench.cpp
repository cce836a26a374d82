// SPDX-License-Identifier: Apache-2.0
// Markers followed through a take of the phantom's scanner, 640 x 480: head that turns and speaks. The counter
// frames_of_50_per_s, counted for 50 markers in a frame, is to be 500 or more; lost and rms_px are against the truth,
// where the skin faces the camera.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "nodes/align/find_markers.h"
#include "nodes/align/track_markers.h"
#include "tests/support/phantom_stream.h"

namespace {

using namespace face;

RigidMotion turn(double yaw, double x) {
  RigidMotion m;
  m.rotation = {std::cos(yaw), 0, std::sin(yaw), 0, 1, 0, -std::sin(yaw), 0, std::cos(yaw)};
  m.translation_mm = {x, 0, 0};
  return m;
}

void follow_markers(benchmark::State& state) {
  const test::PhantomStream stream;
  std::vector<test::PhantomStream::Frame> frames;
  for (int t = 0; t < 40; ++t)
    frames.push_back(stream.frame(stream.weights({{"jawOpen", 0.3f * (1 - std::cos(0.5f * static_cast<float>(t)))}}),
                                  turn(0.1 * std::sin(0.16 * t), 3 * std::sin(0.1 * t)), std::to_string(t)));
  const Landmarks start = align::find_markers(engine::Seq<DepthScan>({frames[0].scan}));
  std::map<std::string, std::string> names;
  for (const Landmark& marker : start.points)
    for (const Landmark& dot : stream.marker_truth(frames[0]).points)
      if (std::hypot(dot.x_px - marker.x_px, dot.y_px - marker.y_px) < 2) names[marker.name] = dot.name;
  engine::Progress quiet;
  double count = 0, lost = 0, square = 0, seen = 0;
  for (auto _ : state) {
    engine::Prior<align::TrackMarkersResult> before;
    for (const auto& frame : frames) {
      auto result = align::track_markers(frame.scan, start, nullptr, before, {}, quiet);
      ++count;
      state.PauseTiming();
      const Landmarks truth = stream.marker_truth(frame);
      for (const Landmark& marker : result.markers.points)
        for (const Landmark& dot : truth.points)
          if (names.contains(marker.name) && names[marker.name] == dot.name) {
            ++seen;
            if (marker.valid)
              square += std::pow(dot.x_px - marker.x_px, 2) + std::pow(dot.y_px - marker.y_px, 2);
            else
              ++lost;
          }
      state.ResumeTiming();
      before = engine::Prior<align::TrackMarkersResult>(
          std::make_shared<const align::TrackMarkersResult>(std::move(result)));
    }
  }
  state.counters["frames_of_50_per_s"] =
      benchmark::Counter(count * static_cast<double>(start.points.size()) / 50, benchmark::Counter::kIsRate);
  state.counters["lost"] = lost / seen;
  state.counters["rms_px"] = std::sqrt(square / (seen - lost));
}
BENCHMARK(follow_markers)->Unit(benchmark::kMillisecond);

}  // namespace
