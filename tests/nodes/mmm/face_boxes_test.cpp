// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/face_boxes.h"

#include <gtest/gtest.h>

#include "nodes/mmm/crop.h"
#include "nodes/mmm/head_mask.h"
#include "nodes/mmm/paste.h"
#include "tests/support/expect_throw_text.h"

namespace face::mmm {
namespace {

// A clip's points: inner corners of the eyes 20 px apart, at (110, 80) and (130, 80).
Landmarks clip_points(double scale = 1, double x = 0, double y = 0) {
  Landmarks landmarks{{{"eye_inner_r", 110, 80, true},
                       {"eye_inner_l", 130, 80, true},
                       {"nose_tip", 120, 100, true},
                       {"lip_0", 105, 120, true},
                       {"lip_6", 135, 120, true},
                       {"chin", 120, 145, true}}};
  for (Landmark& p : landmarks.points) p.x_px = scale * p.x_px + x, p.y_px = scale * p.y_px + y;
  return landmarks;
}

void expect_box(const FaceBox& box, const FaceBox& expected) {
  EXPECT_NEAR(box.left, expected.left, 1e-9);
  EXPECT_NEAR(box.top, expected.top, 1e-9);
  EXPECT_NEAR(box.right, expected.right, 1e-9);
  EXPECT_NEAR(box.bottom, expected.bottom, 1e-9);
}

TEST(FaceBoxes, AreFoundByTheSixPointsOfAClip) {
  const FaceBoxes boxes = find_face_boxes(clip_points(), 320, 240);
  expect_box(boxes.head, {76, 32, 164, 145});
  expect_box(boxes.eyes, {85, 56, 155, 90});
  expect_box(boxes.mouth, {76, 100, 164, 240});
  expect_box(boxes.lower_face, {73, 93, 167, 165});
}

TEST(FaceBoxes, GoWithTheFace) {
  const FaceBoxes once = find_face_boxes(clip_points(), 320, 240),
                  twice = find_face_boxes(clip_points(2, 10, 20), 1000, 1000);
  for (const auto part : {&FaceBoxes::head, &FaceBoxes::eyes, &FaceBoxes::lower_face}) {
    const FaceBox& a = once.*part;
    expect_box(twice.*part, {2 * a.left + 10, 2 * a.top + 20, 2 * a.right + 10, 2 * a.bottom + 20});
  }
}

TEST(FaceBoxes, TakeTheSixtyEightPointsOfEitherSpelling) {
  Landmarks plain, padded;
  for (int i = 0; i < 68; ++i) {
    const double x = 100 + 7 * (i % 9), y = 50 + i;
    plain.points.push_back({std::to_string(i), x, y, true});
    padded.points.push_back({(i < 10 ? "0" : "") + std::to_string(i), x, y, true});
  }
  const FaceBoxes a = find_face_boxes(plain, 640, 480), b = find_face_boxes(padded, 640, 480);
  expect_box(a.head, b.head);
  expect_box(a.lower_face, b.lower_face);
  EXPECT_LT(a.head.top, 50) << "up to a brow's height above the brows";
}

TEST(FaceBoxes, KeepTheLowerFaceWithinThePicture) {
  const FaceBox box = find_face_boxes(clip_points(), 150, 150).lower_face;
  expect_box(box, {73, 93, 150, 150});
  EXPECT_THROW_TEXT(find_face_boxes(clip_points(1, 500, 0), 150, 150),
                    "the lower face lies outside the picture of 150 x 150 pixels: the chin is at 620, 145");
}

TEST(FaceBoxes, NameThePointThatIsMissing) {
  Landmarks landmarks = clip_points();
  landmarks.points.pop_back();
  EXPECT_THROW_TEXT(find_face_boxes(landmarks, 320, 240),
                    "landmark chin is missing: found eye_inner_r, eye_inner_l, nose_tip, lip_0, lip_6, expected "
                    "eye_inner_r, eye_inner_l, nose_tip, lip_0, lip_6 and chin, or the 68 of Multi-PIE");
  Landmarks one_eye = clip_points();
  one_eye.points[1] = {"eye_inner_l", 110, 80, true};
  EXPECT_THROW_TEXT(find_face_boxes(one_eye, 320, 240), "the inner corners of the eyes lie on one another at 110, 80");
}

TEST(FaceBoxes, AreWhereTheMaskIsBlackAndTheMouthIsCutOutAndPutBack) {
  Image head{320, 240, 3, std::vector<std::uint8_t>(320 * 240 * 3, 10)};
  const Landmarks points = clip_points();
  const Image mask = head_mask(head, &points);
  const auto on = [&](int x, int y) { return mask.pixels[static_cast<std::size_t>(y * 320 + x)] == 255; };
  EXPECT_TRUE(on(120, 45));
  EXPECT_TRUE(on(120, 95));
  EXPECT_FALSE(on(120, 70));
  EXPECT_FALSE(on(120, 120));
  Image mouth = crop(head, &points);
  EXPECT_EQ(mouth.width, 94);
  EXPECT_EQ(mouth.height, 72);
  std::fill(mouth.pixels.begin(), mouth.pixels.end(), std::uint8_t{200});
  std::vector<Image> frames;
  engine::SeqWriter<Image> writer([&](std::string, Image image) { frames.push_back(std::move(image)); });
  paste(engine::Seq<Image>({head}), engine::Seq<Image>({mouth}), &points, writer, {0, 0, 0, 60});
  const auto value = [&](int x, int y) { return frames[0].pixels[static_cast<std::size_t>((y * 320 + x) * 3)]; };
  EXPECT_EQ(value(73, 93), 200);
  EXPECT_EQ(value(72, 93), 10);
  EXPECT_EQ(value(166, 164), 200);
  EXPECT_EQ(value(166, 165), 10);
}

}  // namespace
}  // namespace face::mmm
