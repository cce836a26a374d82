// SPDX-License-Identifier: Apache-2.0
// Fits and tracks a person off the embedded head: how long, and in counters how well. Run it for both figures.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "nodes/base/random.h"
#include "nodes/model/fit_image.h"
#include "nodes/model/fit_landmarks.h"
#include "nodes/model/from_rig.h"
#include "nodes/model/gram.h"
#include "nodes/model/region_pca.h"
#include "nodes/model/track_video.h"
#include "nodes/phantom/identity_modes.h"
#include "nodes/phantom/make_head.h"
#include "nodes/phantom/make_person.h"
#include "nodes/phantom/video_frame.h"
#include "nodes/render/camera.h"
#include "nodes/texture/draw_face.h"
#include "nodes/texture/extract.h"
#include "nodes/texture/neutralise.h"
#include "nodes/texture/render_into.h"
#include "tests/nodes/model/quiet_fit.h"

namespace {

using namespace face;

struct World {
  Rig head = phantom::make_head({.with_hair = false});
  ShapeSet modes = phantom::identity_modes({.with_hair = false});
  MorphableModel model = model::from_rig(head, &modes);
  Rig person = phantom::make_person(head, &modes, nullptr, {.seed = 41, .warp_mm = 1}).person;
  RigidMotion turn;
  Camera camera;
  Lighting lighting;
  Weights rest;
  Image picture;
  Landmarks points;

  World() {
    const double yaw = 20 * std::numbers::pi / 180;
    turn.rotation = {std::cos(yaw), 0, std::sin(yaw), 0, 1, 0, -std::sin(yaw), 0, std::cos(yaw)};
    camera.position_mm = {0, 10, 900};
    camera.centre_x_px = 319.5f;
    camera.centre_y_px = 239.5f;
    camera.focal_px = 1500;
    lighting.towards_light = {0.4f, 0.4f, 0.8246f};
    rest.values.assign(head.shapes.size(), 0.0f);
    picture = phantom::video_frame(person, rest, &turn, camera, lighting, nullptr, nullptr, nullptr);
    Random random(1);
    for (const int point : {36, 39, 42, 45, 30, 31, 35, 48, 54, 51, 57, 8, 17, 21, 22, 26}) {
      const Vec3f& p = person.neutral.points_mm[head.landmarks68[static_cast<std::size_t>(point)]];
      Vec3f world{};
      for (std::size_t k = 0; k < 3; ++k)
        world[k] = static_cast<float>(turn.rotation[3 * k] * p[0] + turn.rotation[3 * k + 1] * p[1] +
                                      turn.rotation[3 * k + 2] * p[2]);
      const render::ScreenPoint seen = render::project(camera, world);
      points.points.push_back({std::to_string(point), seen.x_px + random.normal(), seen.y_px + random.normal(), true});
    }
  }
};

const World& world() {
  static const World made;
  return made;
}

void FitLandmarks(benchmark::State& state) {
  world();  // made before the clock runs
  FaceFit fit;
  for (auto _ : state) fit = model::fit_landmarks(world().model, world().points, world().picture);
  state.counters["nme_percent"] = 100 * fit.landmark_nme;
  state.counters["gap_mm"] = fit.lip_gap_mm;
}
BENCHMARK(FitLandmarks)->Unit(benchmark::kMillisecond);

void FitImage(benchmark::State& state) {
  world();
  FaceFit fit;
  for (auto _ : state) fit = model::fit_image(world().model, world().picture, world().points);
  double trace = 0;
  for (std::size_t i = 0; i < 9; ++i)
    trace += static_cast<double>(fit.camera.cam_from_world[i]) * world().turn.rotation[i];
  state.counters["turn_error_deg"] = std::acos(std::clamp(0.5 * (trace - 1), -1.0, 1.0)) * 180 / std::numbers::pi;
  state.counters["gap_mm"] = fit.lip_gap_mm;
}
BENCHMARK(FitImage)->Unit(benchmark::kMillisecond);

// Beside the first frame's picture, as graphs track.
void TrackVideo(benchmark::State& state) {
  const Image& picture = world().picture;
  const FaceFit start = model::fit_image(world().model, picture, world().points);
  const AlbedoMap map = texture::extract(world().model, picture, start);
  for (auto _ : state)
    benchmark::DoNotOptimize(model::track_video(world().model, picture, start, map, &picture, {}).fit.image_rms);
}
BENCHMARK(TrackVideo)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

// 2,000 shapes of 20,000 vertices to 50 components, on as many threads as there are: a region of a fifth, and all.
void RegionPca(benchmark::State& state) {
  constexpr std::size_t count = 2000, vertices = 20000, rank = 60;
  Random random(1);
  std::vector<std::vector<float>> modes(rank, std::vector<float>(3 * vertices));
  for (auto& mode : modes)
    for (float& x : mode) x = static_cast<float>(random.normal());
  std::vector<MeshPoints> shapes(count);
  for (MeshPoints& shape : shapes) {
    std::vector<float> x(3 * vertices);
    for (std::size_t k = 0; k < rank; ++k) {
      const auto a = static_cast<float>(random.normal() / static_cast<double>(k + 1));
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += a * modes[k][i];
    }
    for (float& value : x) value += 0.01f * static_cast<float>(random.bits() >> 40) / 16777216.0f;
    for (std::size_t v = 0; v < vertices; ++v) shape.points_mm.push_back({x[3 * v], x[3 * v + 1], x[3 * v + 2]});
  }
  Matrix weights{vertices, 1, std::vector<double>(vertices, 0.0)};
  for (std::size_t v = 0; v < vertices / static_cast<std::size_t>(state.range(0)); ++v) weights.values[v] = 1;
  const engine::Seq<MeshPoints> all(std::move(shapes));
  for (auto _ : state) benchmark::DoNotOptimize(model::region_pca(all, &weights, {.components = 50}).modes.data());
}
BENCHMARK(RegionPca)->Arg(5)->Arg(1)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

// The Gram matrix alone, as on a processor with registers of 256 bits.
void GramNarrow(benchmark::State& state) {
  const std::vector<double> row(60000, 0.5);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        model::gram_of_narrow(2000, row.size(), [&](std::size_t, std::size_t first, std::span<double> out) {
          std::copy_n(row.begin() + static_cast<std::ptrdiff_t>(first), out.size(), out.begin());
        }));
}
BENCHMARK(GramNarrow)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void Extract(benchmark::State& state) {
  const FaceFit fit = model::fit_image(world().model, world().picture, world().points);
  for (auto _ : state) benchmark::DoNotOptimize(texture::extract(world().model, world().picture, fit).weight.data());
}
BENCHMARK(Extract)->Unit(benchmark::kMillisecond);

void RenderInto(benchmark::State& state) {
  const FaceFit fit = model::fit_image(world().model, world().picture, world().points);
  const AlbedoMap map = texture::extract(world().model, world().picture, fit);
  const Rig person = texture::neutralise(world().model, world().head, fit, map);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        texture::render_into(world().model, person, map, fit, world().picture, nullptr, &world().rest).pixels.data());
}
BENCHMARK(RenderInto)->Unit(benchmark::kMillisecond);

}  // namespace
