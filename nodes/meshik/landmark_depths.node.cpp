// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/landmark_depths.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::meshik;

NODE("meshik.landmark_depths", &landmark_depths, version{2},
     doc{"How far the landmarks of a face lie towards the viewer, by a rig: for taking turns and nods out of tracks."},
     input{"rig", "A head"}, input{"neutral", "The landmarks at rest"},
     output("depths_px", "N x 1, in the pixels of the landmarks"));
