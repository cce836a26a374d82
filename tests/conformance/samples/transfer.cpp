// SPDX-License-Identifier: Apache-2.0
// A head, a speaking face and a scan that belong together: sheets about one axis, with a mouth. The speaking face's
// neutral frame has its lips shut and, by noise, past each other; one vertex of it lies far out, and its upper edge
// beside the head.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "nodes/types/cylinder_scan.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/phones.h"
#include "nodes/types/rig.h"
#include "nodes/types/shape_model.h"
#include "nodes/types/surface_map.h"
#include "nodes/types/weights.h"
#include "tests/conformance/samples/shared.h"
#include "tests/support/blinking_eye.h"
#include "tests/support/lip_sheet.h"

namespace conformance {
namespace {

using face::Mesh;
using face::Vec3f;

float as_float(int value) { return static_cast<float>(value); }

// Two bumps of the head, of which the second is a person's own.
float bump(const Vec3f& p, float x_mm, float y_mm, float wide_mm2) {
  return std::exp(-(std::pow(p[0] - x_mm, 2.0f) + std::pow(p[1] - y_mm, 2.0f)) / wide_mm2);
}

// Variants are other persons; the polygons of each other one begin at another corner, so that they fall into other
// triangles.
Mesh head_mesh(int variant) {
  Mesh mesh = test::lip_sheet(0.3 * variant, 90 + 0.5 * variant);
  for (std::size_t v = 0; v < mesh.points_mm.size(); ++v) {
    Vec3f& p = mesh.points_mm[v];
    p[2] += 8 * bump(p, 8, 20, 120) + (6 + 0.5f * as_float(variant)) * bump(p, -15, -10, 200);
    mesh.colors_srgb[v] = {0.8f, 0.5f + 0.1f * std::sin(0.2f * p[1]), 0.4f - 0.05f * as_float(variant % 4)};
  }
  if (variant % 2 == 1)
    for (std::size_t c = 0; c + 3 < mesh.corners.size(); c += 4)
      std::rotate(mesh.corners.begin() + static_cast<std::ptrdiff_t>(c),
                  mesh.corners.begin() + static_cast<std::ptrdiff_t>(c) + 1,
                  mesh.corners.begin() + static_cast<std::ptrdiff_t>(c) + 4);
  return mesh;
}

std::vector<face::LipPair> lips() {
  std::vector<face::LipPair> pairs;
  for (int c = 14; c <= 26; ++c)
    pairs.push_back({test::sheet_vertex(test::sheet_upper_lip, c), test::sheet_vertex(test::sheet_upper_lip + 1, c)});
  return pairs;
}

const Maker heads = made([](int variant) {
  face::Rig rig;
  rig.neutral = head_mesh(variant);
  rig.inner_lips = lips();
  // The first squares stand for teeth.
  const auto polygons = static_cast<std::uint32_t>(rig.neutral.polygon_count());
  const std::uint32_t teeth = 100 + 20 * static_cast<std::uint32_t>(variant);
  rig.neutral.parts = {{"teeth", 0, teeth, {1, 1, 1}, 0, true},
                       {"face", teeth, polygons - teeth, {0.9f, 0.9f, 0.9f}, 0, true}};
  face::Shape jaw{"jawOpen", {}, {}};
  for (int v = test::sheet_columns * (test::sheet_upper_lip + 1); v < test::sheet_columns * test::sheet_rows; ++v) {
    jaw.vertices.push_back(static_cast<std::uint32_t>(v));
    jaw.offsets_mm.push_back({0, -20, -2});
  }
  rig.shapes = {jaw};
  return rig;
});

const Maker model = made([](int variant) {
  face::MorphableModel faces;
  faces.mean = head_mesh(variant);
  faces.inner_lips = lips();
  faces.identity.names = {"bump", "width"};
  faces.identity.sigmas = {1, 1};
  for (const Vec3f& p : faces.mean.points_mm) faces.identity.modes.push_back({0, 0, 5 * bump(p, 8, 20, 120)});
  for (const Vec3f& p : faces.mean.points_mm) faces.identity.modes.push_back({0.02f * p[0], 0, 0});
  return faces;
});

const Maker head_points = made([](int variant) { return face::MeshPoints{head_mesh(2 * variant).points_mm}; });

// Of the reference, in which the lips are apart; in the second they are not.
Mesh speaking_mesh(int variant) {
  Mesh mesh = test::lip_sheet(4 + 0.5 * variant, 90, variant != 1);
  for (Vec3f& p : mesh.points_mm) p[1] *= 1 + 0.01f * as_float(variant);
  return mesh;
}
const Maker mesh = made(speaking_mesh);

const Maker shape = made([](int variant) {
  face::MeshPoints points{head_mesh(0).points_mm};
  for (int c = 12; c < 29; ++c) {
    points.points_mm[test::sheet_vertex(test::sheet_upper_lip, c)][1] -= 2.7f - 0.2f * as_float(variant);
    points.points_mm[test::sheet_vertex(test::sheet_upper_lip + 1, c)][1] += 0.7f;
  }
  points.points_mm[test::sheet_vertex(10, 30)][2] += 18;
  for (int c = 0; c < test::sheet_columns; ++c) points.points_mm[test::sheet_vertex(0, c)][1] += 5;
  for (Vec3f& p : points.points_mm) p[1] += 0.3f * as_float(variant);
  return points;
});

// Vertices of the head where they are in a scan of 720 columns whose top is the sheet's.
const Maker scan_marks = made([](int variant) {
  face::Landmarks landmarks;
  for (const auto& [row, column] : {std::pair{5, 5}, {5, 35}, {35, 20}})
    landmarks.points.push_back({"vertex_" + std::to_string(test::sheet_vertex(row, column)),
                                359.5 + (column - 20) * 2.0 / 90 * 720 / (2 * M_PI) + 0.5 * variant,
                                row * 2.0 / 0.8 - 0.3 * variant, true});
  return landmarks;
});

const Maker scan = made_by("transfer.project_cylinder", "scan");
// Some vertices of the lips are lost, and take after those around them.
const Maker places =
    changed<face::SurfaceMap>(made_by("transfer.look_up", "places"), [](face::SurfaceMap& found, int variant) {
      for (int c = 17; c < 24 - variant; ++c) found.triangle[test::sheet_vertex(test::sheet_upper_lip, c)] = -1;
    });

const Maker jaw_weights = made([](int variant) { return face::Weights{{0.4f + 0.1f * as_float(variant)}}; });

// A direction in which the lower face goes down.
const Maker space = made([](int variant) {
  const Mesh rest = speaking_mesh(0);
  face::ShapeModel moves{rest.points_mm.size(), {}, {2.0 + variant}, {}, {}};
  double length = 0;
  for (const Vec3f& p : rest.points_mm)
    for (std::size_t k = 0; k < 3; ++k) {
      moves.mean_mm.push_back(static_cast<double>(p[k]) + 0.2 * variant);
      moves.modes.push_back(k == 1 ? (p[1] < 0 ? -1.0 : 0.1) : 0);
      length += moves.modes.back() * moves.modes.back();
    }
  for (const double value : moves.modes) moves.projections.push_back(value / length);
  return moves;
});

// Pixels of the reference's picture.
const Maker reference_truth = made([](int variant) {
  face::SurfaceMap truth{test::sheet_columns, test::sheet_rows, {}, {}};
  for (int i = 0; i < test::sheet_columns * test::sheet_rows; ++i) {
    truth.triangle.push_back(i + variant);
    truth.weights.push_back({0.3f, 0.4f});
  }
  return truth;
});

constexpr int rows_judged = 12;

// A place for each vertex of the speaking face, about the lips; variants lie farther down, and some are lost.
Maker about_the_lips(int from) {
  return made([from](int variant) {
    const int count = rows_judged * (test::sheet_columns - 1);
    face::SurfaceMap at{count, 1, {}, {}};
    for (int i = 0; i < count; ++i) {
      at.triangle.push_back((i + variant) % 17 == 3 ? -1 : from + 2 * (i + 45 * variant));
      at.weights.push_back({0.3f, 0.3f});
    }
    return at;
  });
}
constexpr int triangles_per_row = 2 * (test::sheet_columns - 1);

// Silence in which two of the frames count, another in which two others do.
const Maker phones = made([](int variant) {
  const double until = 0.6 - 0.1 * variant;
  return face::Phones{{{"SIL", 0, until, "", 0}, {"AE", until, 1, "a", 0}}, 1, true};
});

// A head without landmarks, each variant of another size.
const Maker unmarked_head = changed<face::Rig>(made_by("phantom.make_head", "head"), [](face::Rig& rig, int variant) {
  rig.landmarks68.clear();
  for (Vec3f& p : rig.neutral.points_mm)
    for (float& x : p) x *= 1 + 0.1f * as_float(variant);
});
// Each variant has its landmarks elsewhere.
const Maker marked_head = changed<face::Rig>(made_by("phantom.make_head", "head"), [](face::Rig& rig, int variant) {
  for (int k = 0; k < variant; ++k) rig.landmarks68[8] = rig.landmarks68[static_cast<std::size_t>(30 + k % 20)];
});

// An eye whose lids shut; variants see it farther to the right.
const Maker open_eye = made([](int variant) {
  face::DepthScan seen = test::eye_scan(1);
  std::rotate(seen.picture.pixels.rbegin(), seen.picture.pixels.rbegin() + 2 * variant, seen.picture.pixels.rend());
  return seen;
});
const Maker eye_mesh = made([](int variant) {
  Mesh sheet = test::eye_mesh();
  for (face::Vec2f& uv : sheet.uvs) uv[0] += 0.02f * as_float(variant);
  return sheet;
});
// Shut, from ever farther to the right on.
const Maker shut_eye = made([](int variant) {
  const Mesh sheet = test::eye_mesh();
  face::MeshPoints moved{sheet.points_mm};
  const face::MeshPoints shut = test::eye_shape(sheet, 0.02);
  for (std::size_t v = 0; v < moved.points_mm.size(); ++v)
    if (moved.points_mm[v][0] > -14 + 3 * as_float(variant)) moved.points_mm[v] = shut.points_mm[v];
  return moved;
});
// From variant 4 on so far away that everything is small.
const Maker far_eye = made([](int variant) {
  face::DepthScan seen = test::eye_scan(1);
  if (variant > 3) seen.camera.focal_px = 40;
  return seen;
});
const Maker half_shut_eye = made([](int variant) { return test::eye_scan(0.3 + 0.05 * variant); });
// Wherever lids are taken to be, the fit finds them; the head's place counts.
const Maker half_shut_shape = made([](int variant) {
  face::MeshPoints lids = test::eye_shape(test::eye_mesh(), 0.45 + 0.05 * variant);
  for (face::Vec3f& p : lids.points_mm) p[0] += 0.5f * static_cast<float>(variant);
  return lids;
});
const Maker eye_outlines = made([](int variant) {
  face::Landmarks points = test::eye_outline();
  for (face::Landmark& p : points.points) p.x_px += 0.5 * variant;
  return points;
});
const Maker drawn_eye = made([](int variant) {
  face::Image image = test::eye_scan(0.6).picture;
  for (std::uint8_t& p : image.pixels) p = static_cast<std::uint8_t>(p / (1 + variant));
  return image;
});
const Maker dark_eye = made([](int variant) {
  face::DepthScan seen = test::eye_scan(1);
  for (std::uint8_t& p : seen.picture.pixels) p = static_cast<std::uint8_t>(p / (2 + variant));
  return seen;
});

const Registered transfer({
    .inputs =
        {
            {"transfer.project_cylinder.mesh", mesh},
            {"transfer.project_cylinder.shape", shape},
            {"transfer.fit_identity.model", model},
            {"transfer.fit_identity.scan", scan},
            {"transfer.fit_identity.marks", scan_marks},
            {"transfer.look_up.model", model},
            {"transfer.look_up.fitted", head_points},
            {"transfer.look_up.mesh", mesh},
            {"transfer.look_up.shape", shape},
            {"transfer.resample.places", places},
            {"transfer.resample.head", heads},
            {"transfer.resample.weights", jaw_weights},
            {"transfer.resample.mesh", mesh},
            {"transfer.resample.shape", shape},
            {"transfer.resample_colours.places", places},
            {"transfer.resample_colours.head", heads},
            {"transfer.resample_colours.mesh", mesh},
            {"transfer.resample_scan.places", places},
            {"transfer.resample_scan.head", heads},
            {"transfer.resample_scan.fitted", head_points},
            {"transfer.resample_scan.scan", scan},
            {"transfer.resample_scan.mesh", mesh},
            {"transfer.resample_scan.shape", shape},
            {"transfer.scan_places.truth", reference_truth},
            {"transfer.scan_places.mesh", changed<Mesh>(mesh,
                                                        [](Mesh& sheet, int variant) {
                                                          for (face::Vec2f& uv : sheet.uvs)
                                                            uv[0] += 0.03f * as_float(variant);
                                                        })},
            {"transfer.scan_places.head", heads},
            {"transfer.rest_shape.timeline", spread_timeline},
            {"transfer.rest_shape.phones", phones},
            {"transfer.move_model.model", space},
            {"transfer.move_model.from", shape},
            {"transfer.move_model.to", head_points},
            {"transfer.rest_model.model", space},
            {"transfer.rest_model.rest", shape},
            {"transfer.freeze_edges.model", space},
            {"transfer.freeze_edges.mesh", mesh},
            {"transfer.mark_lips.rig", heads},
            {"transfer.mark_lips.mesh", mesh},
            {"transfer.line_mouth.rig", heads},
            {"transfer.mark_landmarks.rig", unmarked_head},
            {"transfer.mark_landmarks.reference", marked_head},
            {"transfer.line_mouth.mesh", mesh},
            {"transfer.judge_lips.places", about_the_lips((test::sheet_upper_lip - 8) * triangles_per_row)},
            {"transfer.judge_lips.truth", about_the_lips((test::sheet_upper_lip - 10) * triangles_per_row)},
            {"transfer.judge_lips.head", heads},
            {"transfer.find_openings.mesh", eye_mesh},
            {"transfer.find_openings.reference", open_eye},
            {"transfer.find_openings.shapes", shut_eye},
            {"transfer.find_openings.frames", far_eye},
            {"transfer.draw_openings.drawn", drawn_eye},
            {"transfer.draw_openings.openings", eye_outlines},
            {"transfer.draw_openings.mesh", eye_mesh},
            {"transfer.draw_openings.reference", open_eye},
            {"transfer.draw_openings.texture", dark_eye},
            {"transfer.draw_openings.shape", half_shut_shape},
            {"transfer.draw_openings.frame", half_shut_eye},
        },
    .values = {{"transfer.rest_shape.label", {text("AE")}}},
});

}  // namespace
}  // namespace conformance
