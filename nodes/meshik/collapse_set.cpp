// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/collapse_set.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <string>

#include "nodes/base/check.h"

namespace face::meshik {
namespace {

using Surface = OpenMesh::TriMesh_ArrayKernelT<>;
using Quadric = OpenMesh::Geometry::Quadricd;
using Vertex = OpenMesh::VertexHandle;
using Point = OpenMesh::Vec3d;

// A border counts this much more than the surface beside it.
constexpr double border_weight = 10;
constexpr double least_cosine = 0.5;

// What a collapse costs in all poses.
class PoseQuadrics : public OpenMesh::Decimater::ModBaseT<Surface> {
 public:
  using Handle = OpenMesh::Decimater::ModHandleT<PoseQuadrics>;
  using Base = OpenMesh::Decimater::ModBaseT<Surface>;

  explicit PoseQuadrics(Surface& surface) : Base(surface, false) {}

  void take(const CollapseSet& set) { set_ = &set; }
  const std::string& name() const override { return name_; }

  void initialize() override {
    importance_ = set_->importance;
    quadrics_.assign(set_->poses_mm.size() * mesh().n_vertices(), Quadric(0, 0, 0, 0));
    for (std::size_t p = 0; p < set_->poses_mm.size(); ++p) {
      for (const auto face : mesh().faces()) {
        Vertex corner[3];
        int i = 0;
        for (const auto v : face.vertices()) corner[i++] = v;
        const Point a = at(p, corner[0]), normal = (at(p, corner[1]) - a) % (at(p, corner[2]) - a);
        const double twice_area = normal.norm();
        if (!(twice_area > 0)) continue;
        const Point unit = normal / twice_area;
        Quadric quadric(unit, a);
        quadric *= twice_area / 2;
        for (const Vertex v : corner) of(p, v) += quadric;
        // The plane through a border edge, upright on the triangle.
        for (i = 0; i < 3; ++i) {
          const Vertex from = corner[i], to = corner[(i + 1) % 3];
          if (!mesh().is_boundary(mesh().edge_handle(mesh().find_halfedge(from, to)))) continue;
          const Point edge = at(p, to) - at(p, from), across = edge % unit;
          if (!(across.norm() > 0)) continue;
          Quadric border(across / across.norm(), at(p, from));
          border *= border_weight * edge.sqrnorm();
          of(p, from) += border;
          of(p, to) += border;
        }
      }
    }
  }

  float collapse_priority(const CollapseInfo& info) override {
    double cost = 0;
    for (std::size_t p = 0; p < set_->poses_mm.size(); ++p) {
      if (turns(p, info)) return ILLEGAL_COLLAPSE;
      Quadric sum = of(p, info.v0);
      sum += of(p, info.v1);
      cost += std::max(0.0, sum(at(p, info.v1)));
    }
    return static_cast<float>(cost * importance_[index(info.v0)]);
  }

  void postprocess_collapse(const CollapseInfo& info) override {
    for (std::size_t p = 0; p < set_->poses_mm.size(); ++p) of(p, info.v1) += of(p, info.v0);
  }

 private:
  static std::size_t index(Vertex v) { return static_cast<std::size_t>(v.idx()); }
  Quadric& of(std::size_t pose, Vertex v) { return quadrics_[pose * set_->importance.size() + index(v)]; }
  Point at(std::size_t pose, Vertex v) const {
    const Vec3f& p = set_->poses_mm[pose][index(v)];
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  }

  // A triangle about v0 that is left has another normal once v0 is at v1.
  bool turns(std::size_t pose, const CollapseInfo& info) const {
    const Point to = at(pose, info.v1), from = at(pose, info.v0);
    for (const auto face : mesh_of().vf_range(info.v0)) {
      if (face == info.fl || face == info.fr) continue;
      Vertex others[2];
      int i = 0;
      // The two corners after v0, in order.
      auto halfedge = mesh_of().halfedge_handle(face);
      while (mesh_of().from_vertex_handle(halfedge) != info.v0) halfedge = mesh_of().next_halfedge_handle(halfedge);
      others[i++] = mesh_of().to_vertex_handle(halfedge);
      others[i] = mesh_of().to_vertex_handle(mesh_of().next_halfedge_handle(halfedge));
      const Point b = at(pose, others[0]), c = at(pose, others[1]);
      const Point before = (b - from) % (c - from), after = (b - to) % (c - to);
      if (before.norm() > 0 && !((before | after) > least_cosine * before.norm() * after.norm())) return true;
    }
    return false;
  }
  const Surface& mesh_of() const { return const_cast<PoseQuadrics*>(this)->mesh(); }

