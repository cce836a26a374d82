// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/perform.h"

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include "nodes/base/check.h"
#include "nodes/phantom/articulation.h"
#include "nodes/phantom/liveliness.h"
#include "nodes/phantom/mouth_contacts.h"
#include "nodes/phantom/person_random.h"
#include "nodes/phantom/vector3.h"
#include "nodes/types/arkit.h"

namespace face::phantom {
namespace {

constexpr double kFullLook_deg = 30;  // what an eyeLook weight of 1 turns on usual rigs

class Pose {
 public:
  Pose() { weights_.values.assign(arkit_count, 0.0f); }
  void set(std::string_view name, double value) {
    weights_.values[arkit_index(name)] = static_cast<float>(std::clamp(value, 0.0, 1.0));
  }
  void set_sides(const std::string& name, double value, double left = 1, double right = 1) {
    set(name + "Left", left * value);
    set(name + "Right", right * value);
  }
  std::vector<float>& values() { return weights_.values; }
  Weights weights() const { return weights_; }

 private:
  Weights weights_;
};

void pose_mouth(const Articulation& mouth, const SpeakerStyle& style, const MouthContacts& contacts, double strength,
                Pose& pose) {
  Gestures gestures = mouth.gestures;
  for (double& gesture : gestures) gesture *= strength;
  const double shut = mouth.lips_shut, bite = mouth.lip_teeth;
  const MouthContacts::LipTeethPose& lip_teeth = contacts.lip_teeth();
  // Shut lips: nothing may hold them open, and the jaw is raised.
  const double jaw = lerp(lerp(gestures[kJaw], lip_teeth.jaw, bite), std::min(gestures[kJaw], 0.12), shut);
  const double apart = (1 - shut) * (1 - bite);
  pose.set("jawOpen", jaw);
  pose.set("mouthPucker", gestures[kPucker] * (1 - 0.3 * shut) * (1 - 0.7 * bite));
  pose.set("mouthFunnel", gestures[kFunnel] * apart);
  pose.set_sides("mouthStretch", 0.55 * gestures[kSpread] * (1 - 0.5 * shut) * (1 - bite), style.left, style.right);
  pose.set_sides("mouthSmile", 0.45 * gestures[kSpread] * (1 - 0.5 * shut) * (1 - bite) + style.smile * (1 - bite),
                 style.left, style.right);
  const double upper = lerp(gestures[kUpperLip], lip_teeth.upper, bite) * (1 - shut);
  pose.set_sides("mouthUpperUp", upper, bite > 0 ? 1 : style.left, bite > 0 ? 1 : style.right);
  pose.set_sides("mouthLowerDown", gestures[kLowerLip] * apart, style.left, style.right);
  pose.set("mouthRollLower", lip_teeth.roll * bite + 0.3 * style.press * shut);
  pose.set("mouthRollUpper", 0.3 * style.press * shut);
  pose.set_sides("mouthPress", style.press * shut);
  // The tongue comes out between open teeth only.
  pose.set("tongueOut", std::min(gestures[kTongue], 2.2 * jaw) * apart);
  contacts.close_lips(shut, pose.values());
}

void pose_rest(const Life& life, double blink, double gaze, Pose& pose) {
  pose.set_sides("eyeBlink", blink * life.blink);
  pose.set("browInnerUp", life.brow_inner);
  pose.set_sides("browOuterUp", life.brow_outer);
  pose.set_sides("browDown", life.brow_down);
  if (gaze == 0) return;
  const double left = life.look_left_deg / kFullLook_deg, up = life.look_up_deg / kFullLook_deg;
  const double open = 1 - blink * life.blink;  // lids that are shut do not follow the eye twice
  pose.set("eyeLookOutLeft", left);
  pose.set("eyeLookInRight", left);
  pose.set("eyeLookInLeft", -left);
  pose.set("eyeLookOutRight", -left);
  pose.set_sides("eyeLookUp", up * open);
  pose.set_sides("eyeLookDown", -up * open);
}

using Rotation = std::array<double, 9>;

Rotation product(const Rotation& a, const Rotation& b) {
  Rotation c = {};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[3 * i + j] += a[3 * i + k] * b[3 * k + j];
  return c;
}

// Turns about the neck.
RigidMotion head_motion(const Life& life, Vector3 pivot) {
  const double p = -life.pitch_deg * std::numbers::pi / 180, w = life.yaw_deg * std::numbers::pi / 180,
               r = -life.roll_deg * std::numbers::pi / 180;
  const Rotation about_x = {1, 0, 0, 0, std::cos(p), -std::sin(p), 0, std::sin(p), std::cos(p)};
  const Rotation about_y = {std::cos(w), 0, std::sin(w), 0, 1, 0, -std::sin(w), 0, std::cos(w)};
  const Rotation about_z = {std::cos(r), -std::sin(r), 0, std::sin(r), std::cos(r), 0, 0, 0, 1};
  RigidMotion motion;
  motion.rotation = product(about_y, product(about_x, about_z));
  const std::array<double, 3> from = {pivot.x, pivot.y, pivot.z};
  for (std::size_t i = 0; i < 3; ++i) {
    double turned = 0;
    for (std::size_t k = 0; k < 3; ++k) turned += motion.rotation[3 * i + k] * from[k];
    motion.translation_mm[i] = from[i] - turned + life.shift_mm[i];
  }
  return motion;
}

// Below and behind the ears: between the ends of the jaw line, a face's half width down.
Vector3 find_pivot(const Rig* rig) {
  if (!rig || rig->landmarks68.size() != 68) return {0, -60, 0};
  const auto mark = [&](std::size_t k) {
    const Vec3f& p = rig->neutral.points_mm.at(rig->landmarks68[k]);
    return Vector3{p[0], p[1], p[2]};
  };
  const Vector3 middle = 0.5 * (mark(0) + mark(16));
  return middle + Vector3{0, -0.5 * length(mark(16) - mark(0)), -20};
}

Timeline make_timeline(double duration_s, double rate_hz) {
  Timeline timeline;
  timeline.duration_s = duration_s;
  // A frame that would begin where the last one ends is none.
  const auto frames = static_cast<std::size_t>(std::ceil(duration_s * rate_hz - 1e-6));
  for (std::size_t k = 0; k < frames; ++k) timeline.time_s.push_back(static_cast<double>(k) / rate_hz);
  return timeline;
}

void check_options(const PerformOptions& options) {
  check(options.rate_hz >= 1 && options.rate_hz <= 1000, "rate_hz is ", options.rate_hz, ", expected 1 to 1000");
  const auto check_amount = [](const char* name, double value) {
    check(value >= 0, name, " is ", value, ", expected at least 0");
  };
  check_amount("strength", options.strength);
  check_amount("style", options.style);
  check_amount("blink", options.blink);
  check_amount("brows", options.brows);
  check_amount("gaze", options.gaze);
  check_amount("head_motion", options.head_motion);
  check_amount("turn_deg", options.turn_deg);
  check(options.turn_s > 0, "turn_s is ", options.turn_s, ", expected more than 0");
}

// Events are drawn second by second: no performance is longer than eleven days.
void check_time(double time_s, const std::string& what) {
  constexpr double kLongest_s = 1e6;
  check(std::abs(time_s) <= kLongest_s, what, " is at ", time_s, " s, expected a time within 1000000 s");
}

void check_times(const Phones& phones, const Timeline* timeline) {
  for (std::size_t k = 0; k < phones.phones.size(); ++k) {
    check_time(phones.phones[k].start_s, message("the start of phones element ", k));
    check_time(phones.phones[k].end_s, message("the end of phones element ", k));
  }
  check_time(phones.duration_s, "the end of phones");
  if (!timeline) return;
  for (std::size_t f = 0; f < timeline->time_s.size(); ++f)
    check_time(timeline->time_s[f], message("timeline frame ", f));
  check_time(timeline->duration_s, "the end of timeline");
}

}  // namespace

PerformResult perform(const Phones& phones, const Timeline* timeline, const Rig* rig, const std::string* take,
                      engine::SeqWriter<Weights>& weights, engine::SeqWriter<RigidMotion>& world_from_head,
                      const PerformOptions& options) {
  check_options(options);
  check_times(phones, timeline);
  PerformResult result;
  result.timeline = timeline ? *timeline : make_timeline(phones.duration_s, options.rate_hz);
  const SpeakerStyle style = speaker_style(options.seed, options.style);
  const Articulator articulator(phones, style);
  const MouthContacts contacts(rig);
  // Events are drawn up to the end of the speech, whatever part of it the timeline shows; a later end only adds to
  // them.
  const double end_s = std::max(phones.duration_s, result.timeline.duration_s);
  const Liveliness liveliness(phones, end_s, person_seed(options.seed, take),
                              {options.brows, options.gaze, options.head_motion});
  const Vector3 pivot = find_pivot(rig);
  result.closure_count = static_cast<std::int64_t>(articulator.closure_count());
  result.labiodental_count = static_cast<std::int64_t>(articulator.labiodental_count());
  result.labiodental_distance_mm = contacts.lip_teeth().distance_mm;
  for (const double time_s : result.timeline.time_s) {
    Pose pose;
    Life life = liveliness.at(time_s);
    life.yaw_deg += options.turn_deg * std::sin(2 * std::numbers::pi * time_s / options.turn_s);
    pose_mouth(articulator.at(time_s), style, contacts, options.strength, pose);
    pose_rest(life, options.blink, options.gaze, pose);
    weights.push(pose.weights());
    world_from_head.push(head_motion(life, pivot));
  }
  return result;
}

}  // namespace face::phantom
