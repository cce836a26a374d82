// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "engine/store/store.h"

namespace test {

// A store's folder that is removed afterwards.
class StoreTest : public ::testing::Test {
 protected:
  StoreTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "store_test.XXXXXX").string();
    base_ = mkdtemp(pattern.data());
    folder_ = base_ + "/store";
  }
  ~StoreTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(base_, ignored);
  }
  std::shared_ptr<engine::Store> open() const { return engine::Store::open(folder_); }

  std::string base_, folder_;
};

inline engine::Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }
inline engine::Digest digest_of_bytes(const engine::Bytes& bytes) {
  return engine::digest_of(std::span<const std::uint8_t>(bytes));
}

// Bytes that compress by about a half, as images and meshes do.
inline engine::Bytes noise(std::size_t size, unsigned seed = 1) {
  std::mt19937 generator(seed);
  engine::Bytes bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(generator() & 15);
  return bytes;
}

// A finished task with one single output, known by its number.
inline engine::TaskRecord record_of(int number) {
  engine::TaskRecord record;
  record.key = engine::digest_of("task " + std::to_string(number));
  record.outputs = {{false, {{"", engine::digest_of("value " + std::to_string(number))}}}};
  record.parts = {{"parameter levels", std::to_string(number), ""}, {"input frames", record.key.hex(), "frames[17]"}};
  record.warnings = {"low light"};
  record.seconds = 0.25;
  return record;
}

inline bool equal(const std::vector<engine::OutputRecord>& a, const std::vector<engine::OutputRecord>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].sequence != b[i].sequence || a[i].elements.size() != b[i].elements.size()) return false;
    for (std::size_t j = 0; j < a[i].elements.size(); ++j)
      if (a[i].elements[j].id != b[i].elements[j].id || a[i].elements[j].identity != b[i].elements[j].identity)
        return false;
  }
  return true;
}

inline std::string object_path(const std::string& folder, const engine::Digest& digest) {
  return folder + "/objects/" + digest.hex().substr(0, 2) + "/" + digest.hex().substr(2);
}

// Makes a file look as if it was used last so long ago.
inline void age(const std::string& path, double seconds) {
  timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  const timespec times[2] = {{now.tv_sec - static_cast<time_t>(seconds), 0},
                             {now.tv_sec - static_cast<time_t>(seconds), 0}};
  ASSERT_EQ(utimensat(AT_FDCWD, path.c_str(), times, 0), 0) << path;
}

inline std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
inline void write(const std::string& path, std::string_view text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

}  // namespace test
