// SPDX-License-Identifier: Apache-2.0
// A face seen by a scanner that turns about it: a bump for a nose, dark between parted lips, a grey cap; and shapes of
// the surface that is cut from it.
#include <cmath>
#include <string>

#include "nodes/types/cylinder_scan.h"
#include "nodes/types/flow_field.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/shape_model.h"
#include "nodes/types/surface_map.h"
#include "tests/conformance/samples/area_samples.h"

namespace conformance {
namespace {

constexpr int size_px = 96;
constexpr double middle = 47.5, mouth_y = 59;

// As far about a place as 1, falling to 0.
double bell(double x, double y, double at_x, double at_y, double wide, double high) {
  const double u = (x - at_x) / wide, v = (y - at_y) / high;
  return std::exp(-u * u - v * v);
}

face::CylinderScan face_scan(int variant) {
  face::CylinderScan scan;
  scan.top_mm = 110;
  scan.step_mm = 2.4f;
  scan.phi_step_rad = static_cast<float>(2 * M_PI / size_px);
  scan.picture = {size_px, size_px, 3, {}};
  for (int y = 0; y < size_px; ++y)
    for (int x = 0; x < size_px; ++x) {
      const double inside = std::hypot((x - middle) / 7, (y - mouth_y) / 3.2);
      const double lips = std::hypot((x - middle) / 10, (y - mouth_y) / 6.5);
      double radius = 80 + 12 * bell(x, y, middle, 47, 4, 7) + 0.4 * std::sin(0.7 * x + variant) +
                      0.3 * variant * bell(x, y, middle, 70, 14, 10) + 0.4 * std::sin(0.5 * y);
      if (inside < 1) radius -= 6;
      scan.radius_mm.push_back(x == 30 && y == 40 ? 0.0f : static_cast<float>(radius));
      const double spot = 25 * std::sin(0.9 * x) * std::sin(0.8 * y + 0.2 * variant);
      double r = 205 + spot, g = 155 + spot, b = 125 + spot;
      if (lips < 1) r = 170, g = 50 + 0.3 * spot, b = 60;
      if (inside < 1) r = g = b = y < mouth_y ? 225 : 25;
      if (y < 16) r = 190, g = 195, b = 205;
      for (const double value : {r, g, b}) scan.picture.pixels.push_back(static_cast<std::uint8_t>(value));
    }
  return scan;
}

face::Landmarks marks(int variant) {
  std::vector<std::pair<double, double>> at;
  for (int i = 0; i < 17; ++i) {
    const double t = (i - 8) / 8.0;
    at.emplace_back(middle + 22 * t, 72 - 36 * t * t);
  }
  for (int i = 0; i < 10; ++i) at.emplace_back(middle - 13 + 26 * i / 9.0, 30);
  for (int i = 0; i < 4; ++i) at.emplace_back(middle, 36 + 4 * i);
  for (int i = 0; i < 5; ++i) at.emplace_back(middle - 4 + 2 * i, 51);
  for (const double eye : {39.0, 56.0})
    for (const auto& [dx, dy] : {std::pair{-4, 0}, {-2, -2}, {2, -2}, {4, 0}, {2, 2}, {-2, 2}})
      at.emplace_back(eye + dx, 36 + dy);
  for (int i = 0; i < 12; ++i)
    at.emplace_back(middle - 10 * std::cos(M_PI * i / 6), mouth_y - 6.5 * std::sin(M_PI * i / 6));
  for (int i = 0; i < 8; ++i)
    at.emplace_back(middle - 7 * std::cos(M_PI * i / 4), mouth_y - 3.2 * std::sin(M_PI * i / 4));
  face::Landmarks landmarks;
  for (std::size_t i = 0; i < at.size(); ++i)
    landmarks.points.push_back({std::to_string(i), at[i].first + 0.01 * variant, at[i].second, true});
  return landmarks;
}

const Maker scans = made(face_scan);
const Maker surface = made_by("model.scan_template", "surface");

face::MorphableModel first_surface(engine::Plugins& plugins) {
  return value_of<face::MorphableModel>(surface, plugins, 0);
}

// Its skin, moved a little, the lower face most.
Sample shape(engine::Plugins& plugins, int variant) {
  face::MeshPoints points{first_surface(plugins).mean.points_mm};
  for (face::Vec3f& p : points.points_mm) {
    const float down = p[1] < -20 ? 1.0f : 0.1f;
    p = {p[0] * (1 + 0.01f * static_cast<float>(variant % 3)), p[1] - 0.5f * down * static_cast<float>(variant),
         p[2] + 0.4f * std::sin(0.1f * p[1] + static_cast<float>(variant))};
  }
  return held(points);
}

Sample texture(engine::Plugins& plugins, int variant) {
  const std::size_t count = first_surface(plugins).mean.points_mm.size();
  face::Image image{static_cast<int>(count), 1, 3, {}};
  for (std::size_t i = 0; i < 3 * count; ++i)
    image.pixels.push_back(static_cast<std::uint8_t>(90 + 12 * (variant % 5) + 3 * (i % 3) + (i * i + variant) % 30));
  return held(image);
}

// Always the same one, so that shapes are its.
Sample same_surface(engine::Plugins& plugins, int variant) {
  face::MorphableModel model = first_surface(plugins);
  for (face::Vec3f& p : model.mean.points_mm) p[1] += 0.3f * static_cast<float>(variant);
  for (face::Vec3f& c : model.mean.colors_srgb) c[0] *= 1 - 0.05f * static_cast<float>(variant % 4);
  // Where colours come from.
  for (face::Vec2f& uv : model.mean.uvs) uv[0] += 0.02f * static_cast<float>(variant % 4) * uv[0] * (1 - uv[0]);
  return held(model);
}

Sample flow(engine::Plugins&, int variant) {
  face::FlowField field{size_px, size_px, {}, {}};
  for (int i = 0; i < size_px * size_px; ++i) {
    field.displacement_px.push_back({0.3f * std::sin(0.05f * static_cast<float>(i % size_px + variant)), 0.2f});
    field.valid.push_back(i % 11 == variant % 11 ? 0 : 1);
  }
  // One vertex astray.
  field.displacement_px[size_px * 66 + 48] = {6, 4};
  return held(field);
}

// A mean and two directions: wider, and the lower face down.
Sample space(engine::Plugins& plugins, int variant) {
  const face::MorphableModel model = first_surface(plugins);
  face::ShapeModel shapes;
  shapes.vertices = model.mean.points_mm.size();
  shapes.sigmas_mm = {2, 1.0 + 0.2 * variant};
  for (const face::Vec3f& p : model.mean.points_mm)
    for (const float value : p) shapes.mean_mm.push_back(static_cast<double>(value));
  for (int k = 0; k < 2; ++k)
    for (const face::Vec3f& p : model.mean.points_mm)
      for (int axis = 0; axis < 3; ++axis)
        shapes.modes.push_back(k == 0 ? (axis == 0 ? 0.02 * static_cast<double>(p[0]) : 0)
                                      : (axis == 1 && p[1] < -20 ? -1.0 : 0.0));
  shapes.projections = shapes.modes;
  return held(shapes);
}

// Every pixel shows the sample's head somewhere.
face::SurfaceMap truth(int variant) {
  face::SurfaceMap map{size_px, size_px, {}, {}};
  for (int i = 0; i < size_px * size_px; ++i) {
    map.triangle.push_back((i / 7 + variant) % 900);
    map.weights.push_back({0.3f, 0.4f});
  }
  return map;
}

const std::string same_polygons =
    "its polygons and landmarks count, which all samples share; tests/nodes/model has others";

const Registered laser_scans({
    .inputs =
        {
            {"model.scan_template.reference", scans},
            {"model.scan_template.landmarks", made(marks)},
            {"model.closest_combination.scan", scans},
            {"model.closest_combination.surface", same_surface},
            {"decode.cylinder_scan.header",
             text_file(".json",
                       {R"({"axis_origin_mm": [0, 0, 0], "axis_direction": [0, 1, 0], "top_mm": 30, "step_mm": 2,
                                     "radius_unit_mm": 0.05})",
                        R"({"axis_origin_mm": [0, 0, 5], "axis_direction": [0, 1, 0], "top_mm": 30, "step_mm": 2,
                                     "radius_unit_mm": 0.05, "phi_step_deg": 3})"})},
            {"decode.cylinder_scan.radius", file_by("export.depth")},
            {"decode.cylinder_scan.colour", file_by("export.png")},
            {"model.batch_flags.differences", made([](int variant) { return std::sin(2.1 * variant); })},
            {"model.closest_combination.space", space},
            {"phantom.laser_landmarks.scan",
             changed<face::CylinderScan>(scans, [](face::CylinderScan& scan,
                                                   int variant) { scan.top_mm += static_cast<float>(variant); })},
            {"phantom.laser_truth.truth", made(truth)},
            {"phantom.laser_truth.surface", same_surface},
            {"model.draw_cylinder.surface", same_surface},
            {"model.draw_cylinder.shape", shape},
            {"model.draw_cylinder.reference", scans},
            {"model.match_cylinder.surface", same_surface},
            {"model.match_cylinder.start", shape},
            {"model.match_cylinder.drawn", scans},
            {"model.match_cylinder.target", scans},
            {"model.match_cylinder.flow", flow},
            {"model.match_motion.surface", same_surface},
            {"model.match_motion.reference", scans},
            {"model.match_motion.start", shape},
            {"model.match_motion.target", scans},
            {"model.orient_shape.surface", same_surface},
            {"model.orient_shape.shape", shape},
            {"model.add_teeth.surface", same_surface},
            {"model.add_teeth.scans", scans},
            {"model.add_teeth.shapes", shape},
            {"model.resample_shape.shape", shape},
            {"model.resample_shape.texture", texture},
            {"model.resample_shape.surface", same_surface},
            {"model.resample_shape.mean", shape},
            {"model.resample_shape.anchors", shape},
            {"model.from_scans.surface", same_surface},
            {"model.from_scans.expressions", shape},
            {"model.from_scans.neutral", shape},
            {"model.from_scans.identities", shape},
            {"model.from_scans.textures", texture},
            {"model.compare_shapes.surface", same_surface},
            {"model.compare_shapes.expressions", shape},
            {"model.compare_shapes.identities", shape},
            {"model.scanned_rig.surface", same_surface},
            {"model.scanned_rig.expressions", shape},
            {"model.scanned_rig.neutral", shape},
            {"model.shape_rig.surface", same_surface},
            {"model.shape_rig.shape", shape},
            {"model.shape_rig.texture", texture},
        },
    .params =
        {
            {"model.scan_template.row_step_px", whole(1)},
            {"model.scan_template.column_step_px", whole(1)},
            {"model.match_motion.functions", whole(12)},
        },
    .values = {{"model.add_teeth.upper", {text("1"), text("2"), text("3")}},
               {"model.add_teeth.lower", {text("1"), text("2"), text("3")}}},
    .shown_elsewhere = {{"model.compare_shapes.surface", same_polygons},
                        {"model.match_cylinder.surface", same_polygons},
                        {"model.resample_shape.surface", same_polygons},
                        {"model.pick_frames.landmarks",
                         "their ids count; tests/nodes/model/pick_frames_test.cpp has others"}},
});

}  // namespace
}  // namespace conformance
