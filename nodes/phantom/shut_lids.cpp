// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/shut_lids.h"

#include <limits>
#include <string_view>
#include <vector>

#include "nodes/phantom/face_places.h"
#include "nodes/types/arkit.h"

namespace face::phantom {
namespace {

// A place of the upper lid's edge that meets the lower lid.
struct Meeting {
  Vector3 at;       // at rest, on the rig
  Vector3 missing;  // what the person's blink must add
  double moved_mm;  // by the rig's blink
};

constexpr double kMeeting_mm = 1.0;  // nearer than this when shut...
constexpr double kApart_mm = 3.0;    // and farther apart than this when open

std::vector<Meeting> find_meetings(const Rig& rig, const Rig& person, const Shape& before, const Shape& after) {
  std::vector<Vector3> shut;
  for (std::size_t k = 0; k < before.vertices.size(); ++k)
    shut.push_back(to_vector(rig.neutral.points_mm[before.vertices[k]]) + to_vector(before.offsets_mm[k]));
  std::vector<Meeting> meetings;
  for (std::size_t k = 0; k < shut.size(); ++k) {
    const Vector3 offset = to_vector(before.offsets_mm[k]), rest = shut[k] - offset;
    if (offset.y > -kApart_mm) continue;  // not the upper lid
    std::size_t partner = k;
    double nearest = kMeeting_mm;
    for (std::size_t j = 0; j < shut.size(); ++j) {
      const Vector3 other = shut[j] - to_vector(before.offsets_mm[j]);
      if (before.offsets_mm[j][1] < 0.3f * before.offsets_mm[k][1]) continue;
      if (other.y > rest.y - kApart_mm || length(shut[j] - shut[k]) >= nearest) continue;
      nearest = length(shut[j] - shut[k]);
      partner = j;
    }
    if (partner == k) continue;
    const auto of_person = [&](std::size_t i) {
      return to_vector(person.neutral.points_mm[after.vertices[i]]) + to_vector(after.offsets_mm[i]);
    };
    const Vector3 missing = (shut[k] - shut[partner]) - (of_person(k) - of_person(partner));
    meetings.push_back({rest, missing, length(offset)});
  }
  return meetings;
}

struct Ball {
  Vector3 centre;
  double radius = 0;
};

// The sphere that fits an eyeball's vertices best: |p|^2 = 2 c p + k is linear in c and k (Coope, Circle Fitting by
// Linear and Nonlinear Least Squares, Journal of Optimization Theory and Applications, 1993). Radius 0 where there is
// no eyeball.
Ball fit_ball(const Mesh& mesh, std::string_view side) {
  const std::vector<std::size_t> parts = vertex_parts(mesh);
  std::vector<Vector3> points;
  Vector3 mean;
  for (std::size_t v = 0; v < parts.size(); ++v)
    if (parts[v] < mesh.parts.size() && mesh.parts[parts[v]].name.starts_with("sclera_") &&
        is_eyeball(mesh.parts[parts[v]].name, side)) {
      points.push_back(to_vector(mesh.points_mm[v]));
      mean += points.back();
    }
  if (points.size() < 4) return {};
  mean = mean * (1 / static_cast<double>(points.size()));
  // About their mean, k and c part: (sum d d^T) 2 c = sum |d|^2 d, and k is the mean of |d|^2.
  Vector3 rows[3], right;
  double squares = 0;
  for (const Vector3& p : points) {
    const Vector3 d = p - mean;
    rows[0] += d.x * d;
    rows[1] += d.y * d;
    rows[2] += d.z * d;
    right += 0.5 * dot(d, d) * d;
    squares += dot(d, d) / static_cast<double>(points.size());
  }
  const Vector3 c0 = cross(rows[1], rows[2]), c1 = cross(rows[2], rows[0]), c2 = cross(rows[0], rows[1]);
  const double det = dot(rows[0], c0);
  if (std::abs(det) < 1e-6) return {};
  const Vector3 centre = (1 / det) * (right.x * c0 + right.y * c1 + right.z * c2);
  return {mean + centre, std::sqrt(squares + dot(centre, centre))};
}

// Lifts the shut lids of a person off its eyeball.
void clear_ball(const Rig& rig, const Rig& person, const Shape& before, std::string_view side, Shape& after) {
  const Ball of_rig = fit_ball(rig.neutral, side), of_person = fit_ball(person.neutral, side);
  if (of_rig.radius == 0 || of_person.radius == 0) return;
  constexpr double kNear = 1.5;  // in radii: skin farther out is no lid
  for (std::size_t k = 0; k < before.vertices.size(); ++k) {
    const std::uint32_t v = before.vertices[k];
    const Vector3 was = to_vector(rig.neutral.points_mm[v]) + to_vector(before.offsets_mm[k]) - of_rig.centre;
    const double wanted = length(was) / of_rig.radius;
    const Vector3 is = to_vector(person.neutral.points_mm[v]) + to_vector(after.offsets_mm[k]) - of_person.centre;
    const double missing_mm = wanted * of_person.radius - length(is);
    if (wanted > kNear || missing_mm < 2e-4) continue;
    after.offsets_mm[k] =
        to_float(to_vector(after.offsets_mm[k]) + smooth_step(kNear, 1.25, wanted) * missing_mm * unit(is));
  }
}

}  // namespace

void shut_lids(const Rig& rig, Rig& person) {
  for (const char* side : {"left", "right"}) {
    const std::size_t s = arkit_index(side == std::string_view("left") ? "eyeBlinkLeft" : "eyeBlinkRight");
    if (s >= rig.shapes.size()) continue;
    const Shape& before = rig.shapes[s];
    Shape& after = person.shapes[s];
    const std::vector<Meeting> meetings = find_meetings(rig, person, before, after);
    for (std::size_t k = 0; k < before.vertices.size(); ++k) {
      const Vector3 offset = to_vector(before.offsets_mm[k]), at = to_vector(rig.neutral.points_mm[before.vertices[k]]);
      if (meetings.empty() || offset.y > -0.05) continue;  // the lower lid waits
      Vector3 sum;
      double weights = 0, nearest = std::numeric_limits<double>::infinity();
      for (const Meeting& meeting : meetings) nearest = std::min(nearest, std::abs(meeting.at.x - at.x));
      for (const Meeting& meeting : meetings) {
        const double weight = bell(std::abs(meeting.at.x - at.x) - nearest, 0.8);
        sum += weight * std::min(1.0, length(offset) / meeting.moved_mm) * meeting.missing;
        weights += weight;
      }
      sum = sum * (1 / weights);
      if (length(sum) < 2e-4) continue;  // rounding of float positions
      after.offsets_mm[k] = to_float(to_vector(after.offsets_mm[k]) + sum);
    }
    clear_ball(rig, person, before, side, after);
  }
}

}  // namespace face::phantom
