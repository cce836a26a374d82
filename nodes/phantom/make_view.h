// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "nodes/types/camera.h"
#include "nodes/types/lighting.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/weights.h"

namespace face::phantom {

struct MakeViewOptions {
  int width_px = 640;
  int height_px = 480;
  double turn_deg = 40;       // the head is turned by up to this to either side
  double nod_deg = 8;         // and tilted by up to this up or down
  double nearest_mm = 700;    // of the camera to the head, with a lens that makes the face about as large
  double farthest_mm = 1100;  // as nearest_mm: always this distance
  double light_turn_deg = 60;
  double open_share = 1.0 / 3.0;  // of the persons with an open mouth
  std::int64_t seed = 1;
};

struct MakeViewResult {
  RigidMotion world_from_head;
  Camera camera;
  Lighting lighting;
  Weights weights;
};

// A picture of a person as somebody might take it, drawn by lot: where the head looks, how far away the camera stands,
// where the light comes from, how strong and how warm it is, and whether the mouth is open (jawOpen from 0.15 to 0.5).
// id: the picture's, where one node makes many (seq.ids). Throws where the rig has no jawOpen and a mouth is open.
MakeViewResult make_view(const Rig& rig, const std::string* id, const MakeViewOptions& options = {});

}  // namespace face::phantom
