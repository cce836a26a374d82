// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/frame_image.h"

extern "C" {
#include <libavcodec/avcodec.h>
}

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "nodes/decode/av_input.h"
#include "nodes/decode/jpeg_end.h"
#include "nodes/decode/rgb_frame.h"

namespace face::decode {
namespace {

AVCodecID codec_of(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return AV_CODEC_ID_PNG;
  if (bytes.starts_with("\xFF\xD8\xFF")) return AV_CODEC_ID_MJPEG;
  if (bytes.starts_with("RIFF") && bytes.size() > 12 && bytes.substr(8, 4) == "WEBP") return AV_CODEC_ID_WEBP;
  return AV_CODEC_ID_NONE;
}

struct Free {
  void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
};

}  // namespace

Image image_of(const AVFrame& frame, const std::string& title, bool with_alpha) {
  if (static_cast<AVPixelFormat>(frame.format) != AV_PIX_FMT_GRAY8)
    return RgbConverter(frame, title, with_alpha).convert(frame);
  Image out{frame.width, frame.height, 1, {}};
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* row = frame.data[0] + static_cast<std::ptrdiff_t>(frame.linesize[0]) * y;
    out.pixels.insert(out.pixels.end(), row, row + frame.width);
  }
  return out;
}

Image read_picture_bytes(std::string_view bytes, const std::string& title) {
  const AVCodecID id = codec_of(bytes);
  if (id == AV_CODEC_ID_NONE || (id == AV_CODEC_ID_MJPEG && !has_jpeg_end(bytes))) return {};
  keep_av_quiet();
  const AVCodec* codec = avcodec_find_decoder(id);
  const std::unique_ptr<AVCodecContext, Free> context(avcodec_alloc_context3(codec));
  const std::unique_ptr<AVPacket, Free> packet(av_packet_alloc());
  const std::unique_ptr<AVFrame, Free> frame(av_frame_alloc());
  context->thread_count = 1;
  int code = avcodec_open2(context.get(), codec, nullptr);
  if (code >= 0) code = av_new_packet(packet.get(), static_cast<int>(bytes.size()));
  if (code >= 0) std::copy(bytes.begin(), bytes.end(), packet->data);
  if (code >= 0) code = avcodec_send_packet(context.get(), packet.get());
  if (code >= 0) code = avcodec_send_packet(context.get(), nullptr);
  if (code >= 0) code = avcodec_receive_frame(context.get(), frame.get());
  if (code < 0) return {};
  return image_of(*frame, title, true);
}

}  // namespace face::decode
