// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/albedo_map.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/image.h"
#include "nodes/types/morphable_model.h"

namespace face::model {

struct TrackVideoOptions {
  std::int64_t expressions = 40;  // leading components that move; the paper: 4
  std::int64_t points = 1500;     // random pixels per step
  std::int64_t steps = 4;         // at the largest size; 1.5 times as many at the middle, 5 at the smallest
  double image_weight = 1200;     // how many independent points a frame counts as
  double change_sigma = 0.6;      // of a coefficient from frame to frame, over its own sigma
  double turn_sigma_deg = 1.2;    // of the head from frame to frame
  double max_image_rms = 0.15;    // difference of frame and model above which a frame is not believed
  double min_likeness = 0.6;      // of frame and face (likeness.h) below which a frame is not believed
  double shading_sigma = 0.05;    // of what no light of one direction explains, a share of the scale
  std::int64_t seed = 1;
};

struct TrackVideoResult {
  FaceFit fit;
};

// Follows a head and its mouth through a video: each frame starts from the one before, which is also the centre of the
// prior; identity, colours, light and focal length are the start's; the frame's size grows (Blanz, Basso, Poggio,
// Vetter: Reanimating Faces in Images and Video, Eurographics 2003, section 4.1). Differs from the paper: Gauss-Newton
// steps, robust weights, harmonics of the normal for light that the model does not know; lids are left out, and many
// components move, because what they do not explain of brows and mouths turns the head; colours are as fine as the
// picture, without the dark line between lips once they have parted; and a frame that does not look like the face says
// so and leaves pose and expression as they were. start: the fit of the first frame, or of one near it. albedo: the
// face's own colours, of texture.extract. picture: what start was fitted on; null: colours are the albedo's, at
// vertices alone.
TrackVideoResult track_video(const MorphableModel& model, const Image& frame, const FaceFit& start,
                             const AlbedoMap& albedo, const Image* picture,
                             const engine::Prior<TrackVideoResult>& prior, const TrackVideoOptions& options = {});

}  // namespace face::model
