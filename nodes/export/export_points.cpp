// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_points.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/base/srgb.h"
#include "nodes/export/csv.h"
#include "nodes/export/export_mesh.h"
#include "nodes/export/timed_frames.h"

namespace face::exports {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written little-endian, as they lie in memory");

// Appends all frames, which have as many vertices; returns how many.
std::size_t append_frames(const engine::Seq<MeshPoints>& points, float scale, std::string& out) {
  check(!points.empty(), "there are no frames to export");
  std::size_t vertices = 0;
  for (std::size_t f = 0; f < points.size(); ++f) {
    const auto frame = points.at(f);
    if (f == 0) vertices = frame->points_mm.size();
    check(frame->points_mm.size() == vertices, "frame ", points.id(f), " has ", frame->points_mm.size(),
          " vertices, the first has ", vertices);
    for (const Vec3f& point : frame->points_mm)
      for (const float x : point) {
        const float scaled = x * scale;
        out.append(reinterpret_cast<const char*>(&scaled), sizeof scaled);
      }
  }
  return vertices;
}

void append_shortest(std::string& out, double value) {
  char text[40];
  out.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

template <class List>
void append_list(std::string& out, const List& list) {
  out += '[';
  bool first = true;
  for (const auto value : list) {
    if (!first) out += ", ";
    out += std::to_string(value);
    first = false;
  }
  out += "]\n";
}

template <class Vectors>
void append_vectors(std::string& out, const Vectors& vectors, int decimals) {
  out += '[';
  bool first = true;
  for (const auto& vector : vectors) {
    out += first ? "(" : ", (";
    for (std::size_t c = 0; c < vector.size(); ++c) {
      if (c > 0) out += ", ";
      append_fixed(out, vector[c], decimals);
    }
    out += ')';
    first = false;
  }
  out += ']';
}

std::vector<Vec3f> extent_of(const std::vector<Vec3f>& points) {
  Vec3f low{}, high{};
  for (std::size_t v = 0; v < points.size(); ++v)
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = v == 0 ? points[v][c] : std::min(low[c], points[v][c]);
      high[c] = v == 0 ? points[v][c] : std::max(high[c], points[v][c]);
    }
  return {low, high};
}

// A name that USD takes: letters, digits and underscores.
std::string prim_name(const std::string& name, std::size_t index) {
  std::string out = name.empty() || (name[0] >= '0' && name[0] <= '9') ? "part_" : "";
  for (const char c : name) out += (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ? c : '_';
  return out + "_" + std::to_string(index);
}

void append_mesh(std::string& out, const Mesh& mesh) {
  std::vector<std::uint32_t> counts;
  for (std::size_t p = 0; p < mesh.polygon_count(); ++p)
    counts.push_back(mesh.polygon_starts[p + 1] - mesh.polygon_starts[p]);
  out += "        uniform token subdivisionScheme = \"none\"\n        int[] faceVertexCounts = ";
  append_list(out, counts);
  out += "        int[] faceVertexIndices = ";
  append_list(out, mesh.corners);
  if (!mesh.corner_uvs.empty()) {
    std::vector<Vec2f> uvs;
    for (const std::uint32_t uv : mesh.corner_uvs) {
      check(uv < mesh.uvs.size(), "a corner has texture coordinate ", uv, ", but the mesh has ", mesh.uvs.size());
      uvs.push_back(mesh.uvs[uv]);
    }
    out += "        texCoord2f[] primvars:st = ";
    append_vectors(out, uvs, 6);
    out += " (\n            interpolation = \"faceVarying\"\n        )\n";
  }
  if (mesh.colors_srgb.size() == mesh.points_mm.size() && !mesh.colors_srgb.empty()) {
    std::vector<Vec3f> linear = mesh.colors_srgb;
    for (Vec3f& color : linear)
      for (float& c : color) c = static_cast<float>(linear_of(static_cast<double>(c)));
    out += "        color3f[] primvars:displayColor = ";
    append_vectors(out, linear, 4);
    out += " (\n            interpolation = \"vertex\"\n        )\n";
  }
}

void append_parts(std::string& out, const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
    const Part& part = mesh.parts[i];
    std::vector<std::uint32_t> faces;
    for (std::uint32_t p = 0; p < part.polygon_count; ++p) faces.push_back(part.first_polygon + p);
    out += "\n        def GeomSubset \"" + prim_name(part.name, i) +
           "\"\n        {\n            uniform token elementType = \"face\"\n            uniform token familyName = "
           "\"materialBind\"\n            int[] indices = ";
    append_list(out, faces);
    out += "        }\n";
  }
}

}  // namespace

