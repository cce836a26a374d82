// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/depth_image.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/pixdesc.h>
}

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "nodes/base/check.h"
#include "nodes/decode/av_input.h"
#include "nodes/decode/frame_image.h"

namespace face::decode {
namespace {

// The only frame of a picture file.
template <class Use>
void with_frame(const std::string& path, const std::string& title, Use use) {
  std::error_code unreadable;
  check(std::filesystem::file_size(path, unreadable) > 0 || unreadable, title, ": is empty, expected a picture");
  AvInput input(path, title, AvInput::Kind::video);
  bool seen = false;
  input.for_each_frame([&](const AVFrame& frame) {
    if (!seen) use(frame);
    seen = true;
  });
  check(seen, title, ": holds no whole picture");
}

float float_at(const std::uint8_t* p) {
  float value = 0;
  std::memcpy(&value, p, sizeof value);
  return value;
}

// The numbers of a frame of one grey channel, or of an EXR's red one; false where it is of another kind.
bool numbers_of(const AVFrame& frame, DepthImage& out) {
  const auto format = static_cast<AVPixelFormat>(frame.format);
  int plane = 0;
  if (format == AV_PIX_FMT_GBRPF32LE || format == AV_PIX_FMT_GBRAPF32LE) plane = 2;  // red
  const bool floats = plane == 2 || format == AV_PIX_FMT_GRAYF32LE;
  const bool wide = format == AV_PIX_FMT_GRAY16BE || format == AV_PIX_FMT_GRAY16LE;
  if (!floats && !wide && format != AV_PIX_FMT_GRAY8) return false;
  out.width = frame.width;
  out.height = frame.height;
  out.whole_numbers = !floats;
  out.bits = floats ? 32 : wide ? 16 : 8;
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* row = frame.data[plane] + static_cast<std::ptrdiff_t>(frame.linesize[plane]) * y;
    for (int x = 0; x < frame.width; ++x) {
      if (floats)
        out.values.push_back(float_at(row + 4 * x));
      else if (!wide)
        out.values.push_back(row[x]);
      else if (format == AV_PIX_FMT_GRAY16BE)
        out.values.push_back(static_cast<float>(row[2 * x] * 256 + row[2 * x + 1]));
      else
        out.values.push_back(static_cast<float>(row[2 * x + 1] * 256 + row[2 * x]));
    }
  }
  return true;
}

}  // namespace

DepthImage read_depth_image(const std::string& path, const std::string& title) {
  DepthImage out;
  with_frame(path, title, [&](const AVFrame& frame) {
    if (!numbers_of(frame, out)) {
      const char* name = av_get_pix_fmt_name(static_cast<AVPixelFormat>(frame.format));
      fail(title, ": its pixels are ", name ? name : "unknown",
           ", expected one grey channel of 8, 16 or 32 (EXR) bits");
    }
  });
  return out;
}

DepthImage read_mask(const std::string& path, const std::string& title) {
  DepthImage out;
  with_frame(path, title, [&](const AVFrame& frame) {
    if (numbers_of(frame, out)) return;
    const Image colours = image_of(frame, title);
    out.width = colours.width;
    out.height = colours.height;
    out.bits = 8;
    const auto channels = static_cast<std::size_t>(colours.channels);
    for (std::size_t i = 0; i + channels <= colours.pixels.size(); i += channels)
      out.values.push_back(*std::max_element(&colours.pixels[i], &colours.pixels[i] + channels));
  });
  return out;
}

Image read_levels(const std::string& path, const std::string& title) {
  Image out;
  with_frame(path, title, [&](const AVFrame& frame) {
    if (DepthImage grey; numbers_of(frame, grey)) {
      out = {grey.width, grey.height, 1, {}};
      const float scale = !grey.whole_numbers ? 255.0f : grey.bits == 16 ? 255.0f / 65535 : 1.0f;
      for (const float level : grey.values)
        out.pixels.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(scale * level, 0.0f, 255.0f))));
      return;
    }
    const Image colours = image_of(frame, title);
    out = {colours.width, colours.height, 1, {}};
    const auto channels = static_cast<std::size_t>(colours.channels), counted = std::min<std::size_t>(channels, 3);
    for (std::size_t i = 0; i + channels <= colours.pixels.size(); i += channels) {
      std::size_t sum = 0;
      for (std::size_t k = 0; k < counted; ++k) sum += colours.pixels[i + k];
      out.pixels.push_back(static_cast<std::uint8_t>((sum + counted / 2) / counted));
    }
  });
  return out;
}

Image read_picture(const std::string& path, const std::string& title) {
  Image out;
  with_frame(path, title, [&](const AVFrame& frame) { out = image_of(frame, title); });
  return out;
}

}  // namespace face::decode
