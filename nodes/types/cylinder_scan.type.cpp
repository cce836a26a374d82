// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/cylinder_scan.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(Axis, "axis", codec_version{1}, doc{"A line with a direction, such as a head's vertical axis."},
     field<&Axis::origin_mm>(), field<&Axis::direction>());

TYPE(CylinderScan, "cylinder_scan", codec_version{1}, doc{"Radius and colour around an axis: r(h, phi)."},
     field<&CylinderScan::axis>(field<&Axis::origin_mm>(), field<&Axis::direction>()), field<&CylinderScan::top_mm>(),
     field<&CylinderScan::step_mm>(), field<&CylinderScan::phi_step_rad>(),
     field<&CylinderScan::picture>(field<&Image::width>(), field<&Image::height>(), field<&Image::channels>(),
                                   field<&Image::pixels>()),
     field<&CylinderScan::radius_mm>(), view{"png", "phantom.draw_laser_scan"},
     difference{"evaluate.cylinder_scan_difference"});
