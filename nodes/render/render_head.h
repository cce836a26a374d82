// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/render/camera.h"
#include "nodes/types/image.h"
#include "nodes/types/rig.h"
#include "nodes/types/weights.h"

namespace face::render {

enum class Framing { head, face };  // the whole head, or brows to chin

struct RenderHeadOptions {
  int width_px = 640;
  int height_px = 640;
  double yaw_deg = 0;               // the camera's place about the head; positive shows the head's left side
  double pitch_deg = 0;             // positive looks down from above
  double distance_mm = 0;           // from the middle of what is framed; 0 fills the picture with it
  Framing framing = Framing::head;  // what stands in the middle of the picture
  double field_of_view_deg = 20;    // vertical
  int samples = 2;                  // per pixel and axis
  double background_red = 0.17;     // sRGB
  double background_green = 0.19;
  double background_blue = 0.22;
};

// A picture of the head at given weights: the posed mesh with smooth normals under a soft portrait light from the
// front. Albedo is the part's times the vertex colour. Parts that are not visible are left out. Parts whose names hold
// "lash" are drawn half transparent; those of mouth, gums, tongue and teeth get the light that comes in between the
// lips. Same input, same picture, bit for bit.
Image render_head(const Rig& rig, const Weights& weights, const RenderHeadOptions& options = {});

// The camera that render_head uses: it is found from the neutral mesh, so it stands still while the face moves.
Camera head_camera(const Rig& rig, const RenderHeadOptions& options = {});

}  // namespace face::render
