// SPDX-License-Identifier: Apache-2.0
// Runs the command as a person would, in a folder of its own with a store of its own.
#pragma once
#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/toy_run.h"

extern char** environ;

namespace test {

using Words = std::vector<std::string>;

inline Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// The row of a table of numbers whose first cell is `name`, by column; nothing where there is none.
inline std::map<std::string, double> row_of(const std::string& csv, const std::string& name) {
  const std::vector<std::string> lines = lines_of(csv);
  std::map<std::string, double> values;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::istringstream columns(lines[0]), cells(lines[i]);
    std::string column, cell;
    std::getline(columns, column, ',');
    std::getline(cells, cell, ',');
    if (cell != name) continue;
    while (std::getline(columns, column, ','))
      if (std::getline(cells, cell, ',') && !cell.empty()) values[column] = std::stod(cell);
  }
  return values;
}

struct Ended {
  int code = -1;       // 128 + N where signal N ended it
  std::string output;  // both streams

  // What the lines that begin so say, without the key at their end.
  std::vector<std::string> said(const std::string& start) const {
    std::vector<std::string> found;
    for (const std::string& line : lines_of(output)) {
      if (!line.starts_with(start)) continue;
      std::string text = line.substr(start.size());
      if (text.ends_with("]")) text = text.substr(0, text.rfind(" [key "));
      found.push_back(text);
    }
    return found;
  }
  std::vector<std::string> failures() const { return said("failed: "); }
  std::vector<std::string> warnings() const { return said("warning: "); }
};

// Mono or interleaved samples in [-1, 1] as PCM of 8 or 16 bits.
inline std::string wav_of(const std::vector<double>& samples, int channels = 1, int bits = 16, int rate_hz = 16000) {
  std::string out;
  const auto put = [&](std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
  };
  const auto size = static_cast<std::uint64_t>(samples.size()) * static_cast<std::uint64_t>(bits / 8);
  const auto frame = static_cast<std::uint64_t>(channels * bits / 8);
  out += "RIFF";
  put(36 + size, 4);
  out += "WAVEfmt ";
  put(16, 4), put(1, 2), put(static_cast<std::uint64_t>(channels), 2), put(static_cast<std::uint64_t>(rate_hz), 4);
  put(static_cast<std::uint64_t>(rate_hz) * frame, 4), put(frame, 2), put(static_cast<std::uint64_t>(bits), 2);
  out += "data";
  put(size, 4);
  for (const double x : samples) {
    if (bits == 8)
      put(static_cast<std::uint64_t>(std::lround(128 + 127 * x)), 1);
    else
      put(static_cast<std::uint64_t>(static_cast<std::int64_t>(std::lround(32767 * x))), 2);
  }
  return out;
}

class CommandTest : public ::testing::Test {
 protected:
  std::filesystem::path folder() const { return folder_.path(); }
  std::string path(const std::string& name) const { return (folder() / name).string(); }
  static std::string graph(const std::string& name) { return std::string(FACEGRAPH_SOURCE_DIR) + "/graphs/" + name; }

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder() / name).parent_path());
    std::ofstream(folder() / name, std::ios::binary) << text;
  }
  std::string read(const std::string& name) const { return read_file(folder() / name); }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder() / name); }

  // Starts it in the folder; what it says goes to the file said.txt.
  pid_t start(const Words& words, std::string program = FACEGRAPH_COMMAND) const {
    Words all = {program};
    if (program == FACEGRAPH_COMMAND && (words.empty() || words[0] != "--store"))
      all = all + Words{"--store", path("store")};
    all = all + words;
    std::vector<char*> arguments;
    for (std::string& word : all) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, 1, path("said.txt").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::posix_spawn_file_actions_adddup2(&actions, 1, 2);
    ::posix_spawn_file_actions_addchdir_np(&actions, folder().c_str());
    pid_t child = -1;
    const int error = ::posix_spawn(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    EXPECT_EQ(error, 0) << "cannot start " << program;
    return error == 0 ? child : -1;
  }
  Ended wait(pid_t child) const {
    Ended ended;
    int status = 0;
    if (child < 0 || ::waitpid(child, &status, 0) != child) return ended;
    ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    ended.output = read("said.txt");
    return ended;
  }
  Ended command(const Words& words) const { return wait(start(words)); }

  const TemporaryFolder folder_;
};

}  // namespace test
