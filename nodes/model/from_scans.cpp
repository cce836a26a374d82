// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/from_scans.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "nodes/base/check.h"
#include "nodes/base/srgb.h"
#include "nodes/model/compare_spaces.h"
#include "nodes/model/head_points.h"
#include "nodes/model/scan_surface.h"
#include "nodes/render/triangulate.h"

namespace face::model {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::RowVectorXd row_of(const MeshPoints& shape, std::size_t skin, const char* name) {
  check(shape.points_mm.size() == skin, name, " has ", shape.points_mm.size(), " vertices, the surface's skin has ",
        skin);
  Eigen::RowVectorXd row(static_cast<Eigen::Index>(3 * skin));
  for (std::size_t v = 0; v < skin; ++v)
    for (std::size_t k = 0; k < 3; ++k)
      row[static_cast<Eigen::Index>(3 * v + k)] = static_cast<double>(shape.points_mm[v][k]);
  return row;
}

Rows rows_of(const engine::Seq<MeshPoints>& shapes, std::size_t skin, const char* name) {
  Rows rows(static_cast<Eigen::Index>(shapes.size()), static_cast<Eigen::Index>(3 * skin));
  for (std::size_t i = 0; i < shapes.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = row_of(*shapes.at(i), skin, name);
  return rows;
}

// Principal components of rows, each one standard deviation long, by the Gram matrix of the examples.
Rows components(const Rows& rows, std::int64_t count) {
  constexpr double noise = 1e-9;  // of the first variance
  if (rows.rows() == 0) return Rows(0, rows.cols());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(rows * rows.transpose() /
                                                             static_cast<double>(rows.rows()));
  const Eigen::VectorXd& values = eigen.eigenvalues();
  const Eigen::Index most = std::min<Eigen::Index>(rows.rows(), count);
  Rows out(most, rows.cols());
  Eigen::Index kept = 0;
  for (; kept < most; ++kept) {
    const Eigen::Index k = rows.rows() - 1 - kept;
    if (!(values[k] > noise * values[rows.rows() - 1]) || !(values[k] > 0)) break;
    out.row(kept) = eigen.eigenvectors().col(k).transpose() * rows / std::sqrt(static_cast<double>(rows.rows()));
    Eigen::Index largest = 0;
    out.row(kept).cwiseAbs().maxCoeff(&largest);
    if (out(kept, largest) < 0) out.row(kept) *= -1;  // an eigenvector's sign is arbitrary
  }
  return out.topRows(kept);
}

// Components over the skin, continued to the rest of the head by what each vertex follows.
template <class Rest>
LinearSpace space_of(const Rows& modes, const std::string& name, std::size_t skin, std::size_t all, const Rest& rest) {
  LinearSpace space;
  for (Eigen::Index k = 0; k < modes.rows(); ++k) {
    space.names.push_back(name + std::to_string(k));
    space.sigmas.push_back(1);
    std::vector<Vec3f> mode(all, Vec3f{0, 0, 0});
    for (std::size_t v = 0; v < skin; ++v)
      for (std::size_t axis = 0; axis < 3; ++axis)
        mode[v][axis] = static_cast<float>(modes(k, static_cast<Eigen::Index>(3 * v + axis)));
    for (std::size_t v = skin; v < all; ++v) mode[v] = rest(mode, v - skin);
    space.modes.insert(space.modes.end(), mode.begin(), mode.end());
  }
  return space;
}

// The middle of the corners of the mouth and of the lips.
Vec3f mouth_place(const MorphableModel& surface, const std::vector<Vec3f>& values) {
  Vec3f sum = {0, 0, 0};
  if (surface.landmarks68.size() != 68) return sum;
  for (std::size_t k = 0; k < 3; ++k)
    sum[k] = (values[surface.landmarks68[48]][k] + values[surface.landmarks68[54]][k] +
              0.5f * (values[surface.landmarks68[62]][k] + values[surface.landmarks68[66]][k])) /
             3;
  return sum;
}

// Linear reflectance of a person's vertices.
Eigen::RowVectorXd albedo_of(const Image& texture, const MeshPoints& shape, const std::vector<render::Triangle>& skin,
                             double lamp_shading) {
  const std::size_t count = shape.points_mm.size();
  check(texture.channels == 3 && texture.pixels.size() == 3 * count, "textures have ", texture.pixels.size(),
        " bytes for a person, expected 3 for each of ", count, " vertices");
  std::vector<Vec3f> normals;
  double middle_z = 0;
  if (lamp_shading > 0) {
    normals = render::vertex_normals(shape.points_mm, skin);
    double low = 1e30, high = -1e30;
    for (const Vec3f& p : shape.points_mm) {
      low = std::min<double>(low, p[2]);
      high = std::max<double>(high, p[2]);
    }
    middle_z = low;  // the skin reaches to the ears: about where the axis is
  }
  Eigen::RowVectorXd row(static_cast<Eigen::Index>(3 * count));
  for (std::size_t v = 0; v < count; ++v) {
    double light = 1;
    if (lamp_shading > 0) {
      const double x = static_cast<double>(shape.points_mm[v][0]),
                   z = static_cast<double>(shape.points_mm[v][2]) - middle_z;
      const double radius = std::max(std::hypot(x, z), 1e-6);
      const double cosine =
          std::abs((x * static_cast<double>(normals[v][0]) + z * static_cast<double>(normals[v][2])) / radius);
      light = 1 - lamp_shading + lamp_shading * cosine;
    }
    for (std::size_t c = 0; c < 3; ++c)
      row[static_cast<Eigen::Index>(3 * v + c)] = linear_of(texture.pixels[3 * v + c] / 255.0) / std::max(light, 0.1);
  }
  return row;
}

TableRow compared(const std::string& name, const Rows& examples, const Rows& basis) {
  if (examples.rows() == 0 || basis.rows() == 0) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {name, {none, none, none}};
  }
  const auto matrix = [](const Rows& rows) {
    Matrix m{static_cast<std::size_t>(rows.rows()), static_cast<std::size_t>(rows.cols()), {}};
    m.values.assign(rows.data(), rows.data() + rows.size());
    return m;
  };
  const SpaceComparison found = compare(matrix(examples), matrix(basis));
  return {name, {found.angles_deg.back(), found.angles_deg.front(), found.residual_ratio}};
}

Rows albedos_of(const MorphableModel& surface, const engine::Seq<MeshPoints>& identities,
                const engine::Seq<Image>& textures, std::size_t skin, double lamp_shading) {
  std::vector<render::Triangle> triangles;
  for (const render::Triangle& t : render::triangulate(surface.mean).triangles)
    if (t[0] < skin && t[1] < skin && t[2] < skin) triangles.push_back(t);
  Rows colours(static_cast<Eigen::Index>(textures.size()), static_cast<Eigen::Index>(3 * skin));
  for (std::size_t i = 0; i < textures.size(); ++i)
    colours.row(static_cast<Eigen::Index>(i)) = albedo_of(*textures.at(i), *identities.at(i), triangles, lamp_shading);
  return colours;
}

bool is_wall(const Follower& follower) { return follower.share > 0 && follower.share < 1; }

// The mean person's head. Teeth and walls: first as the surface has them with the scanned person's mouth shut, then
// moved as a whole to the mean person's mouth; walls hang on its lips.
std::vector<Vec3f> mean_head(const MorphableModel& surface, const MeshPoints& neutral, const Eigen::RowVectorXd& mean,
                             const std::vector<Follower>& followed) {
  const std::size_t skin = neutral.points_mm.size();
  const std::vector<Vec3f> closed = head_points(surface, neutral.points_mm);
  const Vec3f from = mouth_place(surface, closed);
  std::vector<Vec3f> head = closed;
  for (std::size_t v = 0; v < skin; ++v)
    for (std::size_t k = 0; k < 3; ++k) head[v][k] = static_cast<float>(mean[static_cast<Eigen::Index>(3 * v + k)]);
  const Vec3f to = mouth_place(surface, head);
  for (std::size_t v = skin; v < head.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) {
      const Follower& f = followed[v - skin];
      head[v][k] += is_wall(f) ? f.share * (head[f.skin][k] - closed[f.skin][k]) + (1 - f.share) * (to[k] - from[k])
                               : to[k] - from[k];
    }
  return head;
}

void paint(const Eigen::RowVectorXd& mean_colour, std::size_t skin, MorphableModel& model) {
  model.mean_albedo.resize(model.mean.points_mm.size());
  for (std::size_t v = 0; v < skin; ++v)
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = std::max(0.0, mean_colour[static_cast<Eigen::Index>(3 * v + c)]);
      model.mean_albedo[v][c] = static_cast<float>(value);
      model.mean.colors_srgb[v][c] = static_cast<float>(std::min(1.0, srgb_of(value)));
    }
}

