// SPDX-License-Identifier: Apache-2.0
// Laser scans of the phantom with their truth, for the tests of models built from scans.
#pragma once
#include <string>
#include <vector>

#include "nodes/model/scan_template.h"
#include "nodes/phantom/laser_scan.h"
#include "nodes/phantom/laser_truth.h"
#include "nodes/phantom/make_head.h"
#include "nodes/phantom/make_person.h"
#include "nodes/types/arkit.h"

namespace test {

struct ScannedFace {
  face::Weights weights;
  face::phantom::LaserScanResult taken;
};

inline const face::phantom::MakePersonResult& scanned_person() {
  static const face::phantom::MakePersonResult person =
      face::phantom::make_person(face::phantom::make_head(), nullptr, nullptr,
                                 {.spread = 0, .lipstick = true, .markers = face::phantom::Markers::black});
  return person;
}

inline face::Weights face_of(std::initializer_list<std::pair<const char*, float>> values) {
  face::Weights weights{std::vector<float>(face::arkit_count, 0.0f)};
  for (const auto& [name, value] : values) weights.values[face::arkit_index(name)] = value;
  return weights;
}

// size: rows and columns; 512 is a whole scan.
inline ScannedFace scan_face(const face::Weights& weights, int size = 256) {
  const std::string id = std::to_string(weights.values[face::arkit_index("jawOpen")]);
  return {weights, face::phantom::laser_scan(scanned_person().person, weights, &scanned_person().dots, &id,
                                             {.rows = size, .columns = size, .step_mm = 0.6 * 512 / size})};
}

inline const ScannedFace& half_open() {
  static const ScannedFace face = scan_face(face_of({{"jawOpen", 0.25f}}));
  return face;
}

inline face::Landmarks marks_of(const ScannedFace& face) {
  return face::phantom::laser_landmarks(scanned_person().person, face.weights, face.taken.scan);
}

inline const face::MorphableModel& half_open_surface() {
  static const face::MorphableModel surface = face::model::scan_template(half_open().taken.scan, marks_of(half_open()),
                                                                         {.row_step_px = 2, .column_step_px = 1});
  return surface;
}

// Where the surface's vertices truly are in another face.
inline face::MeshPoints truth_of(const ScannedFace& face) {
  return face::phantom::laser_truth(scanned_person().person, face.weights, half_open().taken.truth,
                                    half_open_surface());
}

}  // namespace test
