// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/fit_axis.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::align;

NODE("align.fit_axis", &fit_axis, version{1},
     doc{"The upright axis of a head about which a scan's radius varies least."}, input{"reference", "The scan"},
     param("tilt_stiffness", &FitAxisOptions::tilt_stiffness, range{0.0, 1e9}, unit{"mm^2/rad^2"},
           "How strongly the axis is kept upright"),
     output("axis", &FitAxisResult::axis, "The axis"),
     output("mean_radius_mm", &FitAxisResult::mean_radius_mm, "Mean distance of the surface"),
     output("rms_mm", &FitAxisResult::rms_mm, "How much it varies"));
