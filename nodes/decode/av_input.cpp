// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/av_input.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

#include <cmath>
#include <fstream>
#include <limits>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/decode/jpeg_end.h"

namespace face::decode {
namespace {

// The next pictures are decoded while one is converted. A number of the machine's could change what is made of a
// damaged stream.
constexpr int decoding_threads = 2;

std::string list_streams(const AVFormatContext& format) {
  std::string out;
  for (unsigned i = 0; i < format.nb_streams; ++i) {
    const AVCodecParameters& codec = *format.streams[i]->codecpar;
    const char* kind = av_get_media_type_string(codec.codec_type);
    if (!out.empty()) out += ", ";
    out += std::string(kind ? kind : "data") + " " + avcodec_get_name(codec.codec_id);
  }
  return out.empty() ? "nothing" : out;
}

// Null where the file cannot be opened; code says why. "file:" keeps a path with a colon from being taken for a
// protocol.
AVFormatContext* open_format(const std::string& path, int& code) {
  keep_av_quiet();
  AVFormatContext* format = nullptr;
  code = avformat_open_input(&format, ("file:" + path).c_str(), nullptr, nullptr);
  return format;
}

// MP4 and MOV keep the list of their frames in one piece, mostly the last one, without which nothing can be read.
std::string why_unreadable(const std::string& path, int code) {
  std::string head(8, 0);
  std::ifstream(path, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()));
  if (code == AVERROR_INVALIDDATA && head.substr(4) == "ftyp")
    return "the list of its frames (moov) was not found: is the file whole?";
  return av_error_text(code);
}

// A picture file, not a film: FFmpeg's demuxers for those.
bool is_picture(const AVFormatContext& format) {
  const std::string_view demuxer = format.iformat->name;
  return demuxer == "image2" || demuxer.ends_with("_pipe");
}

}  // namespace

void keep_av_quiet() { av_log_set_level(AV_LOG_QUIET); }

std::string av_error_text(int code) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, text, sizeof text);
  return text;
}

AvInput::AvInput(const std::string& path, std::string title, Kind kind) : title_(std::move(title)) {
  const char* expected = kind == Kind::audio
                             ? "a recording (WAV, AIFF, FLAC, Ogg, MP3, M4A, or a video file with sound)"
                             : "a video file (MP4, MOV, MPEG, AVI, MKV, WebM)";
  int code = 0;
  format_ = open_format(path, code);
  if (code < 0) fail(title_, ": cannot be read: ", why_unreadable(path, code), "; expected ", expected);
  try {
    code = avformat_find_stream_info(format_, nullptr);
    if (code < 0) fail(title_, ": cannot be read: ", av_error_text(code), "; expected ", expected);
    const AVCodec* decoder = nullptr;
    const AVMediaType type = kind == Kind::audio ? AVMEDIA_TYPE_AUDIO : AVMEDIA_TYPE_VIDEO;
    const int index = av_find_best_stream(format_, type, -1, -1, &decoder, 0);
    if (index == AVERROR_STREAM_NOT_FOUND)
      fail(title_, ": has no ", kind == Kind::audio ? "sound" : "pictures", ": found ", list_streams(*format_),
           ", expected ", expected);
    if (index < 0 || !decoder) fail(title_, ": no decoder for ", list_streams(*format_), "; expected ", expected);
    stream_ = format_->streams[index];
    for (unsigned i = 0; i < format_->nb_streams; ++i)
      if (format_->streams[i] != stream_) format_->streams[i]->discard = AVDISCARD_ALL;
    codec_ = avcodec_alloc_context3(decoder);
    check(codec_ != nullptr, title_, ": no memory for its decoder");
    code = avcodec_parameters_to_context(codec_, stream_->codecpar);
    codec_->thread_count = decoding_threads;
    codec_->thread_type = FF_THREAD_FRAME;
    codec_->flags |= AV_CODEC_FLAG_BITEXACT;
    codec_->pkt_timebase = stream_->time_base;
    if (code >= 0) code = avcodec_open2(codec_, decoder, nullptr);
    if (code < 0) fail(title_, ": its ", decoder->name, " decoder cannot be opened: ", av_error_text(code));
  } catch (...) {
    avcodec_free_context(&codec_);
    avformat_close_input(&format_);
    throw;
  }
}

AvInput::~AvInput() {
  avcodec_free_context(&codec_);
  avformat_close_input(&format_);
}

void AvInput::for_each_frame(const std::function<void(const AVFrame&)>& use) {
  for_frames_while([&](const AVFrame& frame) {
    use(frame);
    return true;
  });
}

