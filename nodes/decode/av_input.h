// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

struct AVFormatContext;
struct AVCodecContext;
struct AVStream;
struct AVFrame;

namespace face::decode {

// One stream of a media file, decoded in order by FFmpeg's libraries with a fixed number of threads: the same frames
// every time.
class AvInput {
 public:
  enum class Kind { audio, video };

  // Throws where the file cannot be opened, is no media file, or has no stream of the kind.
  AvInput(const std::string& path, std::string title, Kind kind);
  ~AvInput();
  AvInput(const AvInput&) = delete;
  AvInput& operator=(const AvInput&) = delete;

  // Calls once per decoded frame, in display order. Throws at data that cannot be decoded, with the byte.
  void for_each_frame(const std::function<void(const AVFrame&)>& use);
  // The same until `use` says false.
  void for_frames_while(const std::function<bool(const AVFrame&)>& use);
  // The same from the last key frame at or before a time of time_s() on. False, without a frame, where the container
  // keeps no time of its own for every frame and thus cannot be sought in (all but MP4, MOV, MKV and WebM), or where no
  // key frame is found.
  bool for_frames_from(double time_s, const std::function<bool(const AVFrame&)>& use);
  // Whether frames of these times are decoded from the same key frame.
  bool share_key_frame(double one_s, double other_s) const;

  const AVCodecContext& codec() const { return *codec_; }
  const AVStream& stream() const { return *stream_; }
  AVFormatContext& format() { return *format_; }
  // Seconds from the start of the file of a frame's time stamp; negative infinity where it has none.
  double time_s(const AVFrame& frame) const;
  // What the file says it lasts, in seconds; 0 where it does not.
  double stated_duration_s() const;

 private:
  double start_s() const;
  std::int64_t stamp_of(double time_s) const;
  std::string title_;
  AVFormatContext* format_ = nullptr;
  AVCodecContext* codec_ = nullptr;
  AVStream* stream_ = nullptr;
};

// True for a media file with pictures and no sound; false for what cannot be read, too.
bool has_pictures_only(const std::string& path);

// What matters comes back as error codes; what FFmpeg's libraries would print besides is not printed.
void keep_av_quiet();

// FFmpeg's text for an error code.
std::string av_error_text(int code);

}  // namespace face::decode
