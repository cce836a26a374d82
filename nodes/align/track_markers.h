// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "engine/port.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"

namespace face::align {

struct TrackMarkersOptions {
  std::int64_t template_px = 10;
  std::int64_t search_px = 20;
  double least_likeness = 0.6;
};

struct TrackMarkersResult {
  Landmarks markers;
  Image templates;     // grey: the start markers' squares side by side, as they were taken
  Matrix moved_px;     // markers x 2: how far each went since the frame before; 0 where it was or is lost
  Matrix bends;        // markers x 4: how its square lies now against when it was taken, rows of a 2 x 2 matrix
  std::string report;  // names of markers that are lost in this frame, separated by spaces; empty where none is
};

// Follows markers through a take by template matching (Bargmann, Blanz and Seidel, section 3.1): squares of 10 x 10
// pixels about the start points are found again in a neighbourhood of 20 x 20 pixels about the place to which they go
// on moving as they did, where the sum of squared differences, freed of gain and offset of light, is least. The search
// is over whole pixels, with exact sums; the place between pixels is found by Gauss-Newton steps on the same sum,
// together with how the square is stretched and sheared by skin that turns, with which the next frame's search begins.
// A marker whose template is unlike what is found (zero-mean normalised correlation below least_likeness), or that
// leaves the picture, is lost: not valid, at a guess, as far from its start as those about it; it is believed again
// where its likeness is 0.8. A warning names one that leaves the picture, in the frame in which it does. Painted dots
// look alike: a dot has one marker, the one that is more like it. That and any other that is unlike its template, or is
// not where those about it say, is looked for in twice the neighbourhood about where they say, beside the dots that are
// taken. Differs from the paper: light is taken out, since the dark side of a head that turns was lost to brighter
// places; the neighbourhood goes along with the marker, since a jaw falls farther from frame to frame than half of it;
// templates stay those of the first frame, so that errors do not add up. start: the points on the first frame of the
// take. correction: points put right on this frame, by name; the template is taken anew there. before: this node's
// result of the frame before.
TrackMarkersResult track_markers(const DepthScan& scan, const Landmarks& start, const Landmarks* correction,
                                 const engine::Prior<TrackMarkersResult>& before, const TrackMarkersOptions& options,
                                 engine::Progress& progress);

}  // namespace face::align
