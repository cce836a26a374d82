// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/mark_landmarks.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/render/triangulate.h"
#include "nodes/types/arkit.h"

namespace face::transfer {
namespace {

using Eigen::Vector3d;

// Root mean square of what scale and shift leave of the places that both heads tell, in distances of the eyes: 0.04 of
// ICT-FaceKit's head upon the embedded one, 0.7 of a head that looks up, 1.5 of one that looks back.
constexpr double most_unlike = 0.3;

// Points 48 to 67 are the mouth's. Those of the upper lip's edges, and of the lower one's; between them its corners.
constexpr std::size_t first_of_mouth = 48;
bool of_upper_lip(std::size_t number) { return (number >= 49 && number <= 53) || (number >= 61 && number <= 63); }
bool of_lower_lip(std::size_t number) { return (number >= 55 && number <= 59) || number >= 65; }

Vector3d vector_of(const Vec3f& p) { return {p[0], p[1], p[2]}; }

const Shape& shape_of(const Rig& rig, const char* name) {
  const Shape& shape = rig.shapes.at(arkit_index(name));
  check(!shape.vertices.empty(), "the rig's landmarks cannot be found: it has no shape ", name);
  return shape;
}

double size_of(const Vec3f& offset) { return vector_of(offset).norm(); }

double largest_offset(const Shape& shape) {
  double largest = 0;
  for (const Vec3f& offset : shape.offsets_mm) largest = std::max(largest, size_of(offset));
  return largest;
}

// A head, where its vertices look, and what its jaw takes along.
struct Head {
  const Rig& rig;
  std::vector<Vec3f> normals;
  std::vector<double> jaw;  // motion under jawOpen, as a share of the largest

  Vector3d place(std::uint32_t vertex) const { return vector_of(rig.neutral.points_mm[vertex]); }
};

Head head_of(const Rig& rig) {
  Head head{rig, render::vertex_normals(rig.neutral.points_mm, render::triangulate(rig.neutral).triangles),
            std::vector<double>(rig.neutral.points_mm.size(), 0.0)};
  const Shape& jaw_open = shape_of(rig, "jawOpen");
  const double largest = largest_offset(jaw_open);
  check(largest > 0, "the rig's landmarks cannot be found: its jawOpen moves nothing");
  for (std::size_t i = 0; i < jaw_open.vertices.size(); ++i)
    head.jaw[jaw_open.vertices[i]] = size_of(jaw_open.offsets_mm[i]) / largest;
  return head;
}

struct Mouth {
  Vector3d middle;
  double width_mm = 0;  // between the outermost of three pairs of inner lips
};

Mouth mouth_of(const Head& head, const std::vector<LipPair>& pairs) {
  Mouth mouth{Vector3d::Zero(), 0};
  double right = std::numeric_limits<double>::max(), left = std::numeric_limits<double>::lowest();
  for (const LipPair& pair : pairs) {
    const Vector3d place = (head.place(pair.upper) + head.place(pair.lower)) / 2;
    mouth.middle += place / static_cast<double>(pairs.size());
    right = std::min(right, place.x());
    left = std::max(left, place.x());
  }
  mouth.width_mm = left - right;
  return mouth;
}

// Of the inner lips' landmarks.
std::vector<LipPair> landmark_pairs(const Rig& rig) {
  return {{rig.landmarks68[61], rig.landmarks68[67]},
          {rig.landmarks68[62], rig.landmarks68[66]},
          {rig.landmarks68[63], rig.landmarks68[65]}};
}

// Where an eye's lids are: the mean of what a blink moves, and how far it goes to either side.
void add_eye(const Head& head, const char* blink, std::vector<Vector3d>& places) {
  const Shape& shape = shape_of(head.rig, blink);
  Vector3d mean = Vector3d::Zero();
  double total = 0, squares = 0;
  for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
    const double weight = size_of(shape.offsets_mm[i]);
    mean += weight * head.place(shape.vertices[i]);
    total += weight;
  }
  check(total > 0, "the rig's landmarks cannot be found: its ", blink, " moves nothing");
  mean /= total;
  for (std::size_t i = 0; i < shape.vertices.size(); ++i)
    squares += size_of(shape.offsets_mm[i]) / total * std::pow(head.place(shape.vertices[i]).x() - mean.x(), 2);
  const Vector3d aside(1.7 * std::sqrt(squares), 0, 0);
  places.insert(places.end(), {mean - aside, mean, mean + aside});
}

// The most forward vertex near the middle of the face, from below to above, in heights from the mouth (0) to the eyes
// (1).
Vector3d most_forward(const Head& head, const Vector3d& mouth, const Vector3d& eyes, double below, double above) {
  const double height = eyes.y() - mouth.y(), half_width = 0.15 * height;
  Vector3d best(0, 0, std::numeric_limits<double>::lowest());
  for (std::uint32_t v = 0; v < head.rig.neutral.points_mm.size(); ++v) {
    const Vector3d place = head.place(v);
    const double at = (place.y() - mouth.y()) / height;
    if (std::abs(place.x() - mouth.x()) < half_width && at > below && at < above && place.z() > best.z()) best = place;
  }
  check(std::isfinite(best.z()) && best.z() > -1e9,
        "the rig's landmarks cannot be found: there is nothing between its mouth and eyes, or below the mouth");
  return best;
}

// The places that both heads tell, in one order.
std::vector<Vector3d> tell_places(const Head& head, const Mouth& mouth) {
  std::vector<Vector3d> places;
  add_eye(head, "eyeBlinkRight", places);
  add_eye(head, "eyeBlinkLeft", places);
  const Vector3d eyes = (places[1] + places[4]) / 2;
  check(eyes.y() > mouth.middle.y(), "the rig's landmarks cannot be found: its eyes are not above its mouth; is it ",
        "turned in its file?");
  places.push_back(mouth.middle);
  places.push_back(most_forward(head, mouth.middle, eyes, 0.15, 0.9));    // nose
  places.push_back(most_forward(head, mouth.middle, eyes, -0.9, -0.35));  // chin
  return places;
}

// The scale and shift that lay places upon others. Both heads look to +z.
struct Laying {
  double scale = 1;
  Vector3d from = Vector3d::Zero(), to = Vector3d::Zero();
  Vector3d operator()(const Vector3d& p) const { return to + scale * (p - from); }
};

Laying laying_of(const std::vector<Vector3d>& from, const std::vector<Vector3d>& to) {
  Laying lay;
  for (std::size_t i = 0; i < from.size(); ++i) {
    lay.from += from[i] / static_cast<double>(from.size());
    lay.to += to[i] / static_cast<double>(from.size());
  }
  double here = 0, there = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    there += (from[i] - lay.from).squaredNorm();
    here += (to[i] - lay.to).squaredNorm();
  }
  lay.scale = std::sqrt(here / there);
  return lay;
}

}  // namespace

