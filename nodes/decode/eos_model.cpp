// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/eos_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/srgb.h"
#include "nodes/decode/input_file.h"

namespace face::decode {
namespace {

constexpr float blend_shape_sigma = 0.5f;
constexpr std::uint32_t newest = 4;

struct Columns {
  std::size_t rows = 0, columns = 0;
  std::vector<float> values;  // by columns
};

struct Pca {
  Columns mean, basis, eigenvalues;
  std::vector<std::uint32_t> triangles;  // 3 each
};

struct BlendShapes {
  std::vector<std::string> names;
  std::vector<Columns> offsets;
};

// Reads an archive of the cereal library's binary kind: numbers one after the other.
class Archive {
 public:
  Archive(std::string_view bytes, std::string title) : bytes_(bytes), title_(std::move(title)) {}

  template <class T>
  T number() {
    T value;
    std::memcpy(&value, take(sizeof value, "a number").data(), sizeof value);
    return value;
  }

  // The length of a list whose items have at least `item` bytes.
  std::size_t length(std::size_t item, const char* what) {
    const std::size_t start = at_;
    const auto count = number<std::uint64_t>();
    if (count > (bytes_.size() - at_) / item)
      fail(title_, " byte ", start, ": found ", count, " ", what, ", but only ", bytes_.size() - at_, " bytes follow");
    return static_cast<std::size_t>(count);
  }

  std::string text(const char* what) { return std::string(take(length(1, what), what)); }

  Columns matrix(const char* what) {
    const std::size_t start = at_;
    const auto rows = number<std::int32_t>(), columns = number<std::int32_t>();
    if (rows < 0 || columns < 0 ||
        (columns > 0 &&
         static_cast<std::size_t>(rows) > (bytes_.size() - at_) / sizeof(float) / static_cast<std::size_t>(columns)))
      fail(title_, " byte ", start, ": found ", what, " of ", rows, " x ", columns, " numbers, but only ",
           bytes_.size() - at_, " bytes follow: is this a model that eos saved (version 1 or newer)?");
    Columns result{static_cast<std::size_t>(rows), static_cast<std::size_t>(columns), {}};
    result.values.resize(result.rows * result.columns);
    const std::string_view data = take(result.values.size() * sizeof(float), what);
    if (!data.empty()) std::memcpy(result.values.data(), data.data(), data.size());
    for (const float value : result.values)
      if (!std::isfinite(value)) fail(title_, ": ", what, " holds a number that is not finite");
    return result;
  }

  std::vector<std::uint32_t> triples(const char* what) {
    std::vector<std::uint32_t> result(3 * length(3 * sizeof(std::int32_t), what));
    for (std::uint32_t& index : result) index = static_cast<std::uint32_t>(number<std::int32_t>());
    return result;
  }

  bool absent() { return number<std::uint8_t>() != 0; }

  void finish() const {
    if (at_ != bytes_.size())
      fail(title_, " byte ", at_, ": ", bytes_.size() - at_, " bytes are left over, expected the end");
  }

  const std::string& title() const { return title_; }

