// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <vector>

#include "nodes/track/patch.h"
#include "nodes/track/settle.h"

namespace face::track {

// Two frames, ready for following points from one to the other and back by pyramidal KLT (Lucas and Kanade, An
// Iterative Image Registration Technique, IJCAI 1981; Bouguet, Pyramidal Implementation of the Lucas Kanade Feature
// Tracker, Intel 2000).
class FlowPair {
 public:
  // side_px: of the patch that is followed; levels: of the pyramid, above the image itself.
  FlowPair(const Grey& before, const Grey& now, int side_px, int levels);
  ~FlowPair();

  // Points of the earlier frame in the later one, from guesses; and back. As surely seen as the given points are; those
  // that were not found, or outside the frame, not at all. sides_px: of each point's own patch: those smaller than the
  // constructor's side are followed with that first, and from there with their own.
  std::vector<Sighting> forth(const std::vector<Sighting>& points, const std::vector<Sighting>& guesses,
                              const std::vector<int>& sides_px) const;
  std::vector<Sighting> back(const std::vector<Sighting>& points, const std::vector<Sighting>& guesses,
                             const std::vector<int>& sides_px) const;

 private:
  struct Pyramids;
  std::unique_ptr<Pyramids> pyramids_;
};

// How surely a place can be told by the picture around it: the mean outer product of its gradients over the variance of
// grey values between frames, as eigenvalues e + e^2. The square makes strong contrast all but decide over the springs,
// and leaves weak contrast to them.
void add_information(const Grey& grey, int side_px, Sighting& place);

inline bool is_inside(double x_px, double y_px, int width, int height) {
  return x_px >= -0.5 && y_px >= -0.5 && x_px <= width - 0.5 && y_px <= height - 0.5;
}

}  // namespace face::track
