// SPDX-License-Identifier: Apache-2.0
#include "tests/support/samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>

#include "engine/port.h"
#include "nodes/types/albedo_map.h"
#include "nodes/types/arkit.h"
#include "nodes/types/audio.h"
#include "nodes/types/camera.h"
#include "nodes/types/cylinder_scan.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/feature_map.h"
#include "nodes/types/flow_field.h"
#include "nodes/types/image.h"
#include "nodes/types/key_shapes.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/lighting.h"
#include "nodes/types/matrix.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/phone_statistics.h"
#include "nodes/types/phones.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/shape_set.h"
#include "nodes/types/surface_dots.h"
#include "nodes/types/surface_map.h"
#include "nodes/types/table.h"
#include "nodes/types/timeline.h"
#include "nodes/types/vertex_mask.h"
#include "nodes/types/vertex_targets.h"
#include "nodes/types/visemes.h"
#include "nodes/types/weights.h"
#include "tests/support/toy_run.h"

namespace test {
namespace {

using namespace face;

constexpr int width = 64, height = 48;  // of pictures and maps
constexpr int columns = 21, rows = 25;  // of the face's grid of vertices
constexpr int hair_rows = 1;            // from above
constexpr int upper_lip_row = 9;        // rows from below; the lower lip is the row before it
constexpr double frame_s = 0.04;
constexpr int frames = 4;

float wave(double x) { return static_cast<float>(std::sin(x)); }

// A bulging sheet, 150 mm wide and 220 mm high, with a mouth slit between two rows.
Mesh make_mesh(int variant) {
  Mesh mesh;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const float x = 7.5f * static_cast<float>(c - columns / 2);
      float y = 9.2f * static_cast<float>(r - rows / 2);
      if (r == upper_lip_row - 1) y += 8.7f;  // the lips all but touch
      const float bulge = 70 * (1 - x * x / 8100 - y * y / 19600);
      const float person = static_cast<float>(variant) * (1 + wave(0.05 * x + 0.03 * y));
      const float size = 1 + 0.01f * static_cast<float>(variant);
      mesh.points_mm.push_back({size * x, size * y, bulge + person});
      mesh.uvs.push_back({size * static_cast<float>(c) / columns, size * static_cast<float>(r) / rows});
      mesh.colors_srgb.push_back({0.8f, 0.6f + 0.1f * wave(c), 0.5f + 0.05f * wave(r + variant)});
    }
  mesh.polygon_starts.push_back(0);
  for (int r = 0; r + 1 < rows; ++r)
    for (int c = 0; c + 1 < columns; ++c) {
      if (r == upper_lip_row - 1 && c > 5 && c < 15) continue;  // the mouth
      const auto at = [](int row, int column) { return static_cast<std::uint32_t>(row * columns + column); };
      for (const std::uint32_t corner : {at(r, c), at(r, c + 1), at(r + 1, c + 1), at(r + 1, c)}) {
        mesh.corners.push_back(corner);
        mesh.corner_uvs.push_back(corner);
      }
      mesh.polygon_starts.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    }
  constexpr auto hair_polygons = static_cast<std::uint32_t>(hair_rows * (columns - 1));
  Part face;
  face.name = "face";
  face.gloss = 0.3f;
  face.polygon_count = static_cast<std::uint32_t>(mesh.polygon_count()) - hair_polygons;
  Part hair = face;
  hair.name = "hair";
  hair.first_polygon = face.polygon_count;
  hair.polygon_count = hair_polygons;
  mesh.parts = {face, hair};
  return mesh;
}

// Where a face's 68 points lie on the sheet, in mm.
std::array<Vec2f, 68> places_of_landmarks() {
  std::array<Vec2f, 68> places{};
  for (int i = 0; i < 17; ++i) {
    const double angle = M_PI * i / 16;
    places[static_cast<std::size_t>(i)] = {static_cast<float>(-65 * std::cos(angle)),
                                           static_cast<float>(20 - 100 * std::sin(angle))};
  }
  const auto line = [&](int first, int count, float x0, float y0, float x1, float y1, float bend) {
    for (int i = 0; i < count; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(count - 1);
      places[static_cast<std::size_t>(first + i)] = {x0 + t * (x1 - x0), y0 + t * (y1 - y0) + bend * 4 * t * (1 - t)};
    }
  };
  line(17, 5, -55, 60, -15, 60, 8);
  line(22, 5, 15, 60, 55, 60, 8);
  line(27, 4, 0, 45, 0, 8, 0);
  line(31, 5, -15, 0, 15, 0, -4);
  line(36, 4, -45, 40, -20, 40, 8);
  line(40, 2, -25, 34, -38, 34, 0);
  line(42, 4, 20, 40, 45, 40, 8);
  line(46, 2, 38, 34, 25, 34, 0);
  line(48, 7, -30, -28, 30, -28, 12);
  line(55, 5, 22, -40, -22, -40, -4);
  line(60, 5, -22, -24, 22, -24, 0);
  line(65, 3, 12, -32, -12, -32, 0);
  return places;
}

std::uint32_t nearest(const Mesh& mesh, const Vec2f& place) {
  std::uint32_t best = 0;
  double least = 1e9;
  for (std::uint32_t v = 0; v < mesh.points_mm.size(); ++v) {
    const double d = std::hypot(mesh.points_mm[v][0] - place[0], mesh.points_mm[v][1] - place[1]);
    if (d < least) least = d, best = v;
  }
  return best;
}

// Every ARKit shape is a bump of its own; jawOpen and what shuts the mouth move the lips.
std::vector<Shape> make_shapes(const Mesh& mesh, int variant) {
  std::vector<Shape> shapes;
  for (std::size_t s = 0; s < arkit_count; ++s) {
    Shape shape;
    shape.name = std::string(arkit_names[s]);
    const float x0 = -60 + 8.0f * static_cast<float>(s % 16), y0 = -90 + 45.0f * static_cast<float>(s / 13);
    for (std::uint32_t v = 0; v < mesh.points_mm.size(); ++v) {
      const Vec3f& p = mesh.points_mm[v];
      const bool lower = static_cast<int>(v) / columns < upper_lip_row;
      Vec3f offset = {0, 0, 0};
      if (shape.name == "jawOpen") {
        if (lower) offset = {0, -25, -4};
      } else if (shape.name == "mouthClose") {
        if (lower && static_cast<int>(v) / columns >= upper_lip_row - 3) offset = {0, 24, 3};
      } else {
        const double d = std::hypot(p[0] - x0, p[1] - y0);
        if (d < 35) offset = {wave(s), 3 * static_cast<float>(1 - d / 35), 2 + 0.1f * static_cast<float>(variant)};
      }
      if (offset == Vec3f{0, 0, 0}) continue;
      shape.vertices.push_back(v);
      shape.offsets_mm.push_back(offset);
    }
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

Rig make_rig(int variant) {
  Rig rig;
  rig.neutral = make_mesh(variant);
  rig.shapes = make_shapes(rig.neutral, variant);
  const std::uint32_t first = variant % 2 == 0 ? 8 : 7;
  for (std::uint32_t c = first; c < first + 5; ++c) {
    rig.inner_lips.push_back({upper_lip_row * columns + c, (upper_lip_row - 1) * columns + c});
    rig.lower_lip.push_back((upper_lip_row - 1) * columns + c);
    rig.upper_teeth.push_back((upper_lip_row + 1) * columns + c);
  }
  for (const Vec2f& place : places_of_landmarks())
    rig.landmarks68.push_back(nearest(rig.neutral, {place[0], place[1] + 4.0f * static_cast<float>(variant)}));
  return rig;
}

// Smooth, textured, and moving by a pixel per variant.
Image make_image(int variant) {
  Image image{width, height, 3, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        const double u = x - variant;
        const double value =
            128 + 50 * std::sin(0.45 * u + 0.2 * c) * std::cos(0.38 * y) + 40 * std::sin(0.13 * u * 0.9 + 0.21 * y);
        image.pixels.push_back(static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)));
      }
  return image;
}

Landmarks make_landmarks(int variant) {
  Landmarks landmarks;
  for (int i = 0; i < 6; ++i)
    landmarks.points.push_back({"point_" + std::to_string(i), 16.0 + 6 * i + variant, 18.0 + 10 * (i % 2), true});
  return landmarks;
}

Audio make_audio(int variant) {
  Audio audio;
  for (int i = 0; i < 16000; ++i)
    audio.samples.push_back(0.3f * wave(2 * M_PI * (140 + 20 * variant) * i / audio.rate_hz) *
                            (0.6f + 0.4f * wave(0.002 * i)));
  return audio;
}

Phones make_phones(int variant) {
  Phones phones;
  const std::vector<std::pair<std::string, std::string>> spoken = {
      {"SIL", ""}, {"M", "map"}, {"AE", "map"}, {"P", "map"}, {"F", "fee"}, {"IY", "fee"}, {"SIL", ""}};
  double at = 0;
  for (std::size_t i = 0; i < spoken.size(); ++i) {
    const double length = 0.08 + 0.02 * static_cast<double>((i + static_cast<std::size_t>(variant)) % 3);
    phones.phones.push_back({spoken[i].first, at, at + length, spoken[i].second, -0.5});
    at += length;
  }
  phones.duration_s = at;
  return phones;
}

Timeline make_timeline(int variant) {
  Timeline timeline;
  const double step = frame_s * (1 + 0.25 * variant);
  for (int f = 0; f < frames; ++f) timeline.time_s.push_back(step * f);
  timeline.duration_s = step * frames;
  return timeline;
}

Weights make_weights(int variant) {
  Weights weights;
  for (std::size_t s = 0; s < arkit_count; ++s)
    weights.values.push_back(0.25f + 0.25f * wave(static_cast<double>(s) + 0.7 * variant));
  return weights;
}

Visemes make_visemes(int variant) {
  Visemes visemes;
  const auto add = [&](const std::string& label, const std::string& contact, float jaw) {
    Viseme viseme;
    viseme.label = label;
    viseme.weights.assign(arkit_count, 0.05f + 0.02f * static_cast<float>(variant));
    viseme.weights[arkit_index("jawOpen")] = jaw;
    if (contact == "lips") viseme.weights[arkit_index("mouthClose")] = jaw;
    viseme.sigmas.assign(arkit_count, contact.empty() ? 0.2f : 0.1f);
    viseme.contact = contact;
    visemes.visemes.push_back(viseme);
  };
  add("SIL", "", 0);
  for (const char* vowel : {"AE", "IY"}) add(vowel, "", 0.4f);
  for (const char* stop : {"P.c", "P.r", "P", "M"}) add(stop, "lips", 0.1f);
  add("F", "teeth", 0.1f);
  return visemes;
}

Matrix make_matrix(int variant) {
  Matrix matrix{6, 4, {}};
  for (std::size_t i = 0; i < 24; ++i)
    matrix.values.push_back(1.5 + std::sin(1.7 * static_cast<double>(i)) +
                            0.1 * variant * std::cos(static_cast<double>(i)));
  return matrix;
}

RigidMotion make_motion(int variant) {
  RigidMotion motion;
  const double angle = 0.05 * (variant + 1);
  motion.rotation = {std::cos(angle), 0, std::sin(angle), 0, 1, 0, -std::sin(angle), 0, std::cos(angle)};
  motion.translation_mm = {1.0 + variant, 2, 3};
  return motion;
}

FlowField make_flow(int variant) {
  FlowField flow{width, height, {}, {}};
  for (int i = 0; i < width * height; ++i) {
    flow.displacement_px.push_back({0.5f * wave(0.1 * i), 0.3f * static_cast<float>(variant + 1)});
    flow.valid.push_back(i % 17 != 0);
  }
  return flow;
}

// A face with a hollow for a mouth, and slits across the brow that nothing was measured in, longer from row to row.
DepthScan make_depth(int variant) {
  DepthScan scan;
  scan.camera.focal_px = 120;
  scan.camera.centre_x_px = (width - 1) / 2.0f;
  scan.camera.centre_y_px = (height - 1) / 2.0f;
  scan.camera.position_mm[0] = static_cast<float>(variant);
  scan.picture = make_image(variant);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float dx = static_cast<float>(x - width / 2), dy = static_cast<float>(y - height / 2);
      float depth = 560 + 0.05f * (dx * dx + dy * dy) + static_cast<float>(variant);
      if (std::abs(x - 32) <= 5 && std::abs(y - 33) <= 2) depth += 20;
      if (y >= 8 && y < 14 && x > 21) depth -= 4 * static_cast<float>(y - 8);
      const bool slit = y >= 8 && y < 14 && x >= 22 && x < 26 + 2 * (y - 8);
      const float across = (dx - static_cast<float>(variant)) / 28, along = dy / 23;
      scan.depth_mm.push_back(slit || across * across + along * along > 1 ? 0 : depth);
    }
  return scan;
}

