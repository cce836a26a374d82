// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <string>

#include "engine/port.h"
#include "nodes/types/cylinder_scan.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/morphable_model.h"

namespace face::model {

inline constexpr const char* upper_teeth_part = "upper_teeth";
inline constexpr const char* lower_teeth_part = "lower_teeth";
inline constexpr const char* mouth_part = "mouth_socket";

// The walls of the mouth are rings like the edge of the lips, further and further back, about their middle. They are no
// wider than the lips, so that they stay within the cheeks when a mouth is narrow.
struct MouthRing {
  float back_mm = 0;
  float width = 1;    // of the edge of the lips'
  float height = 1;   // likewise
  float follows = 0;  // share of the lips' motion
};
inline constexpr std::array<MouthRing, 4> mouth_rings = {
    {{3, 0.97f, 1.1f, 0.99f}, {10, 0.9f, 1.5f, 0.9f}, {25, 0.8f, 1.6f, 0.5f}, {45, 0.5f, 1.0f, 0.1f}}};

struct AddTeethOptions {
  std::string upper;              // id of the scan that shows the upper teeth; empty = the first
  std::string lower;              // of the lower ones
  double least_brightness = 0.5;  // of the brightest in the mouth
  double least_whiteness = 0.6;   // blue over red
};

// Adds teeth and the inside of the mouth to a surface (Blanz, Basso, Poggio, Vetter: Reanimating Faces in Images and
// Video, 2003, section 2.4). The paper cuts the polygons of the teeth out by hand; here they are the bright and white
// pixels between the lips, upper ones from the upper lip down to the first gap of a column, lower ones from the lower
// lip up. Scans are brought to rest on the upper face (orient_shape); upper teeth then stay where they are in
// the upper scan, lower ones keep their offset to the tip of the chin in the lower scan. The walls of the mouth hang on
// the lips, end in a throat, and may cross the teeth. shapes: the skin in the scans, as match_cylinder finds it. New
// parts are upper_teeth, lower_teeth and mouth_socket; a surface whose mouth is closed comes back as it is. Throws
// where no scan has the id.
MorphableModel add_teeth(const MorphableModel& surface, const engine::Seq<CylinderScan>& scans,
                         const engine::Seq<MeshPoints>& shapes, const AddTeethOptions& options = {});

}  // namespace face::model
