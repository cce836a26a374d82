// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

#include "nodes/trajectory/gaussian_trajectory.h"
#include "nodes/types/phones.h"
#include "nodes/types/visemes.h"

namespace face::trajectory {

// How a phone's length changes its pull. none: a frame pulls as the table says. utterance: by 1 - length / utterance,
// as Ezzat 2002 has it (hardly different from none for a real sentence). duration: by 100 ms / length, so that every
// phone pulls equally as a whole and short ones are reached as well as long ones.
enum class Normalise { none, utterance, duration };

struct SpeechTargetsOptions {
  double rate_hz = 60;
  double strength = 1;  // multiplies the targets; below 1 mumbles, above 1 over-articulates
  Normalise normalise = Normalise::none;
};

enum class ContactKind {
  lips,   // the lips meet
  teeth,  // the lower lip meets the upper teeth
  open    // the lips stay open_mm apart
};

// Frames in which something must hold.
struct Contact {
  ContactKind kind = ContactKind::lips;
  std::size_t phone = 0;
  std::vector<std::size_t> frames;  // at least one
  double open_mm = 0;
};

// Frame i is shown at i / rate_hz. As many as start before the end of the speech, at least one.
std::size_t frame_count(const Phones& phones, double rate_hz);

// Row of the table for a label; a half that the table lacks ("CH.c") is its phone. Throws where there is neither.
const Viseme& find_viseme(const Visemes& visemes, const std::string& label, std::size_t phone);

// frames x 52: every frame is pulled by the phones within half a frame of it, by their share. Precision is 1 / sigma^2.
TrajectoryTargets speech_targets(const Phones& phones, const Visemes& visemes, const SpeechTargetsOptions& options);

// Contacts in the order of the speech. A phone shorter than a frame acts at the frame nearest to its middle.
std::vector<Contact> find_contacts(const Phones& phones, const Visemes& visemes, double rate_hz);

}  // namespace face::trajectory