CylinderScan make_cylinder(int variant) {
  CylinderScan scan;
  scan.picture = make_image(variant);
  scan.top_mm = 100;
  scan.step_mm = 4;
  scan.phi_step_rad = static_cast<float>(2 * M_PI / width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      scan.radius_mm.push_back(y == 0 ? 0 : 80 + 6 * wave(0.2 * x + 0.1 * variant) + 5 * wave(0.15 * y));
  return scan;
}

SurfaceMap make_surface_map(int variant) {
  SurfaceMap map{width, height, {}, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      map.triangle.push_back(x < 4 || y < 4 ? -1 : (x / 2 + 20 * (y / 3) + variant) % 900);
      map.weights.push_back({0.3f, 0.4f});
    }
  return map;
}

SurfaceDots make_dots(int variant) {
  SurfaceDots dots;
  for (std::uint32_t i = 0; i < 5; ++i) {
    const std::uint32_t v = 150 + 30 * i + static_cast<std::uint32_t>(variant);
    SurfaceDot dot;
    dot.name = "marker_" + std::to_string(i);
    dot.vertices = {v, v + 1, v + columns + 1};
    dot.weights = {0.3f, 0.4f, 0.3f};
    dot.radius_mm = 4;
    dots.dots.push_back(dot);
  }
  return dots;
}

FeatureMap make_features(int variant) {
  FeatureMap map{width, height, {"grey", "radius"}, {}, {}};
  for (int c = 0; c < 2; ++c)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double u = x - 0.7 * variant, v = y + 0.4 * variant;
        const float bump = wave(0.31 * u + 0.2 * c) * wave(0.23 * v + 0.1 * u);
        map.values.push_back(c == 0 ? 128 + 90 * bump : 80 + 6 * bump);
      }
  map.values[20 * width + 30] = 250;  // a wild pixel
  map.valid.assign(static_cast<std::size_t>(width) * height, 1);
  return map;
}

