// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/draw_landmarks.h"

#include "engine/node.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
using namespace engine::declare;
using namespace face::render;

NODE("render.draw_landmarks", &draw_landmarks, version{2},
     doc{"Draws points over a picture: a green dot where a point is tracked, a red ring where it is lost."},
     input{"frame", "The picture"}, input{"landmarks", "Its points"},
     param("radius_px", &DrawLandmarksOptions::radius_px, range{0.5, 100}, unit{"px"},
           "Radius of a dot in a picture of up to 640 px; in larger ones it grows with them"),
     output("image", "The picture with its points"));
