// SPDX-License-Identifier: Apache-2.0
#include "engine/run/values.h"

#include <filesystem>
#include <fstream>

#include "tests/engine/store/store_fixture.h"
#include "tests/support/toy_run.h"

namespace {

namespace fs = std::filesystem;
using RunValues = test::StoreTest;

std::string written(const std::string& path) {
  fs::create_directories(fs::path(path).parent_path());
  std::ofstream(path) << "what somebody recorded";
  return path;
}

TEST_F(RunValues, AFileThatANodeWasGivenAndGivesBackStaysWhereItIs) {
  const auto store = open();
  const std::string path = written(base_ + "/recording.wav");
  for (int round = 0; round < 2; ++round) {  // the second time the store has it already
    engine::run::encode_value(engine::Value::of(engine::File::at(path)), *store);
    EXPECT_EQ(test::read_file(path), "what somebody recorded") << round;
  }
  EXPECT_TRUE(fs::is_empty(engine::run::scratch_root(*store)));
}

TEST_F(RunValues, AFileOfATasksOwnIsMoved) {
  const auto store = open();
  const std::string path = written(engine::run::scratch_root(*store) + "/task/video.mp4");
  engine::run::encode_value(engine::Value::of(engine::File::at(path)), *store);
  EXPECT_FALSE(fs::exists(path));
}

}  // namespace