bool AvInput::for_frames_from(double time_s, const std::function<bool(const AVFrame&)>& use) {
  const std::string_view demuxer = format_->iformat->name;
  if (!demuxer.starts_with("mov,") && !demuxer.starts_with("matroska")) return false;
  const std::int64_t stamp = stamp_of(time_s);
  if (av_seek_frame(format_, stream_->index, stamp, AVSEEK_FLAG_BACKWARD) < 0) return false;
  avcodec_flush_buffers(codec_);
  bool from_key = false, begun = false;
  for_frames_while([&](const AVFrame& frame) {
    // Those that are shown before the key frame were coded by others, which the decoder has not seen.
    if (!begun && frame.key_frame == 0) return frame.best_effort_timestamp < stamp;
    if (!begun) from_key = frame.best_effort_timestamp <= stamp;
    begun = true;
    return from_key && use(frame);
  });
  return from_key;
}

bool AvInput::share_key_frame(double one_s, double other_s) const {
  const AVIndexEntry* const one =
      avformat_index_get_entry_from_timestamp(stream_, stamp_of(one_s), AVSEEK_FLAG_BACKWARD);
  const std::int64_t key = one ? one->timestamp : AV_NOPTS_VALUE;
  const AVIndexEntry* const other =
      avformat_index_get_entry_from_timestamp(stream_, stamp_of(other_s), AVSEEK_FLAG_BACKWARD);
  return one && other && key == other->timestamp;
}

void AvInput::for_frames_while(const std::function<bool(const AVFrame&)>& use) {
  const auto free_packet = [](AVPacket* p) { av_packet_free(&p); };
  const auto free_frame = [](AVFrame* f) { av_frame_free(&f); };
  const std::unique_ptr<AVPacket, decltype(free_packet)> packet(av_packet_alloc(), free_packet);
  const std::unique_ptr<AVFrame, decltype(free_frame)> frame(av_frame_alloc(), free_frame);
  // In a film, a picture without its end is the camera's habit.
  const bool one_jpeg = codec_->codec_id == AV_CODEC_ID_MJPEG && is_picture(*format_);
  std::int64_t byte = 0;
  const auto receive = [&] {
    for (;;) {
      const int code = avcodec_receive_frame(codec_, frame.get());
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return true;
      if (code < 0) fail(title_, " near byte ", byte, ": cannot be decoded: ", av_error_text(code));
      if (!use(*frame)) return false;
      av_frame_unref(frame.get());
    }
  };
  for (;;) {
    int code = av_read_frame(format_, packet.get());
    if (code == AVERROR_EOF) break;
    if (code < 0) fail(title_, " near byte ", byte, ": cannot be read: ", av_error_text(code));
    if (packet->stream_index == stream_->index) {
      if (packet->pos >= 0) byte = packet->pos;
      check(!one_jpeg ||
                has_jpeg_end({reinterpret_cast<const char*>(packet->data), static_cast<std::size_t>(packet->size)}),
            title_, ": is cut short: its ", packet->size, " bytes hold no end of the JPEG picture");
      code = avcodec_send_packet(codec_, packet.get());
      if (code < 0 && code != AVERROR(EAGAIN))
        fail(title_, " near byte ", byte, ": cannot be decoded: ", av_error_text(code));
      if (!receive()) return;
    }
    av_packet_unref(packet.get());
  }
  avcodec_send_packet(codec_, nullptr);
  receive();
}

double AvInput::start_s() const {
  return format_->start_time == AV_NOPTS_VALUE ? 0 : static_cast<double>(format_->start_time) / AV_TIME_BASE;
}

std::int64_t AvInput::stamp_of(double time_s) const {
  return static_cast<std::int64_t>(std::llround((time_s + start_s()) / av_q2d(stream_->time_base)));
}

double AvInput::time_s(const AVFrame& frame) const {
  if (frame.best_effort_timestamp == AV_NOPTS_VALUE) return -std::numeric_limits<double>::infinity();
  return static_cast<double>(frame.best_effort_timestamp) * av_q2d(stream_->time_base) - start_s();
}

double AvInput::stated_duration_s() const {
  if (stream_->duration != AV_NOPTS_VALUE) return static_cast<double>(stream_->duration) * av_q2d(stream_->time_base);
  return format_->duration == AV_NOPTS_VALUE ? 0 : static_cast<double>(format_->duration) / AV_TIME_BASE;
}

bool has_pictures_only(const std::string& path) {
  int code = 0;
  AVFormatContext* format = open_format(path, code);
  if (code < 0) return false;
  const auto has = [&](AVMediaType type) { return av_find_best_stream(format, type, -1, -1, nullptr, 0) >= 0; };
  const bool result =
      avformat_find_stream_info(format, nullptr) >= 0 && has(AVMEDIA_TYPE_VIDEO) && !has(AVMEDIA_TYPE_AUDIO);
  avformat_close_input(&format);
  return result;
}

}  // namespace face::decode
