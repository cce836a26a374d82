// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/pick_frames.h"

#include <map>
#include <string>

#include "nodes/base/check.h"

namespace face::model {

void pick_frames(const engine::Seq<Image>& frames, const engine::Seq<Landmarks>& landmarks,
                 engine::SeqWriter<Image>& picked) {
  std::map<std::string, Image> found;
  for (std::size_t m = 0; m < landmarks.size(); ++m) found[landmarks.id(m)];
  // In the clip's order: a video is decoded in order only.
  for (std::size_t f = 0; f < frames.size(); ++f)
    if (const auto wanted = found.find(frames.id(f)); wanted != found.end()) wanted->second = *frames.at(f);
  for (std::size_t m = 0; m < landmarks.size(); ++m) {
    const Image& image = found[landmarks.id(m)];
    check(!image.pixels.empty(), "landmarks are of frame ", landmarks.id(m), ", but frames has ", frames.size(),
          " frames and none with this id");
    picked.push(landmarks.id(m), image);
  }
}

}  // namespace face::model
