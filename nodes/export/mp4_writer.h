// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "nodes/types/image.h"

namespace face::exports {

// An MP4 file, by FFmpeg's libraries: in memory, or on disk where it is given a path.
class Mp4Writer {
 public:
  struct Settings {
    int width_px = 0;  // of the pictures that come; the file's are even
    int height_px = 0;
    int channels = 3;
    double mean_rate_hz = 25;  // a hint for the encoder
    int quality = 18;
    int audio_rate_hz = 0;  // 0: no sound
    int audio_kbit_per_s = 96;
    std::string path;  // of the file to write; empty: in memory
  };
  explicit Mp4Writer(const Settings& settings);
  ~Mp4Writer();
  Mp4Writer(const Mp4Writer&) = delete;
  Mp4Writer& operator=(const Mp4Writer&) = delete;

  void add_picture(const Image& image, double start_s, double end_s);
  void add_sound(const float* samples, std::int64_t count);
  // Writes what encoders still hold, and the index. Once, at the end. Returns the bytes of a file in memory.
  std::string finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace face::exports
