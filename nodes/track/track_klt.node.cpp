// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/track_klt.h"

#include "engine/node.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"
using namespace engine::declare;
using namespace face::track;

NODE("track.klt", &track_klt, version{13},
     doc{"Follows points on a face through a video by pyramidal KLT, with a check that they come home, anchors against "
         "drift, and the edge of the lips."},
     input{"frames", "The video's frames", window{1, 0}}, input{"start", "The points on the first frame"},
     input{"correction", "Points put right, for frames that have some"},
     param("window_px", &TrackKltOptions::window_px, range{5, 101}, unit{"px"},
           "Side of the patch that is followed, odd; a point that stands out by itself takes a smaller part of it"),
     param("levels", &TrackKltOptions::levels, range{0, 8}, unit{"1"}, "Pyramid levels above the image"),
     param("stiffness", &TrackKltOptions::stiffness, range{0, 1000}, unit{"1/px^2"},
           "Of the springs that keep neighbours together; 0 follows every point alone"),
     param("max_return_error_px", &TrackKltOptions::max_return_error_px, range{0.01, 100}, unit{"px"},
           "Largest error of a point that was followed there and back"),
     param("max_offset_px", &TrackKltOptions::max_offset_px, range{0.01, 100}, unit{"px"},
           "Largest distance of a point from where its neighbours say that it is"),
     param("min_likeness", &TrackKltOptions::min_likeness, range{0, 0.99}, unit{"1"},
           "Correlation with its own patch that counts as seeing a point again"),
     param("max_anchor_px", &TrackKltOptions::max_anchor_px, range{0, 100}, unit{"px"},
           "How far a point may be moved to its own patch"),
     param("rigid", &TrackKltOptions::rigid,
           "Names of points that go with the head alone; lost where neither they nor the head are seen"),
     param("search_px", &TrackKltOptions::search_px, range{0, 200}, unit{"px"}, "How far a lost point is looked for"),
     param("outline", &TrackKltOptions::outline,
           "Names of the points on the outer edge of the lips, from one corner around; none = no lips are sought"),
     param("jaw_line", &TrackKltOptions::jaw_line,
           "Names of the points on the contour of the chin, from one side to the other; sought where all are there"),
     param("edge_reach_px", &TrackKltOptions::edge_reach_px, range{1, 30}, unit{"px"},
           "How far from where it is expected the edge of the lips is looked for"),
     param("smallest_mouth_px", &TrackKltOptions::smallest_mouth_px, range{1, 10000}, unit{"px"},
           "Pictures with a narrower mouth are made larger first; all other lengths count in what is then a pixel"),
     param("tracked_mouth_px", &TrackKltOptions::tracked_mouth_px, range{10, 10000}, unit{"px"},
           "How wide the mouth is then"),
     param("largest_mouth_px", &TrackKltOptions::largest_mouth_px, range{10, 10000}, unit{"px"},
           "Pictures with a wider mouth are made smaller first"),
     param("fine_detail", &TrackKltOptions::fine_detail, range{0.0, 1.0}, unit{"1"},
           "So are pictures that would lose less of their contrast by it"),
     output("landmarks", &TrackKltResult::landmarks, "The points of each frame"),
     output("followed", &TrackKltResult::followed, "The points as if nobody had put anything right"),
     output("put_right", &TrackKltResult::put_right, "The points that corrections placed, by name"),
     output("layout", &TrackKltResult::layout, "How the points lie to each other at rest"),
     output("look", &TrackKltResult::look, "What the edge of the lips looks like where it was placed"),
     output("coarse_look", &TrackKltResult::coarse_look, "The same in a smaller picture, for wide mouths"),
     output("jaw_look", &TrackKltResult::jaw_look, "What the contour of the chin looks like where it was placed"),
     output("patches", &TrackKltResult::patches, "Every point's own patch, side by side"),
     output("face", &TrackKltResult::face, "What is looked for when everything was lost"),
     output("head_look", &TrackKltResult::head_look, "What is between brows and nose at the start"),
     output("head", &TrackKltResult::head,
            "The head's pose since the start, 7 x 1: nod, turn, tilt (rad), log of the scale, place (px), likeness (0: "
            "not seen)"),
     output("face_colours", &TrackKltResult::face_colours, "What light is told by, as it looks at the start"),
     output("light", &TrackKltResult::light,
            "Gain and offset that take red, green and blue (rows) to the light of the start"),
     output("confidence", &TrackKltResult::confidence, "Of each point: 0 lost, 1 looks as where it was placed"),
     output("state", &TrackKltResult::state, "start, followed, found, cut, even or lost"),
     output("valid", &TrackKltResult::valid, "False where the face is not seen"),
     output("lost", &TrackKltResult::lost, "Number of points that are not valid"),
     output("return_error_px", &TrackKltResult::return_error_px, "Largest there-and-back error of the kept points"),
     output("shrunk", &TrackKltResult::shrunk,
            "How many pixels of the picture are one of that in which the points were followed"));
