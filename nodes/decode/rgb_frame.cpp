// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/rgb_frame.h"

extern "C" {
#include <libavutil/frame.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/base/check.h"

namespace face::decode {

namespace {

bool has_alpha(int format) {
  const AVPixFmtDescriptor* described = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(format));
  return described != nullptr && (described->flags & AV_PIX_FMT_FLAG_ALPHA) != 0;
}

}  // namespace

RgbConverter::RgbConverter(const AVFrame& frame, const std::string& title, bool with_alpha)
    : width_(frame.width),
      height_(frame.height),
      format_(frame.format),
      channels_(with_alpha && has_alpha(format_) ? 4 : 3),
      context_(sws_getContext(width_, height_, static_cast<AVPixelFormat>(format_), width_, height_,
                              channels_ == 4 ? AV_PIX_FMT_RGBA : AV_PIX_FMT_RGB24,
                              SWS_BICUBIC | SWS_ACCURATE_RND | SWS_BITEXACT | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP,
                              nullptr, nullptr, nullptr),
               &sws_freeContext) {
  check(context_ != nullptr, title, ": its pixel format cannot be converted to RGB");
  const bool hd = frame.colorspace == AVCOL_SPC_BT709 || (frame.colorspace == AVCOL_SPC_UNSPECIFIED && height_ >= 720);
  const int space = hd ? SWS_CS_ITU709 : frame.colorspace == AVCOL_SPC_BT2020_NCL ? SWS_CS_BT2020 : SWS_CS_ITU601;
  const int full = frame.color_range == AVCOL_RANGE_JPEG ? 1 : 0;
  sws_setColorspaceDetails(context_.get(), sws_getCoefficients(space), full, sws_getCoefficients(SWS_CS_DEFAULT), 1, 0,
                           1 << 16, 1 << 16);
}

bool RgbConverter::fits(const AVFrame& frame) const {
  return frame.width == width_ && frame.height == height_ && frame.format == format_;
}

Image RgbConverter::convert(const AVFrame& frame) const {
  // swscale writes whole vectors, so rows are padded and copied.
  const int stride = (channels_ * width_ + 63) / 64 * 64 + 64;
  std::vector<std::uint8_t> padded(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height_));
  std::uint8_t* to[4] = {padded.data(), nullptr, nullptr, nullptr};
  const int strides[4] = {stride, 0, 0, 0};
  sws_scale(context_.get(), frame.data, frame.linesize, 0, height_, to, strides);
  Image image{width_, height_, channels_, {}};
  image.pixels.reserve(static_cast<std::size_t>(channels_ * width_) * static_cast<std::size_t>(height_));
  for (int y = 0; y < height_; ++y) {
    const auto row = padded.begin() + static_cast<std::ptrdiff_t>(stride) * y;
    image.pixels.insert(image.pixels.end(), row, row + channels_ * width_);
  }
  return image;
}

}  // namespace face::decode
