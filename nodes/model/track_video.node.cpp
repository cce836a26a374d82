// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/track_video.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.track_video", &track_video, version{9},
     doc{"Follows a fitted head and its mouth through a video, frame by frame, by what it looks like."},
     input{"model", "The morphable model"}, input{"frame", "The video's frames"},
     input{"start", "The fit of the first frame"}, input{"albedo", "The face's colours, of texture.extract"},
     input{"picture",
           "What start was fitted on; unconnected: colours are the albedo's alone, and lips are followed worse"},
     param("expressions", &TrackVideoOptions::expressions, range{0, 1000}, unit{"1"}, "Leading components that move"),
     param("points", &TrackVideoOptions::points, range{50, 100000}, unit{"1"}, "Random pixels per step"),
     param("steps", &TrackVideoOptions::steps, range{1, 1000}, unit{"1"},
           "Steps at the largest of three sizes; 1.5 times as many at the middle one, 5 at the smallest"),
     param("image_weight", &TrackVideoOptions::image_weight, range{0, 1000000}, unit{"1"},
           "How many independent points a frame counts as"),
     param("change_sigma", &TrackVideoOptions::change_sigma, range{0.001, 100}, unit{"1"},
           "Change of a coefficient from frame to frame, over its own sigma"),
     param("turn_sigma_deg", &TrackVideoOptions::turn_sigma_deg, range{0.001, 180}, unit{"deg"},
           "Turn of the head from frame to frame"),
     param("shading_sigma", &TrackVideoOptions::shading_sigma, range{0.000001, 1}, unit{"1"},
           "Of what no light of one direction explains, a share of the scale"),
     param("max_image_rms", &TrackVideoOptions::max_image_rms, range{0.001, 1}, unit{"1"},
           "Difference of frame and model above which a frame is not believed"),
     param("min_likeness", &TrackVideoOptions::min_likeness, range{-1, 1}, unit{"1"},
           "Correlation of frame and face below which a frame is not believed",
           inert{"where the frame differs too much in brightness already"}),
     param("seed", &TrackVideoOptions::seed, range{0, 1000000000}, unit{"1"}, "Of the random pixels"),
     output("fit", &TrackVideoResult::fit, "The fit of each frame"));
