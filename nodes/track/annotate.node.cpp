// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/annotate.h"

#include "engine/node.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
using namespace engine::declare;
using namespace face::track;

NODE("track.annotate", &annotate, version{1},
     doc{"Makes a web page on which a person places points on a clip's first frame and puts them right on others."},
     input{"frames", "The clip"}, input{"tracks", "Where the points are, to be shown and put right"},
     input{"corrections", "Made before, to be saved with the new ones"},
     param("points", &AnnotateOptions::points, {{"lips18", PointLayout::lips18}, {"lips12", PointLayout::lips12}},
           "Which points: lips18 is eyes, nose, lips and jaw; lips12 the lips alone"),
     param("first_frame", &AnnotateOptions::first_frame, range{0, 10000000}, unit{"1"}, "First frame in the page"),
     param("every", &AnnotateOptions::every, range{1, 100000}, unit{"1"}, "Frames from one in the page to the next"),
     param("max_frames", &AnnotateOptions::max_frames, range{1, 5000}, unit{"1"}, "Most frames in the page",
           inert{"a cap: a shorter clip does not reach it"}),
     param("jpeg_quality", &AnnotateOptions::jpeg_quality, range{1, 100}, unit{"1"}, "Of the pictures in the page"),
     output("page", "The .html file"));
