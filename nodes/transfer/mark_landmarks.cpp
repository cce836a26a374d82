// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/mark_landmarks.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/eigen_vector.h"
#include "nodes/render/triangulate.h"
#include "nodes/types/arkit.h"

namespace face::transfer {
namespace {

using Eigen::Vector3d;

// Root mean square of what scale and shift leave of the places that both heads tell, in distances of the eyes: 0.04 of
// ICT-FaceKit's head upon the embedded one, 0.7 of a head that looks up, 1.5 of one that looks back.
constexpr double most_unlike = 0.3;

// The middle of the face, and where its nose and its chin are looked for: in heights from the mouth (0) to the eyes
// (1).
constexpr double middle_half_width = 0.15;
constexpr std::array<double, 2> nose_heights = {0.15, 0.9}, chin_heights = {-0.9, -0.35};

constexpr double shepard_radius = 0.1;      // distances of the eyes: nearer places count alike
constexpr double least_facing = 0.3;        // cosine between the normals of a landmark here and there
constexpr double least_of_lower_lip = 0.4;  // of the jaw's largest motion: lower lips move by more, upper ones by less

// Points 48 to 67 are the mouth's. Those of the upper lip's edges, and of the lower one's; between them its corners.
constexpr std::size_t first_of_mouth = 48;
bool of_upper_lip(std::size_t number) { return (number >= 49 && number <= 53) || (number >= 61 && number <= 63); }
bool of_lower_lip(std::size_t number) { return (number >= 55 && number <= 59) || number >= 65; }

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

// Where an eye's lids are: the mean of what a blink moves, and how far it goes to either side, were it spread evenly.
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
  const Vector3d aside(std::sqrt(3 * squares), 0, 0);
  places.insert(places.end(), {mean - aside, mean, mean + aside});
}

// The most forward vertex near the middle of the face, between two heights.
Vector3d most_forward(const Head& head, const Vector3d& mouth, const Vector3d& eyes,
                      const std::array<double, 2>& heights) {
  const double height = eyes.y() - mouth.y(), half_width = middle_half_width * height;
  constexpr double nowhere = std::numeric_limits<double>::lowest();
  Vector3d best(0, 0, nowhere);
  for (std::uint32_t v = 0; v < head.rig.neutral.points_mm.size(); ++v) {
    const Vector3d place = head.place(v);
    const double at = (place.y() - mouth.y()) / height;
    if (std::abs(place.x() - mouth.x()) < half_width && at > heights[0] && at < heights[1] && place.z() > best.z())
      best = place;
  }
  check(best.z() > nowhere,
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
  places.push_back(most_forward(head, mouth.middle, eyes, nose_heights));
  places.push_back(most_forward(head, mouth.middle, eyes, chin_heights));
  return places;
}

// Between the middles of the lids.
double eye_distance(const std::vector<Vector3d>& places) { return (places[1] - places[4]).norm(); }

// Takes places of one head to another: the scale and shift that lay those that both tell upon each other, and what is
// left of these, shared out by distance. Both heads look to +z.
class Carrying {
 public:
  Carrying(const std::vector<Vector3d>& from, const std::vector<Vector3d>& to) {
    const auto count = static_cast<double>(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
      from_ += from[i] / count;
      to_ += to[i] / count;
    }
    double here = 0, there = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
      there += (from[i] - from_).squaredNorm();
      here += (to[i] - to_).squaredNorm();
    }
    scale_ = std::sqrt(here / there);
    double squares = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
      laid_.push_back(lay(from[i]));
      left_.emplace_back(to[i] - laid_[i]);
      squares += left_[i].squaredNorm() / count;
    }
    unlike_ = std::sqrt(squares) / eye_distance(to);
    radius_mm_ = shepard_radius * eye_distance(to);
  }

  double scale() const { return scale_; }
  double unlike() const { return unlike_; }  // what scale and shift leave, in distances of the eyes

  Vector3d operator()(const Vector3d& place) const {
    const Vector3d laid = lay(place);
    Vector3d left = Vector3d::Zero();
    double total = 0;
    for (std::size_t i = 0; i < laid_.size(); ++i) {
      const double weight = 1 / ((laid_[i] - laid).squaredNorm() + radius_mm_ * radius_mm_);
      left += weight * left_[i];
      total += weight;
    }
    return laid + left / total;
  }

