// SPDX-License-Identifier: Apache-2.0
// The six clips of the real material, from the film to the points, and the marks that were made on them by hand.
#pragma once
#include <array>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nodes/decode/read_landmarks.h"
#include "nodes/decode/read_video.h"
#include "nodes/track/track_klt.h"

namespace test {

inline constexpr std::array<const char*, 6> grid_clips = {"bbaf2n", "brbk7n", "lbax4n", "lrwp9a", "pwij3p", "swwp2s"};

struct Tracked {
  std::vector<face::track::TrackKltResult> frames;
  face::Landmarks start;
};

inline std::vector<std::shared_ptr<const face::Image>> read_frames(const std::string& video) {
  std::vector<std::shared_ptr<const face::Image>> frames;
  engine::SeqWriter<face::Image> writer([&](const std::string&, face::Image image) {
    frames.push_back(std::make_shared<const face::Image>(std::move(image)));
  });
  engine::Progress progress;
  face::decode::read_video(engine::File::at(video), writer, progress);
  return frames;
}

inline std::vector<face::track::TrackKltResult> track_frames(
    const std::vector<std::shared_ptr<const face::Image>>& frames, const face::Landmarks& start,
    const face::track::TrackKltOptions& options = {}) {
  using Result = face::track::TrackKltResult;
  std::vector<Result> out;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const engine::Window<face::Image> window = i > 0 ? engine::Window<face::Image>({frames[i - 1], frames[i]}, 1)
                                                     : engine::Window<face::Image>({frames[0]}, 0);
    engine::Prior<Result> prior;
    if (i > 0) prior = engine::Prior<Result>(std::make_shared<const Result>(out.back()));
    out.push_back(face::track::track_klt(window, start, nullptr, prior, options));
  }
  return out;
}

inline Tracked track_clip(const std::string& video, const std::string& points) {
  Tracked out;
  out.start = face::decode::read_landmarks(engine::File::at(points)).landmarks;
  out.frames = track_frames(read_frames(video), out.start);
  return out;
}

inline const face::Landmark& point_of(const face::Landmarks& points, const std::string& name) {
  for (const face::Landmark& point : points.points)
    if (point.name == name) return point;
  throw std::invalid_argument("no point " + name);
}

// Frame -> point -> place, of tests/data/grid_marks.
inline std::map<std::size_t, std::map<std::string, std::array<double, 2>>> read_marks(const std::string& clip) {
  std::ifstream file(std::string(FACEGRAPH_SOURCE_DIR) + "/tests/data/grid_marks/" + clip + ".json");
  std::map<std::size_t, std::map<std::string, std::array<double, 2>>> out;
  const nlohmann::json json = nlohmann::json::parse(file);
  for (const auto& [frame, points] : json.items())
    for (const auto& [name, xy] : points.items())
      out[std::stoul(frame)][name] = {xy[0].get<double>(), xy[1].get<double>()};
  return out;
}

}  // namespace test
