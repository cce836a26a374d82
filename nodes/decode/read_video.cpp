// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_video.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

#include <algorithm>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/decode/av_input.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/upright_image.h"

namespace face::decode {

ReadVideoResult read_video(const engine::File& file, engine::SeqWriter<Image>& frames, engine::Progress& progress) {
  const std::string title = title_of(file);
  read_start(file, 1, "a video file");
  AvInput input(file.path(), title, AvInput::Kind::video);
  const AVRational stated = av_guess_frame_rate(&input.format(), const_cast<AVStream*>(&input.stream()), nullptr);
  const double step_s = stated.num > 0 && stated.den > 0 ? av_q2d(av_inv_q(stated)) : 0.04;
  const double stated_duration_s = input.stated_duration_s();

  ReadVideoResult result;
  std::vector<double>& time_s = result.timeline.time_s;
  UprightImages images(input, title);
  input.for_each_frame([&](const AVFrame& frame) {
    Image image = images.image_of(frame, time_s.size());
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
