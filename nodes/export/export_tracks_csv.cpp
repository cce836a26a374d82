// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_tracks_csv.h"

#include <string>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/export/csv.h"

namespace face::exports {

engine::File export_tracks_csv(const engine::Seq<Landmarks>& tracks) {
  check(!tracks.empty(), "there are no frames to export");
  std::string text = "frame,point,x_px,y_px,valid\n";
  std::size_t index = 0;
  for (const Landmarks& landmarks : tracks) {
    const std::string id = tracks.id(index++);
    for (const Landmark& point : landmarks.points) {
      append_field(text, id);
      text += ',';
      append_field(text, point.name);
      text += ',';
      append_fixed(text, point.x_px, 3);
      text += ',';
      append_fixed(text, point.y_px, 3);
      text += point.valid ? ",1\n" : ",0\n";
    }
  }
  return engine::File::from_bytes(std::move(text), ".csv");
}

}  // namespace face::exports