Rig mark_landmarks(const Rig& rig, const Rig& reference) {
  if (rig.landmarks68.size() == 68) return rig;
  check(reference.landmarks68.size() == 68, "the reference has ", reference.landmarks68.size(),
        " landmarks, expected 68");
  check(rig.inner_lips.size() >= 3, "the rig's landmarks cannot be found: it has ", rig.inner_lips.size(),
        " pairs of inner lips, expected at least 3 that jawOpen parts");
  const Head head = head_of(rig), other = head_of(reference);
  const std::vector<LipPair>& pairs = rig.inner_lips;
  const Mouth mouth = mouth_of(head, pairs), other_mouth = mouth_of(other, landmark_pairs(reference));
  check(mouth.width_mm > 0 && other_mouth.width_mm > 0,
        "the rig's landmarks cannot be found: its inner lips lie above each other");
  const std::vector<Vector3d> from = tell_places(other, other_mouth), to = tell_places(head, mouth);
  const Laying lay = laying_of(from, to);
  double squares = 0;
  for (std::size_t i = 0; i < from.size(); ++i)
    squares += (lay(from[i]) - to[i]).squaredNorm() / static_cast<double>(from.size());
  const double unlike = std::sqrt(squares) / (to[1] - to[4]).norm();
  check(unlike < most_unlike, "the rig's landmarks cannot be found: its eyes, nose, mouth and chin lie ",
        std::round(100 * unlike) / 100,
        " distances of the eyes from where those of a head do that is upright and looks to +z, expected at most ",
        most_unlike, "; is it turned in its file?");
  const double near_mm = 0.1 * (to[1] - to[4]).norm();

  const auto carry = [&](std::size_t number) {
    const Vector3d there = other.place(reference.landmarks68[number]);
    if (number >= first_of_mouth) {
      Vector3d about = there - other_mouth.middle;
      about.x() *= mouth.width_mm / (other_mouth.width_mm * lay.scale);
      return Vector3d(mouth.middle + lay.scale * about);
    }
    Vector3d moved = lay(there), left = Vector3d::Zero();
    double total = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
      const double weight = 1 / ((lay(from[i]) - moved).squaredNorm() + near_mm * near_mm);
      left += weight * (to[i] - lay(from[i]));
      total += weight;
    }
    moved += left / total;
    return moved;
  };

  Rig marked = rig;
  marked.landmarks68.clear();
  for (std::size_t number = 0; number < 68; ++number) {
    const Vector3d wanted = carry(number);
    const Vector3d looks = vector_of(other.normals[reference.landmarks68[number]]);
    std::uint32_t best = 0;
    double least = std::numeric_limits<double>::max();
    for (std::uint32_t v = 0; v < rig.neutral.points_mm.size(); ++v) {
      if (vector_of(head.normals[v]).dot(looks) < 0.3) continue;
      if (of_upper_lip(number) && head.jaw[v] > 0.4) continue;
      if (of_lower_lip(number) && head.jaw[v] < 0.4) continue;
      const double distance = (head.place(v) - wanted).squaredNorm();
      if (distance < least) least = distance, best = v;
    }
    check(least < std::numeric_limits<double>::max(), "the rig's landmark ", number,
          " cannot be found: no vertex looks as it does");
    marked.landmarks68.push_back(best);
  }
  // From right to left: the outermost pairs and the one nearest to the middle.
  for (std::size_t k = 0; k < 3; ++k) {
    const double wanted = mouth.middle.x() + (static_cast<double>(k) - 1) * mouth.width_mm / 2;
    const LipPair& pair = *std::min_element(pairs.begin(), pairs.end(), [&](const LipPair& a, const LipPair& b) {
      return std::abs(head.place(a.lower).x() - wanted) < std::abs(head.place(b.lower).x() - wanted);
    });
    marked.landmarks68[61 + k] = pair.upper;
    marked.landmarks68[67 - k] = pair.lower;
  }
  return marked;
}

}  // namespace face::transfer
