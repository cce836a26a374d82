// SPDX-License-Identifier: Apache-2.0
// A film taken apart into its pictures and put together again, with something wrong in it.
#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>
extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace test {

// A picture as planes of 4:2:0.
using Picture = std::shared_ptr<AVFrame>;

inline Picture held(AVFrame* frame) {
  return {frame, [](AVFrame* f) { av_frame_free(&f); }};
}

inline Picture copied(const Picture& from) {
  AVFrame* frame = av_frame_alloc();
  frame->format = from->format, frame->width = from->width, frame->height = from->height;
  EXPECT_EQ(av_frame_get_buffer(frame, 0), 0);
  EXPECT_EQ(av_frame_copy(frame, from.get()), 0);
  frame->color_range = from->color_range, frame->colorspace = from->colorspace;
  return held(frame);
}

// All pictures of a film's video.
inline std::vector<Picture> pictures_of(const std::string& path) {
  std::vector<Picture> pictures;
  AVFormatContext* input = nullptr;
  if (avformat_open_input(&input, path.c_str(), nullptr, nullptr) != 0) return pictures;
  EXPECT_GE(avformat_find_stream_info(input, nullptr), 0);
  const AVCodec* codec = nullptr;
  const int stream = av_find_best_stream(input, AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
  EXPECT_GE(stream, 0);
  AVCodecContext* decoder = avcodec_alloc_context3(codec);
  avcodec_parameters_to_context(decoder, input->streams[stream]->codecpar);
  EXPECT_EQ(avcodec_open2(decoder, codec, nullptr), 0);
  AVPacket* packet = av_packet_alloc();
  const auto take_all = [&] {
    for (AVFrame* frame = av_frame_alloc();; frame = av_frame_alloc()) {
      if (avcodec_receive_frame(decoder, frame) == 0) {
        pictures.push_back(held(frame));
        continue;
      }
      av_frame_free(&frame);
      return;
    }
  };
  while (av_read_frame(input, packet) == 0) {
    if (packet->stream_index == stream && avcodec_send_packet(decoder, packet) == 0) take_all();
    av_packet_unref(packet);
  }
  avcodec_send_packet(decoder, nullptr);
  take_all();
  av_packet_free(&packet);
  avcodec_free_context(&decoder);
  avformat_close_input(&input);
  return pictures;
}

// Writes them without loss (FFV1 in Matroska); each is shown from its time on.
inline void write_film(const std::string& path, const std::vector<Picture>& pictures,
                       const std::vector<std::int64_t>& times_ms) {
  AVFormatContext* output = nullptr;
  ASSERT_GE(avformat_alloc_output_context2(&output, nullptr, "matroska", path.c_str()), 0);
  const AVCodec* codec = avcodec_find_encoder(AV_CODEC_ID_FFV1);
  ASSERT_NE(codec, nullptr);
  AVStream* stream = avformat_new_stream(output, codec);
  AVCodecContext* encoder = avcodec_alloc_context3(codec);
  encoder->width = pictures[0]->width, encoder->height = pictures[0]->height;
  encoder->pix_fmt = static_cast<AVPixelFormat>(pictures[0]->format);
  encoder->time_base = stream->time_base = {1, 1000};
  encoder->color_range = pictures[0]->color_range, encoder->colorspace = pictures[0]->colorspace;
  ASSERT_EQ(avcodec_open2(encoder, codec, nullptr), 0);
  ASSERT_GE(avcodec_parameters_from_context(stream->codecpar, encoder), 0);
  ASSERT_GE(avio_open(&output->pb, path.c_str(), AVIO_FLAG_WRITE), 0);
  ASSERT_GE(avformat_write_header(output, nullptr), 0);
  AVPacket* packet = av_packet_alloc();
  const auto put_all = [&] {
    while (avcodec_receive_packet(encoder, packet) == 0) {
      packet->stream_index = stream->index;
      av_packet_rescale_ts(packet, encoder->time_base, stream->time_base);
      EXPECT_EQ(av_interleaved_write_frame(output, packet), 0);
    }
  };
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const Picture picture = copied(pictures[i]);
    picture->pts = times_ms[i];
    EXPECT_EQ(avcodec_send_frame(encoder, picture.get()), 0);
    put_all();
  }
  avcodec_send_frame(encoder, nullptr);
  put_all();
  av_write_trailer(output);
  av_packet_free(&packet);
  avcodec_free_context(&encoder);
  avio_closep(&output->pb);
  avformat_free_context(output);
}

// Every picture as `value(plane, x, y)` says, in its planes.
template <class Value>
Picture painted(const Picture& like, const Value& value) {
  const Picture picture = copied(like);
  for (int plane = 0; plane < 3; ++plane)
    for (int y = 0; y < (plane == 0 ? picture->height : picture->height / 2); ++y)
      for (int x = 0; x < (plane == 0 ? picture->width : picture->width / 2); ++x)
        picture->data[plane][y * picture->linesize[plane] + x] = static_cast<std::uint8_t>(value(plane, x, y));
  return picture;
}

// The picture `by` (even) pixels to the right; what comes in repeats the edge.
inline Picture moved(const Picture& picture, int by) {
  return painted(picture, [&](int plane, int x, int y) {
    const int from = std::max(0, x - (plane == 0 ? by : by / 2));
    return picture->data[plane][y * picture->linesize[plane] + from];
  });
}

}  // namespace test
