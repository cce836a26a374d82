// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/shut_lids.h"

#include <limits>
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

}  // namespace

void shut_lids(const Rig& rig, Rig& person) {
  for (const char* name : {"eyeBlinkLeft", "eyeBlinkRight"}) {
    const std::size_t s = arkit_index(name);
    if (s >= rig.shapes.size()) continue;
    const Shape& before = rig.shapes[s];
    Shape& after = person.shapes[s];
    const std::vector<Meeting> meetings = find_meetings(rig, person, before, after);
    if (meetings.empty()) continue;
    for (std::size_t k = 0; k < before.vertices.size(); ++k) {
      const Vector3 offset = to_vector(before.offsets_mm[k]), at = to_vector(rig.neutral.points_mm[before.vertices[k]]);
      if (offset.y > -0.05) continue;  // the lower lid waits
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
  }
}

}  // namespace face::phantom
