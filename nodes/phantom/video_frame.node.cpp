// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/video_frame.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.video_frame", &video_frame, version{1}, cheap{},
     doc{"One frame of a video of a head under one parallel and one ambient light, with what a fit does not model: "
         "highlight, soft shadow, gamma, each with a switch. Quick to make again, so it is not stored."},
     input{"rig", "Head and its blend shapes"}, input{"weights", "Blend-shape weights of the frame"},
     input{"world_from_head", "Where the head is; unconnected: at rest"}, input{"camera", "Where it is seen from"},
     input{"lighting", "The light"}, input{"dots", "Markers, moles and freckles"},
     input{"backdrop", "Picture behind the head, of the frame's size"},
     input{"id", "The frame's id (seq.ids), which gives each frame its own noise"},
     param("width_px", &VideoFrameOptions::width_px, range{1, 4096}, unit{"px"}, "Width of the picture"),
     param("height_px", &VideoFrameOptions::height_px, range{1, 4096}, unit{"px"}, "Height of the picture"),
     param("samples", &VideoFrameOptions::samples, range{1, 4}, unit{"1"}, "Samples per pixel and axis"),
     param("highlight", &VideoFrameOptions::highlight, "Skin, lips and eyes mirror the parallel light"),
     param("shadow", &VideoFrameOptions::shadow,
           "Soft shadow of the parallel light, darkness in creases and in the mouth"),
     param("gamma", &VideoFrameOptions::gamma,
           "Light adds up as light and is then coded as sRGB; off: colours are multiplied as they are"),
     param("grain", &VideoFrameOptions::grain, range{0.0, 64.0}, unit{"1"},
           "Standard deviation of the sensor's noise, in steps of 8 bits; 0 switches it off"),
     param("seed", &VideoFrameOptions::seed, range{0, 1000000}, unit{"1"}, "Another seed is other noise"),
     output("image", "The frame"));
