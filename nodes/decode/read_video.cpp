// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_video.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <cmath>
#include <memory>

#include "nodes/base/check.h"
#include "nodes/decode/av_input.h"
#include "nodes/decode/input_file.h"

namespace face::decode {
namespace {

// Converts frames to RGB. One context for frames of one size and format.
class RgbConverter {
 public:
  explicit RgbConverter(const AVFrame& frame)
      : width_(frame.width),
        height_(frame.height),
        format_(frame.format),
        context_(sws_getContext(width_, height_, static_cast<AVPixelFormat>(format_), width_, height_, AV_PIX_FMT_RGB24,
                                SWS_BICUBIC | SWS_ACCURATE_RND | SWS_BITEXACT | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP,
                                nullptr, nullptr, nullptr),
                 &sws_freeContext) {
    if (!context_) return;
    // Unmarked video is BT.709 from 720 lines on, BT.601 below, as every player assumes.
    const bool hd =
        frame.colorspace == AVCOL_SPC_BT709 || (frame.colorspace == AVCOL_SPC_UNSPECIFIED && height_ >= 720);
    const int space = hd ? SWS_CS_ITU709 : frame.colorspace == AVCOL_SPC_BT2020_NCL ? SWS_CS_BT2020 : SWS_CS_ITU601;
    const int full = frame.color_range == AVCOL_RANGE_JPEG ? 1 : 0;
    sws_setColorspaceDetails(context_.get(), sws_getCoefficients(space), full, sws_getCoefficients(SWS_CS_DEFAULT), 1,
                             0, 1 << 16, 1 << 16);
  }
  bool usable() const { return context_ != nullptr; }
  bool fits(const AVFrame& frame) const {
    return frame.width == width_ && frame.height == height_ && frame.format == format_;
  }
  Image convert(const AVFrame& frame) const {
    // swscale writes whole vectors, so rows are padded and copied.
    const int stride = (3 * width_ + 63) / 64 * 64 + 64;
    std::vector<std::uint8_t> padded(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height_));
    std::uint8_t* to[4] = {padded.data(), nullptr, nullptr, nullptr};
    const int strides[4] = {stride, 0, 0, 0};
    sws_scale(context_.get(), frame.data, frame.linesize, 0, height_, to, strides);
    Image image{width_, height_, 3, {}};
    image.pixels.reserve(static_cast<std::size_t>(3 * width_) * static_cast<std::size_t>(height_));
    for (int y = 0; y < height_; ++y) {
      const auto row = padded.begin() + static_cast<std::ptrdiff_t>(stride) * y;
      image.pixels.insert(image.pixels.end(), row, row + 3 * width_);
    }
    return image;
  }

 private:
  int width_, height_, format_;
  std::unique_ptr<SwsContext, void (*)(SwsContext*)> context_;
};

// How the stored picture is brought upright: rows and columns exchanged, and then columns or rows read from their end.
struct Orientation {
  bool exchanged = false, columns_back = false, rows_back = false;
};

// Cameras store what their sensor sees and say how it is to be held: a photograph in its own data (EXIF), a film in its
// container. The matrix (a b u; c d v; x y w) takes a stored place (p, q) to a shown one: (a p + c q + x, b p + d q +
// y).
Orientation orientation_of(const AVStream& stream, const AVFrame& frame) {
  const AVFrameSideData* own = av_frame_get_side_data(&frame, AV_FRAME_DATA_DISPLAYMATRIX);
  const std::uint8_t* bytes = own ? own->data : av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr);
  if (!bytes) return {};
  const auto* matrix = reinterpret_cast<const std::int32_t*>(bytes);
  const double a = matrix[0], b = matrix[1], c = matrix[3], d = matrix[4];
  if (std::abs(b) + std::abs(c) > std::abs(a) + std::abs(d)) return {true, c < 0, b < 0};
  return {false, a < 0, d < 0};
}

Image upright(Image image, const Orientation& how) {
  if (!how.exchanged && !how.columns_back && !how.rows_back) return image;
  Image out = image;
  if (how.exchanged) std::swap(out.width, out.height);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const int column = how.columns_back ? out.width - 1 - x : x, row = how.rows_back ? out.height - 1 - y : y;
      const int from = how.exchanged ? column * image.width + row : row * image.width + column;
      for (int k = 0; k < 3; ++k)
        out.pixels[static_cast<std::size_t>((y * out.width + x) * 3 + k)] =
            image.pixels[static_cast<std::size_t>(from * 3 + k)];
    }
  return out;
}

}  // namespace

ReadVideoResult read_video(const engine::File& file, engine::SeqWriter<Image>& frames, engine::Progress& progress) {
  const std::string title = title_of(file);
  read_start(file, 1, "a video file");
  AvInput input(file.path(), title, AvInput::Kind::video);
  const AVRational stated = av_guess_frame_rate(&input.format(), const_cast<AVStream*>(&input.stream()), nullptr);
  const double step_s = stated.num > 0 && stated.den > 0 ? av_q2d(av_inv_q(stated)) : 0.04;
  const double stated_duration_s = input.stated_duration_s();

  ReadVideoResult result;
  std::vector<double>& time_s = result.timeline.time_s;
  std::unique_ptr<RgbConverter> converter;
  Orientation orientation;
  input.for_each_frame([&](const AVFrame& frame) {
    if (!converter) {
      converter = std::make_unique<RgbConverter>(frame);
      check(converter->usable(), title, ": its pixel format cannot be converted to RGB");
      orientation = orientation_of(input.stream(), frame);
    }
    if (!converter->fits(frame))
      fail(title, ": frame ", time_s.size(), " is ", frame.width, " x ", frame.height,
           ", expected the size of the first");
    Image image = upright(converter->convert(frame), orientation);
    // A missing or repeated time stamp is taken for one frame after the last.
    const double stamp = input.time_s(frame);
    const bool usable = time_s.empty() ? stamp >= 0 : stamp > time_s.back();
    time_s.push_back(usable ? stamp : time_s.empty() ? 0 : time_s.back() + step_s);
    frames.push(std::move(image));
    if (stated_duration_s > 0) progress.report(std::min(1.0, time_s.back() / stated_duration_s));
  });
  check(!time_s.empty(), title, ": holds no frames that can be decoded, expected a whole video file");
  result.rate_hz =
      time_s.size() > 1 ? static_cast<double>(time_s.size() - 1) / (time_s.back() - time_s.front()) : 1 / step_s;
  result.timeline.duration_s = time_s.back() + 1 / result.rate_hz;
  if (result.timeline.duration_s < 0.9 * stated_duration_s - 0.5)
    fail(title, ": is truncated: found ", result.timeline.duration_s, " s of pictures, its header promises ",
         stated_duration_s, " s");
  return result;
}

}  // namespace face::decode
