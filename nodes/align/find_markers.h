// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/landmarks.h"

namespace face::align {

enum class MarkerTone { white, black };

struct FindMarkersOptions {
  MarkerTone tone = MarkerTone::white;
  double radius_px = 3;
  double least_contrast = 18;
};

// Finds painted dots on the first scan of a take: local extremes of the difference between a disc and the ring about
// it, round (all directions of the ring differ from the disc) and at least least_contrast grey levels strong, on
// measured surface, and not longer than a disc that is seen aslant; centres are those of measure_dot.h. Names are m0,
// m1, ... from the top. More than 250 are no painted dots: that is refused. scans: a take.
Landmarks find_markers(const engine::Seq<DepthScan>& scans, const FindMarkersOptions& options = {});

struct LinkMarkersOptions {
  double tolerance_px = 18;
};

// Names the markers of a take as those of a reference constellation: of all shifts that bring one marker onto one of
// the reference the one that brings most together is taken, then a similarity of the plane is fitted to the pairs and
// paired again (iterative closest points: Besl and McKay, PAMI 1992), and each takes the name of the nearest reference
// marker within tolerance_px that has no nearer one. Markers without a partner are left out.
Landmarks link_markers(const Landmarks& markers, const Landmarks& reference, const LinkMarkersOptions& options = {});

// The constellation whose names all takes get: the first of those with the most markers.
Landmarks first_layout(const engine::Seq<Landmarks>& layouts);

}  // namespace face::align
