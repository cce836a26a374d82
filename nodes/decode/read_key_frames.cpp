// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_key_frames.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/decode/av_input.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/upright_image.h"

namespace face::decode {
namespace {

// Their numbers in the film, each once, in order.
std::vector<std::size_t> frames_of(const KeyShapes& key_shapes, std::size_t count) {
  std::vector<std::size_t> wanted;
  for (const KeyShape& key : key_shapes.shapes) {
    std::size_t number = 0;
    const char* const end = key.frame.data() + key.frame.size();
    const auto [rest, error] = std::from_chars(key.frame.data(), end, number);
    check(error == std::errc() && rest == end && number < count, "key shape ", key.frame,
          " is no frame of the video: the timeline has ", count);
    wanted.push_back(number);
  }
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  return wanted;
}

}  // namespace

void read_key_frames(const engine::File& file, const Timeline& timeline, const KeyShapes& key_shapes,
                     engine::SeqWriter<Image>& frames, engine::Progress& progress) {
  const std::vector<double>& time_s = timeline.time_s;
  const std::vector<std::size_t> wanted = frames_of(key_shapes, time_s.size());
  if (wanted.empty()) return;
  const std::string title = title_of(file);
  read_start(file, 1, "a video file");
  std::size_t next = 0;  // of those wanted
  const auto give = [&](UprightImages& images, const AVFrame& frame, std::size_t number) {
    if (next == wanted.size() || number != wanted[next]) return;
    frames.push(std::to_string(number), images.image_of(frame, number));
    progress.report(static_cast<double>(++next) / static_cast<double>(wanted.size()));
  };
  {
    AvInput input(file.path(), title, AvInput::Kind::video);
    UprightImages images(input, title);
    bool in_step = false;
    input.for_frames_while([&](const AVFrame& frame) {
      in_step = input.time_s(frame) == time_s.front();
      return false;
    });
    while (in_step && next < wanted.size()) {
      const std::size_t from = next;
      auto at = time_s.end();
      in_step = input.for_frames_from(time_s[wanted[next]], [&](const AVFrame& frame) {
        if (at == time_s.end()) at = std::lower_bound(time_s.begin(), time_s.end(), input.time_s(frame));
        if (at == time_s.end() || *at != input.time_s(frame)) return false;
        give(images, frame, static_cast<std::size_t>(at - time_s.begin()));
        ++at;
        return next == from ||
               (next < wanted.size() && input.share_key_frame(time_s[wanted[next - 1]], time_s[wanted[next]]));
      });
      in_step = in_step && next > from;
    }
  }
  if (next == wanted.size()) return;
  AvInput input(file.path(), title, AvInput::Kind::video);
  UprightImages images(input, title);
  std::size_t number = 0;
  input.for_frames_while([&](const AVFrame& frame) {
    give(images, frame, number++);
    return next < wanted.size();
  });
  check(next == wanted.size(), title, ": holds ", number, " frames, the timeline has ", time_s.size());
}

}  // namespace face::decode
