// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/phones.h"
#include "nodes/types/timeline.h"

namespace face::transfer {

struct RestShapeOptions {
  std::string label = "SIL";
  double margin_s = 0.08;
};

// The neutral frame of viseme space: the mean of all frames that lie within segments of a label (silence), at least
// margin_s from their ends; where no frame does, of those anywhere within one. The paper selects a frame by eye
// (Bargmann, Blanz and Seidel, section 6); a mean has less noise. label: several with spaces between, a stop's for its
// closure, too; after a comma those that count where no frame shows any of the first: "P B M, SIL" is the shut mouth.
// shapes: of all frames; timeline: when they are shown; phones: what is said; known: false where a frame is lost
// (align.orient did not solve it); null = none is. Throws where none of the labels is said while a frame is shown.
MeshPoints rest_shape(const engine::Seq<MeshPoints>& shapes, const Timeline& timeline, const Phones& phones,
                      const engine::Seq<bool>* known, const RestShapeOptions& options = {});

}  // namespace face::transfer
