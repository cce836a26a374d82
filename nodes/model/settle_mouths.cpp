// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/settle_mouths.h"

#include <algorithm>
#include <cstddef>

#include "nodes/model/fit_landmarks.h"
#include "nodes/model/mouth_cost.h"

namespace face::model {
namespace {

constexpr double narrow_gap_mm = 4;     // up to which an open mouth is doubted
constexpr double line_mm = 1.5;         // up to which nothing is seen between lips but the dark line where they meet
constexpr double closed_excess = 1.06;  // of the cost of a closed mouth over that of the open one, to be believed
constexpr double line_excess = 1.1;     // the same where there is no more than that line, or lips beyond doubt, between
// Photographs of closed mouths come out at 0.10 to 0.45, of open ones at 0.58 and more.
constexpr double lips_for_sure = 0.25;          // up to which it is nothing but lips; half of the closed ones
constexpr double lips_seen = 0.5;               // mouth_cost up to which what is between the lips is lips
constexpr double tried_gaps_mm[] = {4, 8, 12};  // of a closed mouth that is tried open
constexpr double wider_share = 0.98;            // of the cost of the narrower one, to be believed

// Twice what opens a mouth by its points alone: here pixels have spoken.
double points_allow() { return 2 * FitLandmarksOptions{}.mouth_evidence; }

void close_mouths(const std::vector<PictureLevel>& levels, const std::function<void(Joint&)>& run_steps, Joint& joint) {
  Joint closed = joint;
  bool any = false;
  std::vector<bool> is_line;
  for (std::size_t m = 0; m < closed.pictures.size(); ++m) {
    const double gap = gap_of(closed, m);
    closed.pictures[m].closed = gap < narrow_gap_mm;
    is_line.push_back(gap < line_mm);
    any = any || closed.pictures[m].closed;
  }
  if (!any) return;
  run_steps(closed);
  for (std::size_t m = 0; m < joint.pictures.size(); ++m) {
    if (!closed.pictures[m].closed) continue;
    const double between = mouth_cost(joint, closed, m, levels[m]);
    const double excess = is_line[m] || between < lips_for_sure ? line_excess : closed_excess;
    if (image_cost(closed, m, levels[m]) > excess * image_cost(joint, m, levels[m]) ||
        (!is_line[m] && between > lips_seen) || point_cost(closed, m) > point_cost(joint, m) + points_allow())
      return;
  }
  joint = std::move(closed);
}

// Adds the likeliest expression that opens the lips by so much on average, and holds them there.
void hold_open(double gap_mm, std::size_t index, Joint& joint) {
  Picture& picture = joint.pictures[index];
  const std::vector<double> mean = mean_gap_row(joint);
  const std::vector<float>& sigmas = joint.model->expression.sigmas;
  const double missing = gap_mm - gap_of(joint, index);
  double strength = 0;
  for (std::size_t k = 0; k < mean.size(); ++k) strength += mean[k] * mean[k] * sigmas[k] * sigmas[k];
  if (strength <= 0) return;
  for (std::size_t k = 0; k < mean.size(); ++k)
    picture.state.expression[k] += missing * mean[k] * sigmas[k] * sigmas[k] / strength;
  picture.closed = false;
  picture.held_gap_mm = gap_mm;
}

void open_mouth(const std::vector<PictureLevel>& levels, const std::function<void(Joint&)>& run_steps,
                std::size_t index, Joint& joint) {
  const double points = point_cost(joint, index);
  double best = image_cost(joint, index, levels[index]);
  Joint chosen = joint;
  for (const double gap_mm : tried_gaps_mm) {
    Joint open = joint;
    hold_open(gap_mm, index, open);
    if (mouth_cost(open, joint, index, levels[index]) <= lips_seen) continue;
    run_steps(open);
    const double cost = image_cost(open, index, levels[index]);
    if (cost >= wider_share * best || point_cost(open, index) > points + points_allow()) continue;
    best = cost;
    chosen = std::move(open);
  }
  const double held_mm = chosen.pictures[index].held_gap_mm;
  if (held_mm > 0) {
    Joint free = chosen;
    free.pictures[index].held_gap_mm = 0;
    run_steps(free);
    if (gap_of(free, index) > 0.5 * held_mm) chosen = std::move(free);
  }
  joint = std::move(chosen);
}

}  // namespace

void settle_mouths(const std::vector<PictureLevel>& levels, const std::function<void(Joint&)>& run_steps,
                   Joint& joint) {
  if (joint.gaps.empty() || joint.basis.expressions == 0) return;
  close_mouths(levels, run_steps, joint);
  for (std::size_t m = 0; m < joint.pictures.size(); ++m)
    if (gap_of(joint, m) < narrow_gap_mm) open_mouth(levels, run_steps, m, joint);
}

}  // namespace face::model
