// SPDX-License-Identifier: Apache-2.0
// What the tests of the embedded head measure on it.
#pragma once
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nodes/types/rig.h"

namespace probe {

// The head under test, made once.
const face::Rig& head();

// Weights of shapes by their ARKit names.
using Pose = std::initializer_list<std::pair<std::string_view, float>>;
std::vector<face::Vec3f> posed(Pose pose);

double distance(const face::Vec3f& a, const face::Vec3f& b);
// Ascending.
std::vector<std::uint32_t> part_vertices(std::string_view part);
std::string part_of(std::size_t polygon);
// Volume below a part's polygons as seen from the part's centroid, mm^3.
double signed_volume(std::string_view part);

// Vertical distances between the lips at the inner pairs: the largest, the smallest.
double widest_lip_gap(const std::vector<face::Vec3f>& points);
double narrowest_lip_gap(const std::vector<face::Vec3f>& points);
// Smallest distance of the lower lip's vertices to those of the upper front teeth.
double lip_to_teeth(const std::vector<face::Vec3f>& points);

}  // namespace probe