 private:
  std::string_view take(std::size_t size, const char* what) {
    if (size > bytes_.size() - at_)
      fail(title_, " byte ", at_, ": the file ends within ", what, " of the model, expected ", size, " bytes more");
    const std::string_view result = bytes_.substr(at_, size);
    at_ += size;
    return result;
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  std::string title_;
};

Pca read_pca(Archive& archive) {
  Pca pca;
  pca.mean = archive.matrix("a mean");
  pca.basis = archive.matrix("a basis");
  pca.eigenvalues = archive.matrix("eigenvalues");
  pca.triangles = archive.triples("triangles");
  const std::size_t size = pca.mean.values.size();
  const bool empty_basis = pca.basis.values.empty();
  check(empty_basis || pca.basis.rows == size, archive.title(), ": a basis has ", pca.basis.rows,
        " rows, its mean has ", size);
  check(empty_basis || pca.eigenvalues.values.size() == pca.basis.columns, archive.title(), ": has ",
        pca.eigenvalues.values.size(), " eigenvalues of ", pca.basis.columns, " components");
  for (const float value : pca.eigenvalues.values)
    check(value >= 0, archive.title(), ": an eigenvalue is ", value, ", expected at least 0");
  return pca;
}

BlendShapes read_blend_shapes(Archive& archive) {
  BlendShapes shapes;
  const std::size_t count = archive.length(16, "blend shapes");
  for (std::size_t i = 0; i < count; ++i) {
    shapes.names.push_back(archive.text("letters of a name"));
    shapes.offsets.push_back(archive.matrix("a blend shape"));
  }
  return shapes;
}

void add_mode(const float* values, std::size_t vertices, float scale, LinearSpace& space) {
  for (std::size_t v = 0; v < vertices; ++v)
    space.modes.push_back({values[3 * v] * scale, values[3 * v + 1] * scale, values[3 * v + 2] * scale});
}

// Components at one standard deviation, so that coefficients are in sigmas.
LinearSpace space_of(const Pca& pca, const char* name, std::size_t vertices, float scale) {
  LinearSpace space;
  for (std::size_t k = 0; k < pca.basis.columns; ++k) {
    space.names.push_back(name + std::to_string(k));
    space.sigmas.push_back(1);
    add_mode(&pca.basis.values[k * pca.basis.rows], vertices, scale * std::sqrt(pca.eigenvalues.values[k]), space);
  }
  return space;
}

LinearSpace space_of(const BlendShapes& shapes, std::size_t vertices, float scale, const std::string& title) {
  LinearSpace space;
  for (std::size_t k = 0; k < shapes.names.size(); ++k) {
    check(shapes.offsets[k].values.size() == 3 * vertices, title, ": blend shape \"", shapes.names[k], "\" has ",
          shapes.offsets[k].values.size() / 3, " vertices, the model ", vertices);
    space.names.push_back(shapes.names[k]);
    space.sigmas.push_back(blend_shape_sigma);
    add_mode(shapes.offsets[k].values.data(), vertices, scale, space);
  }
  return space;
}

std::vector<Vec3f> points_of(const std::vector<float>& values) {
  std::vector<Vec3f> points;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) points.push_back({values[i], values[i + 1], values[i + 2]});
  return points;
}

// Linear reflectance, and components of it: those of sRGB by the curve's slope at the mean.
void add_colours(const Pca& colour, MorphableModel& model) {
  const std::size_t vertices = model.mean.points_mm.size();
  constexpr float step = 1e-3f;
  std::vector<Vec3f> slope;
  for (const Vec3f& srgb : points_of(colour.mean.values)) {
    Vec3f linear{}, d{};
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = std::clamp(srgb[c], 0.0f, 1.0f);
      linear[c] = static_cast<float>(linear_of(value));
      const float low = std::max(0.0f, value - step), high = std::min(1.0f, value + step);
      d[c] = static_cast<float>((linear_of(high) - linear_of(low)) / (high - low));
    }
    model.mean_albedo.push_back(linear);
    slope.push_back(d);
  }
  model.albedo = space_of(colour, "albedo_", vertices, 1);
  for (std::size_t i = 0; i < model.albedo.modes.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) model.albedo.modes[i][c] *= slope[i % vertices][c];
}

}  // namespace

