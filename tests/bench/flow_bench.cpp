// SPDX-License-Identifier: Apache-2.0
// Dense correspondence on frames of the phantom's scanner, against the truth of every pixel in the mouth region:
// flow.scan beside OpenCV's flows, each on grey and on radius, each with and without the start that the markers give.
// Errors are counters (mm, px); time is one thread's CPU time of a 640 x 480 pair.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "nodes/align/find_markers.h"
#include "nodes/align/fit_axis.h"
#include "nodes/align/orient.h"
#include "nodes/flow/opencv_flow.h"
#include "nodes/flow/robust_flow.h"
#include "nodes/flow/scan_channels.h"
#include "nodes/flow/scan_flow.h"
#include "nodes/flow/start_flow.h"
#include "nodes/mask/fill_holes.h"
#include "nodes/mask/remove_mouth.h"
#include "nodes/mask/reopen.h"
#include "nodes/mask/smooth_depth.h"
#include "tests/support/phantom_stream.h"

namespace {

using namespace face;

struct Prepared {
  test::PhantomStream::Frame frame;
  DepthScan scan;
  Landmarks markers;
  FeatureMap channels;
  FlowField truth, start;
};

RigidMotion sway(double yaw, double pitch, double x, double y) {
  RigidMotion m;
  const double cy = std::cos(yaw), sy = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch);
  m.rotation = {cy, sy * sp, sy * cp, 0, cp, -sp, -sy, cy * sp, cy * cp};
  m.translation_mm = {x, y, 0};
  return m;
}

// The stream's way to the flow, as graphs/scan_stream/model.json goes it.
class Material {
 public:
  Material() {
    cv::setNumThreads(1);
    using Pose = std::map<std::string, float>;
    const std::vector<std::pair<Pose, RigidMotion>> poses = {
        {{{"jawOpen", 0.15f}}, {}},
        {{}, sway(0.03, 0.02, 2, -1)},
        {{{"jawOpen", 0.3f}}, sway(-0.04, 0.03, -2, 2)},
        {{{"jawOpen", 0.55f}}, sway(0.05, -0.02, 3, 1)},
        {{{"jawOpen", 0.3f}, {"mouthFunnel", 0.7f}}, sway(0.02, 0.04, 0, 2)},
        {{{"jawOpen", 0.15f}, {"mouthPucker", 0.8f}}, sway(-0.03, -0.03, -1, -2)},
        {{{"jawOpen", 0.2f}, {"mouthSmileLeft", 0.7f}, {"mouthSmileRight", 0.7f}}, sway(0.04, 0.01, 1, 1)},
        {{{"mouthLowerDownLeft", 0.5f},
          {"mouthLowerDownRight", 0.5f},
          {"mouthUpperUpLeft", 0.4f},
          {"mouthUpperUpRight", 0.4f}},
         sway(-0.05, 0, 2, 0)}};
    for (const auto& [pose, motion] : poses) {
      Prepared p{stream_.frame(stream_.weights(pose), motion, std::to_string(frames_.size())), {}, {}, {}, {}, {}};
      const auto mouth = mask::remove_mouth(p.frame.scan, nullptr, nullptr);
      p.scan = mask::reopen(mask::smooth_depth(mask::fill_holes(mouth.scan).scan, nullptr), mouth.interior);
      p.markers = align::find_markers(engine::Seq<DepthScan>({p.frame.scan}));
      if (!frames_.empty()) {
        const Prepared& reference = frames_.front();
        p.markers = align::link_markers(p.markers, reference.markers);
        engine::Progress quiet;
        p.scan = align::orient(p.scan, p.markers, reference.scan, reference.markers, {}, quiet).aligned;
        p.truth = stream_.truth_flow(reference.frame, p.frame);
        p.start = flow::start_flow(reference.scan, p.scan, &reference.markers, &p.markers);
      } else {
        axis_ = align::fit_axis(p.scan).axis;
      }
      p.channels = flow::scan_channels(p.scan, &axis_);
      frames_.push_back(std::move(p));
    }
  }
  const Prepared& reference() const { return frames_.front(); }
  std::size_t count() const { return frames_.size() - 1; }
  const Prepared& target(std::size_t i) const { return frames_[i + 1]; }
  // Skin of the reference about the mouth.
  bool in_region(std::size_t i) const {
    const int x = static_cast<int>(i) % 640, y = static_cast<int>(i) / 640;
    return std::abs(x - 320) < 85 && y > 250 && y < 372 && stream_.part(reference().frame, i) == "face";
  }