// uvs of the surface are places in a scan of the whole turn: a texture of the face wants them to fill it.
void fill_texture(std::size_t skin, std::vector<Vec2f>& uvs) {
  Vec2f low = {1, 1}, high = {0, 0};
  for (std::size_t v = 0; v < skin; ++v)
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], uvs[v][k]);
      high[k] = std::max(high[k], uvs[v][k]);
    }
  for (std::size_t v = 0; v < skin; ++v)
    for (std::size_t k = 0; k < 2; ++k)
      uvs[v][k] = 0.01f + 0.98f * (uvs[v][k] - low[k]) / std::max(high[k] - low[k], 1e-6f);
}

}  // namespace

MorphableModel from_scans(const MorphableModel& surface, const engine::Seq<MeshPoints>& expressions,
                          const MeshPoints& neutral, const engine::Seq<MeshPoints>& identities,
                          const engine::Seq<Image>& textures, const FromScansOptions& options) {
  const std::size_t skin = skin_count(surface), all = surface.mean.points_mm.size();
  check(skin > 0, "surface has no skin");
  check(!identities.empty(), "there are no identities, expected at least 1");
  check(identities.size() == textures.size(), "there are ", identities.size(), " identities and ", textures.size(),
        " textures");
  check(options.lamp_shading >= 0 && options.lamp_shading < 1, "lamp_shading is ", options.lamp_shading,
        ", expected 0 to below 1");
  const Eigen::RowVectorXd rest = row_of(neutral, skin, "neutral");
  Rows moves = rows_of(expressions, skin, "expressions");
  moves.rowwise() -= rest;
  Rows persons = rows_of(identities, skin, "identities");
  const Eigen::RowVectorXd mean = persons.colwise().mean();
  persons.rowwise() -= mean;
  Rows colours = albedos_of(surface, identities, textures, skin, options.lamp_shading);
  const Eigen::RowVectorXd mean_colour = colours.colwise().mean();
  colours.rowwise() -= mean_colour;

  const std::vector<Follower> followed = followers(surface);
  MorphableModel model = surface;
  model.mean.points_mm = mean_head(surface, neutral, mean, followed);
  paint(mean_colour, skin, model);
  fill_texture(skin, model.mean.uvs);
  const auto with_skin = [&](const std::vector<Vec3f>& mode, std::size_t i) {
    const Follower& f = followed[i];
    Vec3f offset = mode[f.skin];
    for (float& value : offset) value *= f.share;
    return offset;
  };
  const auto with_mouth = [&](const std::vector<Vec3f>& mode, std::size_t i) {
    const Vec3f place = mouth_place(surface, mode);
    const Follower& f = followed[i];
    if (!is_wall(f)) return place;
    Vec3f offset = with_skin(mode, i);
    for (std::size_t k = 0; k < 3; ++k) offset[k] += (1 - f.share) * place[k];
    return offset;
  };
  const auto none = [](const std::vector<Vec3f>&, std::size_t) { return Vec3f{0, 0, 0}; };
  model.expression = space_of(components(moves, options.expression_components), "expression_", skin, all, with_skin);
  model.identity = space_of(components(persons, options.identity_components), "identity_", skin, all, with_mouth);
  model.albedo = space_of(components(colours, options.albedo_components), "albedo_", skin, all, none);
  return model;
}

Table compare_shapes(const MorphableModel& surface, const engine::Seq<MeshPoints>& expressions,
                     const engine::Seq<MeshPoints>& identities) {
  const std::size_t skin = skin_count(surface);
  Rows moves = rows_of(expressions, skin, "expressions"), persons = rows_of(identities, skin, "identities");
  if (moves.rows() > 0) moves.rowwise() -= Eigen::RowVectorXd(moves.colwise().mean());
  if (persons.rows() > 0) persons.rowwise() -= Eigen::RowVectorXd(persons.colwise().mean());
  const Eigen::Index odd = persons.rows() / 2, even = persons.rows() - odd;
  Rows a(even, persons.cols()), b(odd, persons.cols());
  for (Eigen::Index i = 0; i < persons.rows(); ++i) (i % 2 == 0 ? a : b).row(i / 2) = persons.row(i);
  return {{"angle_deg", "smallest_angle_deg", "residual_ratio"},
          {compared("expression", moves, persons), compared("control", b, a)}};
}

}  // namespace face::model
