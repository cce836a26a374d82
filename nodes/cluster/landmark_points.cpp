// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/landmark_points.h"

#include <algorithm>

#include "nodes/base/check.h"

namespace face::cluster {

LandmarkPointsResult landmark_points(const engine::Seq<Landmarks>& tracks, const LandmarkPointsOptions& options) {
  check(!tracks.empty(), "tracks has no frames");
  LandmarkPointsResult result;
  const Landmarks first = *tracks.at(0);
  std::size_t frame = 0;
  for (const Landmarks& here : tracks) {
    const std::size_t f = frame++;
    check(here.points.size() == first.points.size(), "frame ", tracks.id(f), " has ", here.points.size(),
          " landmarks, expected ", first.points.size(), " as frame ", tracks.id(0));
    for (std::size_t i = 0; i < here.points.size(); ++i)
      check(here.points[i].name == first.points[i].name, "landmark ", i, " of frame ", tracks.id(f), " is ",
            here.points[i].name, ", expected ", first.points[i].name, " as in frame ", tracks.id(0));
    const auto lost = std::count_if(here.points.begin(), here.points.end(), [](const Landmark& p) { return !p.valid; });
    if (lost > options.max_lost) continue;
    for (const Landmark& point : here.points) {
      result.points.values.push_back(point.x_px);
      result.points.values.push_back(point.y_px);
    }
    result.frames.values.push_back(static_cast<double>(f));
  }
  check(!result.frames.values.empty(), "none of the ", tracks.size(), " frames can be used: each has lost more than ",
        options.max_lost, " of its ", first.points.size(),
        " landmarks; does the film show the face that the points were placed on?");
  result.points.rows = result.frames.rows = result.frames.values.size();
  result.points.columns = 2 * first.points.size();
  result.frames.columns = 1;
  return result;
}

}  // namespace face::cluster
