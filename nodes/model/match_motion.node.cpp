// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/match_motion.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.match_motion", &match_motion, version{1},
     doc{"A surface's vertices in a scan of another head, by the most probable smooth motion: for skin without spots, "
         "where flow has nothing to follow."},
     input{"surface", "The reference surface, its mouth shut (model.scan_template)"},
     input{"reference", "The scan that it was cut from"},
     input{"start", "Where to begin (model.closest_combination); without it the surface itself"},
     input{"target", "The scan"},
     param("motion_mm", &MatchMotionOptions::motion_mm, range{0.01, 100.0}, unit{"mm"},
           "Standard deviation of how far places of heads lie apart, along each axis"),
     param("asymmetry", &MatchMotionOptions::asymmetry, range{0.0, 10.0}, unit{"1"},
           "How large motion is that is not mirrored, relative to that; 0 = none"),
     param("functions", &MatchMotionOptions::functions, range{1, 1000}, unit{"1"},
           "Smooth functions of a kind, even and odd, at most"),
     param("surface_mm", &MatchMotionOptions::surface_mm, range{0.01, 100.0}, unit{"mm"},
           "Distance from the scan that counts as one deviation"),
     param("colour_scale", &MatchMotionOptions::colour_scale, range{0.01, 10000.0}, unit{"1"},
           "Difference of colour about features, in steps of 8 bits, that does"),
     param("feature_reach_mm", &MatchMotionOptions::feature_reach_mm, range{0.0, 100.0}, unit{"mm"},
           "How far about the marks of brows, eyes and mouth colours count"),
     param("curvature", &MatchMotionOptions::curvature, range{0.001, 1000.0}, unit{"1"},
           "Difference of mean curvature times its scale that does"),
     param("curvature_scale_mm", &MatchMotionOptions::curvature_scale_mm, range{0.1, 100.0}, unit{"mm"},
           "Smoothing before curvature is taken"),
     output("shape", &MatchMotionResult::shape, "The skin's vertices in the scan"),
     output("texture", &MatchMotionResult::texture, "Their colours, one row"),
     output("sampled", &MatchMotionResult::sampled, "Share of the vertices that lie on what is measured"));