Table make_table(int variant) {
  return {{"rms_mm", "share"}, {{"first", {1.0 + variant, 0.5}}, {"second", {2, 0.25}}, {"third", {3, std::nan("")}}}};
}

PhoneStatistics make_statistics(int variant) {
  PhoneStatistics statistics;
  const auto add = [&](const std::string& label, double at) {
    return PhoneStatistic{label, 20, {at, -at, 0.5 * at, 1}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
  };
  for (const char* label : {"AE", "F", "IY", "M", "P.c", "P.r", "SIL"})
    statistics.phones.push_back(add(label, 0.3 * static_cast<double>(statistics.phones.size()) + 0.1 * variant));
  statistics.all = add("", 0.8);
  return statistics;
}

template <class T>
std::function<std::shared_ptr<const void>(int)> maker(T (*make)(int)) {
  return [make](int variant) { return std::make_shared<const T>(make(variant)); };
}
template <class F>
std::function<std::shared_ptr<const void>(int)> made_by(F make) {
  return [make](int variant) { return std::make_shared<const std::decay_t<decltype(make(variant))>>(make(variant)); };
}

using Makers = std::map<std::string, std::function<std::shared_ptr<const void>(int)>>;

Makers makers() {
  Makers all;
  all["number"] = made_by([](int v) { return 1.5 + v; });
  all["integer"] = made_by([](int v) { return std::int64_t{2} + v; });
  all["flag"] = made_by([](int v) { return v % 2 == 0; });
  all["text"] = made_by([](int v) {
    static const std::array<std::string, 7> texts = {"Bob may move", "five vans", "maybe a few more",     "map",
                                                     "we feed them", "a puff",    "the moon may move Bob"};
    return texts[static_cast<std::size_t>(v) % texts.size()];
  });
  all["file"] = [](int v) {
    return sample_file("words" + std::to_string(v) + ".txt", "words " + std::to_string(v) + "\n");
  };
  all["albedo_map"] = made_by([](int v) {
    AlbedoMap map{width, height, {}, {}};
    for (int i = 0; i < width * height; ++i) {
      map.albedo.push_back({0.5f, 0.4f + 0.1f * wave(0.1 * i), 0.3f + 0.01f * static_cast<float>(v)});
      map.weight.push_back(i % 5 == 0 ? 0.0f : 0.8f);
    }
    return map;
  });
  all["audio"] = maker(make_audio);
  all["axis"] = made_by([](int v) { return Axis{{static_cast<float>(v), 0, -20}, {0, 1, 0}}; });
  all["camera"] = made_by([](int v) {
    Camera camera;
    camera.position_mm = {10.0f * static_cast<float>(v), 0, 600};
    camera.focal_px = 120;
    camera.centre_x_px = (width - 1) / 2.0f;
    camera.centre_y_px = (height - 1) / 2.0f;
    return camera;
  });
  all["cylinder_scan"] = maker(make_cylinder);
  all["depth_scan"] = maker(make_depth);
  all["face_fit"] = made_by([](int v) {
    FaceFit fit;
    fit.identity = {0.5f, -0.2f, 0.1f * static_cast<float>(v)};
    fit.expression = {0.3f, 0.1f};
    fit.albedo = {0.2f};
    fit.image_width_px = width;
    fit.image_height_px = height;
    fit.camera.position_mm[2] = 600 - 40.0f * static_cast<float>(v % 4);
    fit.camera.focal_px = 120;
    fit.camera.centre_x_px = 31.5f;
    fit.camera.centre_y_px = 23.5f;
    fit.light.mirror = {0.01f, 0.02f};
    fit.converged = true;
    fit.landmark_rms_px = 0.5;
    return fit;
  });
  all["feature_map"] = maker(make_features);
  all["flow_field"] = maker(make_flow);
  all["image"] = maker(make_image);
  all["key_shapes"] = made_by([](int v) {
    KeyShapes shapes;
    for (int i = 0; i < 3; ++i) shapes.shapes.push_back({std::to_string(i), 4 + i, make_landmarks(2 * i + v)});
    return shapes;
  });
  all["landmarks"] = maker(make_landmarks);
  all["lighting"] = made_by([](int v) {
    Lighting lighting;
    lighting.ambient = {0.3f + 0.1f * static_cast<float>(v), 0.3f, 0.3f};
    return lighting;
  });
  all["matrix"] = maker(make_matrix);
  all["mesh"] = maker(make_mesh);
  all["mesh_points"] = made_by([](int v) { return MeshPoints{make_mesh(v).points_mm}; });
  all["phone_statistics"] = maker(make_statistics);
  all["phones"] = maker(make_phones);
  all["rig"] = maker(make_rig);
  all["rigid_motion"] = maker(make_motion);
  all["shape_set"] = made_by([](int v) {
    ShapeSet set;
    const Mesh mesh = make_mesh(0);
    for (int s = 0; s < 3; ++s) {
      Shape shape;
      shape.name = "mode_" + std::to_string(s);
      for (std::uint32_t i = 0; i < mesh.points_mm.size(); ++i) {
        shape.vertices.push_back(i);
        shape.offsets_mm.push_back(
            {wave(0.03 * i * (s + 1)), 0.5f * wave(0.05 * i + s), 1.0f + 0.1f * static_cast<float>(v)});
      }
      set.shapes.push_back(shape);
    }
    return set;
  });
  all["surface_dots"] = maker(make_dots);
  all["surface_map"] = maker(make_surface_map);
  all["table"] = maker(make_table);
  all["timeline"] = maker(make_timeline);
  all["vertex_mask"] = made_by([](int v) {
    VertexMask mask;
    for (int i = 0; i < rows * columns; ++i) mask.on.push_back(i % 5 == v % 5);
    return mask;
  });
  all["vertex_targets"] = made_by([](int v) {
    VertexTargets targets;
    const Mesh mesh = make_mesh(1);
    for (std::uint32_t i = 0; i < mesh.points_mm.size(); i += 40) {
      const Vec3f& p = mesh.points_mm[i];
      targets.targets.push_back({i, p[0] + 0.2 * v, p[1], p[2], i % 80 == 0});
    }
    return targets;
  });
  all["visemes"] = maker(make_visemes);
  all["weights"] = maker(make_weights);
  return all;
}

}  // namespace

std::shared_ptr<const void> sample(const std::string& type, int variant) {
  static const Makers all = makers();
  const auto at = all.find(type);
  return at == all.end() ? nullptr : at->second(variant);
}

namespace {

std::filesystem::path in_own_folder(const std::string& name) {
  static const TemporaryFolder folder;
  return folder.path() / name;
}

}  // namespace

std::shared_ptr<const void> sample_file(const std::string& name, const std::string& bytes) {
  const std::string path = in_own_folder(name).string();
  std::ofstream(path, std::ios::binary) << bytes;
  return std::make_shared<const engine::File>(engine::File::at(path));
}

std::shared_ptr<const void> sample_folder(const std::string& name, const std::map<std::string, std::string>& files) {
  const std::filesystem::path folder = in_own_folder(name);
  std::vector<engine::File::Entry> entries;
  for (const auto& [relative, bytes] : files) {
    std::filesystem::create_directories((folder / relative).parent_path());
    std::ofstream(folder / relative, std::ios::binary) << bytes;
    entries.push_back({relative, (folder / relative).string()});
  }
  return std::make_shared<const engine::File>(engine::File::folder(folder.string(), entries));
}

}  // namespace test
