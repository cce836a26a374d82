// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/upright_image.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

#include <cmath>
#include <cstdint>
#include <utility>

#include "nodes/base/check.h"

namespace face::decode {
namespace {

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

UprightImages::UprightImages(const AvInput& input, std::string title) : input_(input), title_(std::move(title)) {}

Image UprightImages::image_of(const AVFrame& frame, std::size_t number) {
  if (!converter_) {
    converter_ = std::make_unique<RgbConverter>(frame, title_);
    orientation_ = orientation_of(input_.stream(), frame);
  }
  if (!converter_->fits(frame))
    fail(title_, ": frame ", number, " is ", frame.width, " x ", frame.height, ", expected the size of the first");
  return upright(converter_->convert(frame), orientation_);
}

}  // namespace face::decode
