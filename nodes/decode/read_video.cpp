// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_video.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

#include <algorithm>
#include <cmath>
#include <memory>

#include "nodes/base/check.h"
#include "nodes/decode/av_input.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/rgb_frame.h"

namespace face::decode {
namespace {

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
      converter = std::make_unique<RgbConverter>(frame, title);
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
  check(!time_s.empty(), title, ": holds no frames that can be decoded, expected a whole video or picture");
  result.rate_hz =
      time_s.size() > 1 ? static_cast<double>(time_s.size() - 1) / (time_s.back() - time_s.front()) : 1 / step_s;
  result.timeline.duration_s = time_s.back() + 1 / result.rate_hz;
  if (result.timeline.duration_s < 0.9 * stated_duration_s - 0.5)
    fail(title, ": is truncated: found ", result.timeline.duration_s, " s of pictures, its header promises ",
         stated_duration_s, " s");
  return result;
}

}  // namespace face::decode