MorphableModel read_eos_model(const engine::File& file, const engine::File* expressions, LengthUnit unit) {
  const std::string bytes = read_bytes(file);
  Archive archive(bytes, title_of(file));
  const std::string& title = archive.title();
  const auto version = archive.number<std::uint32_t>();
  check(version >= 1 && version <= newest, title, ": found version ", version,
        " of eos's models, expected 1 to 4 (version 0 is of 2016: download the model again)");
  const Pca shape = read_pca(archive), colour = read_pca(archive);
  MorphableModel model;
  Mesh& mesh = model.mean;
  mesh.points_mm = points_of(shape.mean.values);
  const std::size_t vertices = mesh.points_mm.size();
  check(vertices > 0 && shape.mean.values.size() == 3 * vertices, title, ": the mean has ", shape.mean.values.size(),
        " numbers, expected x, y and z of at least one vertex");
  check(!shape.triangles.empty(), title, ": has no triangles");
  const float scale = mm_per_unit(unit, mesh.points_mm);
  for (Vec3f& point : mesh.points_mm)
    for (float& x : point) x *= scale;
  for (const std::uint32_t v : shape.triangles)
    check(v < vertices, title, ": a triangle has vertex ", v, ", expected one below ", vertices);
  mesh.corners = shape.triangles;
  for (std::size_t i = 0; i <= shape.triangles.size(); i += 3)
    mesh.polygon_starts.push_back(static_cast<std::uint32_t>(i));
  model.identity = space_of(shape, "identity_", vertices, scale);

  if (version >= 2 && !archive.absent()) {
    if (const auto kind = archive.number<std::int32_t>(); kind == 0) {
      model.expression = space_of(read_blend_shapes(archive), vertices, scale, title);
    } else {
      check(kind == 1, title, ": found expressions of kind ", kind, ", expected 0 (blend shapes) or 1 (components)");
      const Pca pca = read_pca(archive);
      check(pca.mean.values.size() == 3 * vertices, title, ": the expressions have ", pca.mean.values.size() / 3,
            " vertices, the shape ", vertices);
      for (std::size_t v = 0; v < vertices; ++v)
        for (std::size_t k = 0; k < 3; ++k) mesh.points_mm[v][k] += scale * pca.mean.values[3 * v + k];
      model.expression = space_of(pca, "expression_", vertices, scale);
    }
  }
  std::map<std::string, std::uint32_t> places;
  if (version >= 3 && !archive.absent())
    for (std::size_t i = archive.length(12, "landmarks"); i > 0; --i) {
      const std::string name = archive.text("letters of a name");
      places[name] = static_cast<std::uint32_t>(archive.number<std::int32_t>());
    }
  for (std::uint32_t i = 1; i <= 68; ++i)
    if (const auto found = places.find(std::to_string(i)); found != places.end()) {
      check(found->second < vertices, title, ": landmark ", i, " is vertex ", found->second, ", expected one below ",
            vertices);
      model.landmarks68.push_back(found->second);
    }
  if (model.landmarks68.size() != 68) model.landmarks68.clear();
  for (std::size_t i = archive.length(16, "texture coordinates"); i > 0; --i) {
    const auto u = archive.number<double>(), v = archive.number<double>();
    mesh.uvs.push_back({static_cast<float>(u), static_cast<float>(1 - v)});
  }
  if (version >= 4) mesh.corner_uvs = archive.triples("triangles of the texture");
  archive.finish();
  if (mesh.corner_uvs.empty() && mesh.uvs.size() == vertices) mesh.corner_uvs = mesh.corners;
  const bool fit = mesh.corner_uvs.size() == mesh.corners.size() &&
                   std::all_of(mesh.corner_uvs.begin(), mesh.corner_uvs.end(),
                               [&](std::uint32_t corner) { return corner < mesh.uvs.size(); });
  check(mesh.uvs.empty() || fit, title, ": ", mesh.uvs.size(), " texture coordinates do not fit ", vertices,
        " vertices and ", mesh.corners.size() / 3, " triangles");

  if (!colour.mean.values.empty()) {
    check(colour.mean.values.size() == 3 * vertices, title, ": has colours of ", colour.mean.values.size() / 3,
          " vertices, its shape has ", vertices);
    add_colours(colour, model);
  }
  if (expressions != nullptr) {
    check(model.expression.size() == 0, title, ": has expressions of its own, so ", title_of(*expressions),
          " must not be given");
    const std::string more = read_bytes(*expressions);
    Archive shapes(more, title_of(*expressions));
    model.expression = space_of(read_blend_shapes(shapes), vertices, scale, shapes.title());
    shapes.finish();
  }
  return model;
}

}  // namespace face::decode