engine::File export_points_npy(const engine::Seq<MeshPoints>& points, const ExportPointsOptions& options) {
  std::string numbers;
  const std::size_t vertices = append_frames(points, units_per_mm(options.unit), numbers);
  // NumPy Enhancement Proposal 1, version 1.0: the numbers start at a multiple of 64 bytes.
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(points.size()) + ", " +
                       std::to_string(vertices) + ", 3), }";
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xFF);
  bytes += static_cast<char>(header.size() >> 8);
  return engine::File::from_bytes(bytes + header + numbers, ".npy");
}

engine::File export_pc2(const engine::Seq<MeshPoints>& points, const ExportPointsOptions& options) {
  std::string numbers;
  const std::size_t vertices = append_frames(points, units_per_mm(options.unit), numbers);
  std::string bytes("POINTCACHE2\0", 12);
  const auto put = [&](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(std::int32_t{1});
  put(static_cast<std::int32_t>(vertices));
  put(0.0f);
  put(1.0f);
  put(static_cast<std::int32_t>(points.size()));
  return engine::File::from_bytes(bytes + numbers, ".pc2");
}

engine::File export_usda(const Mesh& mesh, const engine::Seq<MeshPoints>& points, const Timeline& timeline) {
  check_frames(points.size(), timeline);
  const std::vector<double>& times = timeline.time_s;
  const double span_s = times.back() - times.front();
  // To a thousandth of a frame per second, so that frames at an even rate have whole time codes.
  const double rate_hz = span_s > 0 ? std::round(1000 * static_cast<double>(times.size() - 1) / span_s) / 1000 : 24;
  const auto code_of = [&](std::size_t f) { return std::round(times[f] * rate_hz * 1e4) / 1e4; };
  std::string out =
      "#usda 1.0\n(\n    defaultPrim = \"head\"\n    metersPerUnit = 0.001\n    upAxis = \"Y\"\n    startTimeCode = ";
  append_shortest(out, code_of(0));
  out += "\n    endTimeCode = ";
  append_shortest(out, code_of(times.size() - 1));
  out += "\n    timeCodesPerSecond = ";
  append_shortest(out, rate_hz);
  out += "\n    framesPerSecond = ";
  append_shortest(out, rate_hz);
  out += "\n)\n\ndef Xform \"head\"\n{\n    def Mesh \"mesh\"\n    {\n";
  append_mesh(out, mesh);
  std::string extents = "        float3[] extent.timeSamples = {\n";
  out += "        point3f[] points.timeSamples = {\n";
  for (std::size_t f = 0; f < points.size(); ++f) {
    const auto frame = points.at(f);
    const std::vector<Vec3f>& vertices = frame_points(mesh, frame.get());
    for (auto* text : {&out, &extents}) {
      *text += "            ";
      append_shortest(*text, code_of(f));
      *text += ": ";
    }
    append_vectors(out, vertices, 3);
    out += ",\n";
    append_vectors(extents, extent_of(vertices), 3);
    extents += ",\n";
  }
  out += "        }\n" + extents + "        }\n";
  append_parts(out, mesh);
  return engine::File::from_bytes(out + "    }\n}\n", ".usda");
}

}  // namespace face::exports
