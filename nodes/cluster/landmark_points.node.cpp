// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/landmark_points.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::cluster;

NODE("cluster.landmark_points", &landmark_points, version{1},
     doc{"Puts the landmarks of all frames that have not lost too many into a matrix."},
     input{"tracks", "Landmarks of every frame"},
     param("max_lost", &LandmarkPointsOptions::max_lost, range{0, 1000}, unit{"1"},
           "So many landmarks of a frame may be lost: they count where the tracker has left them"),
     output("points", &LandmarkPointsResult::points, "One row per frame: x and y of every landmark"),
     output("frames", &LandmarkPointsResult::frames, "Position of each of these frames in the sequence"));
