// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/model/face_pose.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/morphable_model.h"

namespace face::model {

// What of a model the named points of a picture touch: their vertices, and those that may come to lie on the outline of
// cheek and jaw.
struct LandmarkBasis {
  struct Point {
    std::string name;
    double x_px = 0, y_px = 0;
    bool contour = false;
    std::size_t vertex = 0;  // local; of a contour point: the present one
  };
  std::size_t identities = 0, expressions = 0;
  std::vector<Point> points;
  std::vector<std::uint32_t> vertices;                  // local to the model's
  std::vector<Vec3f> mean_mm;                           // local
  std::vector<float> modes;                             // local x 3 x (identities + expressions)
  std::vector<std::array<std::uint32_t, 3>> triangles;  // local, around the candidates
  std::vector<std::uint32_t> candidates;                // local, for contour points
  std::size_t eye_r = 0, eye_l = 0;                     // local: outer corners of the eyes
  bool has_eyes = false;

  std::size_t coefficients() const { return identities + expressions; }
};

// The valid points, by name_landmark.
LandmarkBasis make_landmark_basis(const MorphableModel& model, const Landmarks& landmarks, std::size_t identities,
                                  std::size_t expressions);

// Local vertices at these coefficients (identity, then expression).
std::vector<Vec3f> posed(const LandmarkBasis& basis, const std::vector<double>& coefficients);

// Gives every contour point the candidate that is seen nearest to it among those whose normal is all but orthogonal to
// the line of sight (Blanz et al. 2003, section 3.1). One that has none near stays where it is.
void assign_contours(const std::vector<Vec3f>& posed_mm, const FacePose& pose, LandmarkBasis& basis);

// How far the model's points are from the picture's, px, and the derivatives of that. Row 2i is x of point i, 2i + 1 y;
// columns: pose, identity, expression.
struct LandmarkRows {
  std::size_t columns = 0;
  std::vector<double> jacobian;
  std::vector<double> residual_px;
};
LandmarkRows landmark_rows(const LandmarkBasis& basis, const std::vector<Vec3f>& posed_mm, const FacePose& pose);

// Distance of the outer corners of the eyes if the head looked into the camera, px; of a model without landmarks 90 mm.
double eye_distance_px(const LandmarkBasis& basis, const std::vector<Vec3f>& posed_mm, const FacePose& pose);

}  // namespace face::model
