// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/make_camera.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.make_camera", &make_camera, version{1},
     doc{"A camera, or a scanner's projector, that looks at a point of the world from a distance."},
     param("width_px", &MakeCameraOptions::width_px, range{1, 8192}, unit{"px"}, "Width of its pictures"),
     param("height_px", &MakeCameraOptions::height_px, range{1, 8192}, unit{"px"}, "Height of its pictures"),
     param("distance_mm", &MakeCameraOptions::distance_mm, range{1.0, 100000.0}, unit{"mm"}, "From the point"),
     param("target_x_mm", &MakeCameraOptions::target_x_mm, range{-10000.0, 10000.0}, unit{"mm"},
           "The point that it looks at; a head at rest looks along z and its left is x"),
     param("target_y_mm", &MakeCameraOptions::target_y_mm, range{-10000.0, 10000.0}, unit{"mm"}, "Its height"),
     param("target_z_mm", &MakeCameraOptions::target_z_mm, range{-10000.0, 10000.0}, unit{"mm"}, "Its z"),
     param("yaw_deg", &MakeCameraOptions::yaw_deg, range{-180.0, 180.0}, unit{"deg"},
           "Place about the point; positive stands at the head's left"),
     param("pitch_deg", &MakeCameraOptions::pitch_deg, range{-89.0, 89.0}, unit{"deg"},
           "Place about the point; positive stands higher"),
     param("field_of_view_deg", &MakeCameraOptions::field_of_view_deg, range{1.0, 120.0}, unit{"deg"},
           "Vertical field of view"),
     output("camera", "The camera"));
