// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/speak.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/trajectory/bounded_trajectory.h"
#include "nodes/trajectory/mouth_bounds.h"
#include "nodes/types/arkit.h"

namespace face::trajectory {
namespace {

constexpr double reference_rate_hz = 30;
constexpr double quantum = 1.0 / 4096;
// A contact bends the curve over about 60 ms to either side; beyond this time what is left of it is below the quantum.
constexpr double reach_s = 0.4;
// No weight goes faster than this, per second (0.22 per frame at 60 Hz), unless a closure could not be made otherwise.
constexpr double largest_change_hz = 13.2;
constexpr double step_price = 3000;
// Linearisations of the lip-teeth distance; two or three are the rule.
constexpr int most_passes = 8;

struct FrameRange {
  std::size_t first, end;
};

// All frames' weights and what is asked of them.
struct Speech {
  const TrajectoryTargets& targets;
  double smoothness;
  StepBound steps;
  const MouthBounds& mouth;
  const std::vector<Contact>& contacts;
  std::vector<double> values;  // frames x 52

  std::vector<double> frame(std::size_t index) const {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(index * arkit_count);
    return {first, first + static_cast<std::ptrdiff_t>(arkit_count)};
  }
};

// Solves the shapes that go too fast once more, each by itself, as slowly as they must.
void bound_steps(Speech& speech) {
  const std::size_t frames = speech.targets.frames;
  for (std::size_t s = 0; s < arkit_count; ++s) {
    double fastest = 0;
    for (std::size_t i = arkit_count + s; i < speech.values.size(); i += arkit_count)
      fastest = std::max(fastest, std::abs(speech.values[i] - speech.values[i - arkit_count]));
    if (fastest <= speech.steps.largest) continue;
    TrajectoryTargets shape{frames, 1, {}, {}};
    for (std::size_t i = s; i < speech.values.size(); i += arkit_count) {
      shape.precision.push_back(speech.targets.precision[i]);
      shape.target.push_back(speech.targets.target[i]);
    }
    const BoundedTrajectory solved = solve_bounded_trajectory(shape, speech.smoothness, {}, {}, speech.steps);
    for (std::size_t i = 0; i < frames; ++i) speech.values[i * arkit_count + s] = solved.values[i];
  }
}

// Frames in which the free curve may break a bound, grown by reach_s and merged: pieces that do not know of each other,
// so that a change in one leaves the others as they are, bit for bit.
std::vector<FrameRange> find_pieces(const Speech& speech, double rate_hz) {
  const std::size_t frames = speech.targets.frames;
  std::vector<bool> bound(frames, false);
  for (const Contact& contact : speech.contacts)
    for (const std::size_t frame : contact.frames) bound[frame] = true;
  for (std::size_t i = 0; i < frames; ++i)
    if ((speech.mouth.has_lips() && speech.mouth.gap(speech.frame(i)).min_mm < 0) ||
        (speech.mouth.has_teeth() && !speech.mouth.teeth_hold(speech.frame(i), false)))
      bound[i] = true;
  const auto reach = static_cast<std::size_t>(std::ceil(reach_s * rate_hz));
  std::vector<FrameRange> pieces;
  for (std::size_t i = 0; i < frames; ++i) {
    if (!bound[i]) continue;
    const std::size_t first = i > reach ? i - reach : 0, end = std::min(frames, i + reach + 1);
    if (!pieces.empty() && first <= pieces.back().end)
      pieces.back().end = end;
    else
      pieces.push_back({first, end});
  }
  return pieces;
}

// The correctors' part of some frames as a problem of its own, tied to the frames before and after.
struct PieceProblem {
  TrajectoryTargets targets;
  TrajectoryEnds ends;
};

PieceProblem cut_piece(const Speech& speech, const FrameRange& piece) {
  const std::vector<std::size_t>& correctors = speech.mouth.correctors();
  PieceProblem problem;
  problem.targets.frames = piece.end - piece.first;
  problem.targets.dims = correctors.size();
  for (std::size_t i = piece.first; i < piece.end; ++i)
    for (const std::size_t s : correctors) {
      problem.targets.precision.push_back(speech.targets.precision[i * arkit_count + s]);
      problem.targets.target.push_back(speech.targets.target[i * arkit_count + s]);
    }
  for (const std::size_t s : correctors) {
    if (piece.first > 0) problem.ends.before.push_back(speech.values[(piece.first - 1) * arkit_count + s]);
    if (piece.end < speech.targets.frames) problem.ends.after.push_back(speech.values[piece.end * arkit_count + s]);
  }
  return problem;
}

// The bounds of a piece that are linear in the weights, and for each of its frames whether the lower lip is to meet the
// teeth. Lips win where phones are so short that they share a frame with teeth.
struct PieceBounds {
  std::vector<FrameBound> lips;
  std::vector<bool> touch;
};

PieceBounds bounds_of(const Speech& speech, const FrameRange& piece) {
  const MouthBounds& mouth = speech.mouth;
  PieceBounds bounds;
  std::vector<bool> closed(piece.end - piece.first, false);
  bounds.touch = closed;
  for (std::size_t i = piece.first; i < piece.end; ++i) mouth.keep_apart(i - piece.first, speech.frame(i), bounds.lips);
  for (const ContactKind kind : {ContactKind::lips, ContactKind::open, ContactKind::teeth})
    for (const Contact& contact : speech.contacts) {
      if (contact.kind != kind || contact.frames.front() < piece.first || contact.frames.front() >= piece.end) continue;
      for (const std::size_t i : contact.frames) {
        const std::size_t local = i - piece.first;
        if (kind == ContactKind::lips) {
          mouth.close(local, speech.frame(i), bounds.lips);
          closed[local] = true;
        } else if (kind == ContactKind::open && !closed[local]) {
          mouth.open(local, speech.frame(i), contact.open_mm, bounds.lips);
        } else if (kind == ContactKind::teeth && !closed[local]) {
          bounds.touch[local] = true;
        }
      }
    }
  return bounds;
}

void solve_piece(Speech& speech, const FrameRange& piece) {
  const PieceProblem problem = cut_piece(speech, piece);
  const std::vector<std::size_t>& correctors = speech.mouth.correctors();
  const PieceBounds linear = bounds_of(speech, piece);
  // The teeth's bounds of every frame, linearised where the frame is; renewed where they do not hold afterwards, and
  // only there: what holds already must not move because of a contact a minute away.
  std::vector<std::vector<FrameBound>> teeth(piece.end - piece.first);
  std::vector<bool> stale = linear.touch;
  const bool with_teeth = speech.mouth.has_teeth();
  for (int pass = 0; pass < most_passes; ++pass) {
    std::vector<FrameBound> bounds = linear.lips;
    for (std::size_t j = 0; with_teeth && j < teeth.size(); ++j) {
      if (stale[j]) {
        teeth[j].clear();
        speech.mouth.bound_teeth(j, speech.frame(piece.first + j), linear.touch[j], teeth[j]);
      }
      bounds.insert(bounds.end(), teeth[j].begin(), teeth[j].end());
    }
    const BoundedTrajectory solved =
        solve_bounded_trajectory(problem.targets, speech.smoothness, bounds, problem.ends, speech.steps);
    for (std::size_t i = piece.first; i < piece.end; ++i)
      for (std::size_t k = 0; k < correctors.size(); ++k)
        speech.values[i * arkit_count + correctors[k]] = solved.values[(i - piece.first) * correctors.size() + k];
    if (!with_teeth) break;
    for (std::size_t j = 0; j < stale.size(); ++j)
      stale[j] = !speech.mouth.teeth_hold(speech.frame(piece.first + j), linear.touch[j]);
    if (std::find(stale.begin(), stale.end(), true) == stale.end()) break;
  }
}

void measure(const Speech& speech, SpeakResult& result) {
  const MouthBounds& mouth = speech.mouth;
  constexpr MouthLimits limits;
  if (mouth.has_lips())
    for (std::size_t i = 0; i < speech.targets.frames; ++i)
      result.deepest_overlap_mm = std::max(result.deepest_overlap_mm, -mouth.gap(speech.frame(i)).min_mm);
  result.contact_count = static_cast<std::int64_t>(speech.contacts.size());
  for (const Contact& contact : speech.contacts) {
    const bool lips = contact.kind != ContactKind::teeth;
    if (lips ? !mouth.has_lips() : !mouth.has_teeth()) {
      ++result.missed_count;
      continue;
    }
    double best_mm = 1e9;
    for (const std::size_t i : contact.frames)
      best_mm = std::min(best_mm, lips ? mouth.gap(speech.frame(i)).mean_mm : mouth.teeth_mm(speech.frame(i)));
    bool holds = best_mm >= contact.open_mm - limits.tolerance_mm;
    if (contact.kind == ContactKind::lips) {
      result.worst_closure_mm = std::max(result.worst_closure_mm, best_mm);
      holds = best_mm <= limits.closed_mm + limits.tolerance_mm;
    } else if (contact.kind == ContactKind::teeth) {
      result.worst_teeth_mm = std::max(result.worst_teeth_mm, best_mm);
      holds = std::any_of(contact.frames.begin(), contact.frames.end(),
                          [&](std::size_t i) { return mouth.teeth_hold(speech.frame(i), true); });
    }
    if (!holds) ++result.missed_count;
  }
}

}  // namespace

SpeakResult speak(const Phones& phones, const Visemes& visemes, const Rig& rig, engine::SeqWriter<Weights>& weights,
                  const SpeakOptions& options) {
  check(options.rate_hz > 0, "rate_hz is ", options.rate_hz, ", expected more than 0");
  const TrajectoryTargets targets =
      speech_targets(phones, visemes, {options.rate_hz, options.strength, options.normalise});
  const std::vector<Contact> contacts = find_contacts(phones, visemes, options.rate_hz);
  const MouthBounds mouth(rig);
  const double smoothness = smoothness_at(options.smoothness, reference_rate_hz, options.rate_hz);
  const StepBound steps{largest_change_hz / options.rate_hz, step_price};
  Speech speech{targets, smoothness, steps, mouth, contacts, solve_trajectory(targets, smoothness)};
  bound_steps(speech);
  for (const FrameRange& piece : find_pieces(speech, options.rate_hz)) solve_piece(speech, piece);
  for (double& value : speech.values) value = std::clamp(std::round(value / quantum) * quantum, 0.0, 1.0);

  SpeakResult result;
  measure(speech, result);
  for (std::size_t i = 0; i < targets.frames; ++i) {
    const std::vector<double> frame = speech.frame(i);
    weights.push(Weights{{frame.begin(), frame.end()}});
    result.timeline.time_s.push_back(static_cast<double>(i) / options.rate_hz);
  }
  result.timeline.duration_s = static_cast<double>(targets.frames) / options.rate_hz;
  return result;
}

}  // namespace face::trajectory