 private:
  Vector3d lay(const Vector3d& place) const { return to_ + scale_ * (place - from_); }

  double scale_ = 1, unlike_ = 0, radius_mm_ = 0;
  Vector3d from_ = Vector3d::Zero(), to_ = Vector3d::Zero();
  std::vector<Vector3d> laid_, left_;
};

// The nearest vertex to a landmark's place that looks as the landmark does, on its lip.
std::uint32_t vertex_at(const Head& head, std::size_t number, const Vector3d& place, const Vector3d& looks) {
  std::uint32_t best = 0;
  double least = std::numeric_limits<double>::max();
  for (std::uint32_t v = 0; v < head.rig.neutral.points_mm.size(); ++v) {
    if (vector_of(head.normals[v]).dot(looks) < least_facing) continue;
    if (of_upper_lip(number) && head.jaw[v] > least_of_lower_lip) continue;
    if (of_lower_lip(number) && head.jaw[v] < least_of_lower_lip) continue;
    const double distance = (head.place(v) - place).squaredNorm();
    if (distance < least) least = distance, best = v;
  }
  check(least < std::numeric_limits<double>::max(), "the rig's landmark ", number,
        " cannot be found: no vertex looks as it does");
  return best;
}

// The inner lips' landmarks, from right to left: of the rig's pairs the outermost ones and the nearest to the middle.
void mark_inner_lips(const Head& head, const Mouth& mouth, std::vector<std::uint32_t>& landmarks) {
  const std::vector<LipPair>& pairs = head.rig.inner_lips;
  for (std::size_t k = 0; k < 3; ++k) {
    const double wanted = mouth.middle.x() + (static_cast<double>(k) - 1) * mouth.width_mm / 2;
    const LipPair& pair = *std::min_element(pairs.begin(), pairs.end(), [&](const LipPair& a, const LipPair& b) {
      return std::abs(head.place(a.lower).x() - wanted) < std::abs(head.place(b.lower).x() - wanted);
    });
    landmarks[61 + k] = pair.upper;
    landmarks[67 - k] = pair.lower;
  }
}

}  // namespace

Rig mark_landmarks(const Rig& rig, const Rig& reference) {
  if (rig.landmarks68.size() == 68) return rig;
  check(reference.landmarks68.size() == 68, "the reference has ", reference.landmarks68.size(),
        " landmarks, expected 68");
  check(rig.inner_lips.size() >= 3, "the rig's landmarks cannot be found: it has ", rig.inner_lips.size(),
        " pairs of inner lips, expected at least 3 that jawOpen parts");
  const Head head = head_of(rig), other = head_of(reference);
  const Mouth mouth = mouth_of(head, rig.inner_lips), other_mouth = mouth_of(other, landmark_pairs(reference));
  check(mouth.width_mm > 0 && other_mouth.width_mm > 0,
        "the rig's landmarks cannot be found: its inner lips lie above each other");
  const Carrying carry(tell_places(other, other_mouth), tell_places(head, mouth));
  check(carry.unlike() < most_unlike, "the rig's landmarks cannot be found: its eyes, nose, mouth and chin lie ",
        std::round(100 * carry.unlike()) / 100,
        " distances of the eyes from where those of a head do that is upright and looks to +z, expected at most ",
        most_unlike, "; is it turned in its file?");

  // The mouth's go as far sideways as the inner lips lie apart.
  const auto carry_mouth = [&](const Vector3d& place) -> Vector3d {
    Vector3d about = carry.scale() * (place - other_mouth.middle);
    about.x() = mouth.width_mm / other_mouth.width_mm * (place - other_mouth.middle).x();
    return mouth.middle + about;
  };
  Rig marked = rig;
  marked.landmarks68.clear();
  for (std::size_t number = 0; number < 68; ++number) {
    const std::uint32_t vertex = reference.landmarks68[number];
    const Vector3d there = other.place(vertex);
    marked.landmarks68.push_back(vertex_at(head, number, number < first_of_mouth ? carry(there) : carry_mouth(there),
                                           vector_of(other.normals[vertex])));
  }
  mark_inner_lips(head, mouth, marked.landmarks68);
  return marked;
}

}  // namespace face::transfer
