// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/pick_frames.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/expect_throw_text.h"

namespace face::model {
namespace {

Image grey(std::uint8_t value) { return {1, 1, 1, {value}}; }

std::string picked(const std::vector<std::string>& ids) {
  std::string out;
  engine::SeqWriter<Image> writer(
      [&](const std::string& id, const Image& image) { out += id + ":" + std::to_string(image.pixels.at(0)) + " "; });
  const engine::Seq<Image> clip({grey(10), grey(11), grey(12), grey(13)}, {"0", "1", "2", "3"});
  pick_frames(clip, engine::Seq<Landmarks>(std::vector<Landmarks>(ids.size()), ids), writer);
  return out;
}

TEST(PickFrames, TakesThoseThatPointsWerePlacedOn) { EXPECT_EQ(picked({"0", "2"}), "0:10 2:12 "); }

TEST(PickFrames, KeepsTheOrderOfThePoints) { EXPECT_EQ(picked({"3", "1"}), "3:13 1:11 "); }

TEST(PickFrames, NamesAFrameThatTheClipDoesNotHave) {
  EXPECT_THROW_TEXT(picked({"0", "44"}), "landmarks are of frame 44, but frames has 4 frames and none with this id");
}

}  // namespace
}  // namespace face::model
