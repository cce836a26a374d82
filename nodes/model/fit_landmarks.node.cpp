// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/fit_landmarks.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.fit_landmarks", &fit_landmarks, version{1},
     doc{"Pose, focal length, identity and expression from named points of a picture alone."},
     input{"model", "The morphable model"}, input{"landmarks", "Named points on the picture, at least six"},
     input{"picture", "The picture; only its size counts"},
     param("identities", &FitLandmarksOptions::identities, range{0, 1000}, unit{"1"}, "Identity components used"),
     param("expressions", &FitLandmarksOptions::expressions, range{0, 1000}, unit{"1"}, "Expression components used"),
     param("point_sigma", &FitLandmarksOptions::point_sigma, range{0.001, 0.5}, unit{"1"},
           "Error of a placed point over the distance of the outer corners of the eyes"),
     param("focal_share", &FitLandmarksOptions::focal_share, range{0.3, 30}, unit{"1"},
           "Likeliest focal length over the larger side of the picture"),
     param("focal_sigma", &FitLandmarksOptions::focal_sigma, range{0.001, 3}, unit{"1"}, "Spread of its logarithm"),
     param("mouth_evidence", &FitLandmarksOptions::mouth_evidence, range{0, 1000}, unit{"1"},
           "By how much the squared errors, in sigmas, must fall for an open mouth to be believed"),
     param("max_nme", &FitLandmarksOptions::max_nme, range{0.001, 1}, unit{"1"},
           "Mean error of the points over the eye distance above which a fit is not believed"),
     param("max_turn_deg", &FitLandmarksOptions::max_turn_deg, range{0, 180}, unit{"deg"},
           "Turn of the head above which a fit is not believed"),
     param("iterations", &FitLandmarksOptions::iterations, range{1, 1000}, unit{"1"}, "Steps at most"),
     output("fit", "The fit"));