 private:
  test::PhantomStream stream_;
  Axis axis_;
  std::vector<Prepared> frames_;
};

const Material& material() {
  static const Material made;
  return made;
}

using Run = FlowField (*)(const FeatureMap&, const FeatureMap&, const FlowField*);

void correspondence(benchmark::State& state, Run run, bool with_start) {
  const Material& m = material();
  std::vector<double> errors_mm;
  double sum_px = 0;
  for (auto _ : state)
    for (std::size_t t = 0; t < m.count(); ++t) {
      const Prepared& target = m.target(t);
      const FlowField flow = run(m.reference().channels, target.channels, with_start ? &target.start : nullptr);
      state.PauseTiming();
      for (std::size_t i = 0; i < flow.valid.size(); ++i) {
        if (!target.truth.valid[i] || !(m.reference().scan.depth_mm[i] > 0) || !m.in_region(i)) continue;
        const double px =
            std::hypot(static_cast<double>(flow.displacement_px[i][0] - target.truth.displacement_px[i][0]),
                       static_cast<double>(flow.displacement_px[i][1] - target.truth.displacement_px[i][1]));
        sum_px += px;
        errors_mm.push_back(px *
                            static_cast<double>(m.reference().scan.depth_mm[i] / m.reference().scan.camera.focal_px));
      }
      state.ResumeTiming();
    }
  std::sort(errors_mm.begin(), errors_mm.end());
  state.counters["median_mm"] = errors_mm[errors_mm.size() / 2];
  state.counters["p95_mm"] = errors_mm[errors_mm.size() * 95 / 100];
  state.counters["mean_px"] = sum_px / static_cast<double>(errors_mm.size());
  state.counters["pair_s"] = benchmark::Counter(
      static_cast<double>(m.count()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// With a start as graphs/scan_stream/model.json has it, without one as by default.
FlowField scan(const FeatureMap& a, const FeatureMap& b, const FlowField* s) {
  flow::ScanFlowOptions options;
  if (s) {
    options.search = false;
    options.window_px = 7;
    options.coarse_warps = 6;
    options.fine_warps = 5;
    options.smoothness = 15;
    options.bend_px = 2;
    options.mismatch = 15;
  }
  return flow::scan_flow(a, b, s, options);
}
FlowField dis_grey(const FeatureMap& a, const FeatureMap& b, const FlowField* s) {
  return flow::dis_flow(a, b, s, {"grey"});
}
FlowField dis_radius(const FeatureMap& a, const FeatureMap& b, const FlowField* s) {
  return flow::dis_flow(a, b, s, {"radius"});
}
FlowField farneback_grey(const FeatureMap& a, const FeatureMap& b, const FlowField* s) {
  return flow::farneback_flow(a, b, s, {"grey"});
}
FlowField farneback_radius(const FeatureMap& a, const FeatureMap& b, const FlowField* s) {
  return flow::farneback_flow(a, b, s, {"radius"});
}
FlowField tvl1_grey(const FeatureMap& a, const FeatureMap& b, const FlowField* s) {
  return flow::tvl1_flow(a, b, s, {"grey"});
}
FlowField tvl1_radius(const FeatureMap& a, const FeatureMap& b, const FlowField* s) {
  return flow::tvl1_flow(a, b, s, {"radius"});
}

#define FLOW(name)                                                                                    \
  BENCHMARK_CAPTURE(correspondence, name, name, false)->Unit(benchmark::kMillisecond)->Iterations(1); \
  BENCHMARK_CAPTURE(correspondence, name##_with_start, name, true)->Unit(benchmark::kMillisecond)->Iterations(1)
FLOW(scan);
FLOW(dis_grey);
FLOW(dis_radius);
FLOW(farneback_grey);
FLOW(farneback_radius);
FLOW(tvl1_grey);
FLOW(tvl1_radius);

}  // namespace
