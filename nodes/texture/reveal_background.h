// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/texture/continue_background.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/image.h"

namespace face::texture {

// What is behind the rim of a face in a frame of a video: pixels inside the mask that the face leaves free in the
// nearest of the frames around are copied from there (the paper looks 10 frames in either direction); the rest is
// continue_background's. The camera must stand still. frame, mask: with their neighbours, same length.
Image reveal_background(const engine::Window<Image>& frame, const engine::Window<Image>& mask, const FaceFit& fit,
                        const ContinueBackgroundOptions& options = {});

}  // namespace face::texture