  const std::string name_ = "PoseQuadrics";
  const CollapseSet* set_ = nullptr;
  std::vector<double> importance_;
  std::vector<Quadric> quadrics_;  // P x V
};

}  // namespace

Collapsed collapse_set(const CollapseSet& set, std::size_t vertices) {
  const std::size_t count = set.importance.size();
  check(!set.poses_mm.empty() && set.keep.size() == count, "there are ", set.poses_mm.size(), " poses and ",
        set.keep.size(), " flags for ", count, " vertices, expected at least one pose and a flag per vertex");
  for (std::size_t p = 0; p < set.poses_mm.size(); ++p)
    check(set.poses_mm[p].size() == count, "pose ", p, " has ", set.poses_mm[p].size(), " vertices, expected ", count);

  Surface surface;
  surface.request_vertex_status();
  surface.request_edge_status();
  surface.request_face_status();
  OpenMesh::FPropHandleT<std::uint32_t> number;
  surface.add_property(number);
  for (const Vec3f& p : set.poses_mm[0]) surface.add_vertex({p[0], p[1], p[2]});
  std::vector<bool> used(count, false);
  Collapsed result;
  std::vector<std::uint32_t> apart;
  for (std::uint32_t f = 0; f < set.triangles.size() / 3; ++f) {
    const std::uint32_t* corner = &set.triangles[3 * f];
    for (std::size_t c = 0; c < 3; ++c) {
      check(corner[c] < count, "triangle ", f, " has vertex ", corner[c], ", expected one below ", count);
      used[corner[c]] = true;
    }
    const auto handle = [&](std::size_t c) { return surface.vertex_handle(corner[c]); };
    const bool three = corner[0] != corner[1] && corner[1] != corner[2] && corner[2] != corner[0];
    const auto face = three ? surface.add_face(handle(0), handle(1), handle(2)) : Surface::InvalidFaceHandle;
    if (face.is_valid())
      surface.property(number, face) = f;
    else
      apart.push_back(f);
  }
  for (std::size_t v = 0; v < count; ++v)
    if (set.keep[v]) surface.status(surface.vertex_handle(static_cast<unsigned>(v))).set_locked(true);
  for (const std::uint32_t f : apart)
    for (std::size_t c = 0; c < 3; ++c)
      surface.status(surface.vertex_handle(set.triangles[3 * f + c])).set_locked(true);

  const auto in_use = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
  if (in_use > vertices) {
    OpenMesh::Decimater::DecimaterT<Surface> decimater(surface);
    PoseQuadrics::Handle handle;
    decimater.add(handle);
    decimater.module(handle).take(set);
    decimater.initialize();
    decimater.decimate(in_use - vertices);
  }
  result.faces = apart;
  for (const auto face : surface.all_faces())
    if (!surface.status(face).deleted()) result.faces.push_back(surface.property(number, face));
  std::sort(result.faces.begin(), result.faces.end());
  std::vector<OpenMesh::FaceHandle> handles(set.triangles.size() / 3);
  for (const auto face : surface.all_faces())
    if (!surface.status(face).deleted()) handles[surface.property(number, face)] = face;
  for (const std::uint32_t f : result.faces) {
    if (!handles[f].is_valid()) {
      result.triangles.insert(result.triangles.end(), &set.triangles[3 * f], &set.triangles[3 * f] + 3);
      continue;
    }
    for (const auto v : surface.fv_range(handles[f])) result.triangles.push_back(static_cast<std::uint32_t>(v.idx()));
  }
  return result;
}

}  // namespace face::meshik
