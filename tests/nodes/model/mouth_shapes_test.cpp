// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/mouth_shapes.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "nodes/base/mouth.h"
#include "nodes/base/pose.h"
#include "nodes/phantom/make_head.h"

namespace {

using namespace face;

std::map<std::string, Weights> shapes_of(const Rig& rig) {
  std::map<std::string, Weights> shapes;
  engine::SeqWriter<Weights> writer([&](const std::string& id, Weights weights) { shapes[id] = std::move(weights); });
  model::mouth_shapes(rig, writer);
  return shapes;
}

TEST(MouthShapes, AreFiveOfWhichTheClosedOneIsTheNeutralFace) {
  const Rig rig = phantom::make_head();
  const std::map<std::string, Weights> shapes = shapes_of(rig);
  std::string names;
  for (const auto& [name, weights] : shapes) names += name + " ";
  EXPECT_EQ(names, "closed open round smile wide ");
  EXPECT_EQ(pose_points(rig, shapes.at("closed")), rig.neutral.points_mm);
}

TEST(MouthShapes, OpenLipsAreApart) {
  const Rig rig = phantom::make_head();
  const std::vector<Vec3f> points = pose_points(rig, shapes_of(rig).at("open"));
  const LipPair pair = rig.inner_lips.at(rig.inner_lips.size() / 2);
  EXPECT_GT(points[pair.upper][1] - points[pair.lower][1], 5);
}

}  // namespace
