// SPDX-License-Identifier: Apache-2.0
// A spoken sentence as graphs/phantom/video.json films it (without the film's coding), with where the 18 points are.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "nodes/phantom/make_backdrop.h"
#include "nodes/phantom/make_camera.h"
#include "nodes/phantom/make_head.h"
#include "nodes/phantom/make_lighting.h"
#include "nodes/phantom/make_person.h"
#include "nodes/phantom/perform.h"
#include "nodes/phantom/truth_landmarks.h"
#include "nodes/phantom/video_frame.h"
#include "nodes/speech/say.h"

namespace test {

struct PhantomClip {
  std::vector<std::shared_ptr<const face::Image>> frames;
  std::vector<face::Landmarks> truth;
  std::vector<double> inner_gap_px;  // between the inner edges of the lips, in the middle
};

enum class Dots { none, painted };

// The first `count` frames of a sentence, 640 x 480 at 30 per second; without those between the first and number
// `from`. painted: a white dot of 3 mm on each point.
inline PhantomClip film_phantom(const std::string& text, std::size_t count, Dots dots, std::size_t from = 1) {
  using namespace face;
  phantom::MakePersonOptions person_options;
  person_options.spread = 0;
  const auto person = phantom::make_person(phantom::make_head(), nullptr, nullptr, person_options);
  SurfaceDots painted = person.dots;
  std::vector<std::uint32_t> marked = {39, 42, 30, 7, 8, 9};
  for (std::uint32_t i = 48; i < 60; ++i) marked.push_back(i);
  if (dots == Dots::painted)
    for (const std::uint32_t i : marked) {
      const std::uint32_t v = person.person.landmarks68[i];
      painted.dots.push_back({"point", {v, v, v}, {1, 0, 0}, 1.5f, 0.3f, {0.95f, 0.95f, 0.95f}, 1});
    }
  engine::Progress progress;
  const auto said = speech::say(text, nullptr, {}, progress);
  std::vector<Weights> weights;
  std::vector<RigidMotion> motion;
  engine::SeqWriter<Weights> weight_writer([&](const std::string&, Weights w) { weights.push_back(std::move(w)); });
  engine::SeqWriter<RigidMotion> motion_writer([&](const std::string&, RigidMotion m) { motion.push_back(m); });
  phantom::PerformOptions perform_options;
  perform_options.rate_hz = 30;
  phantom::perform(said.phones, nullptr, &person.person, nullptr, weight_writer, motion_writer, perform_options);
  const Camera camera = phantom::make_camera();
  const Lighting lighting = phantom::make_lighting();
  const Image backdrop = phantom::make_backdrop();
  PhantomClip clip;
  for (std::size_t i = 0; i < std::min(count, weights.size()); ++i) {
    if (i > 0 && i < from) continue;
    const std::string id = std::to_string(i);
    clip.frames.push_back(std::make_shared<const Image>(
        phantom::video_frame(person.person, weights[i], &motion[i], camera, lighting, &painted, &backdrop, &id)));
    phantom::TruthLandmarksOptions truth_options;
    truth_options.set = phantom::LandmarkSet::lips18;
    clip.truth.push_back(phantom::truth_landmarks(person.person, weights[i], &motion[i], camera, truth_options));
    const Landmarks all = phantom::truth_landmarks(person.person, weights[i], &motion[i], camera);
    clip.inner_gap_px.push_back(all.points[66].y_px - all.points[62].y_px);
  }
  return clip;
}

// One picture of a speaker at rest, for tests of what is seen in it.
inline const PhantomClip& resting_speaker() {
  static const PhantomClip clip = film_phantom("Bob.", 1, Dots::none);
  return clip;
}

}  // namespace test
