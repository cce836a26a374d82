// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/report.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/base/check.h"

namespace face::track {
namespace {

// What is said of each frame, as lines: frames in a row of which the same is said share one.
std::vector<std::string> lines_of(const engine::Seq<Landmarks>& frames, const std::vector<std::string>& said) {
  std::vector<std::string> lines;
  for (std::size_t first = 0, last = 0; first < said.size(); first = last + 1) {
    for (last = first; last + 1 < said.size() && said[last + 1] == said[first];) ++last;
    if (said[first].empty()) continue;
    lines.push_back(first == last ? message("frame ", frames.id(first), ": ", said[first])
                                  : message("frames ", frames.id(first), " to ", frames.id(last), ": ", said[first]));
  }
  return lines;
}

std::string describe(const std::string& state) {
  if (state == "even") return "nothing to see: black, white or one colour";
  if (state == "cut") return "a cut: another picture than in the frame before";
  if (state == "lost") return "the face is not seen";
  if (state == "found") return "the face is found again";
  return {};
}

// A frame's length beside the usual one.
std::vector<std::string> odd_lengths(const Timeline& timeline) {
  std::vector<double> lengths_s;
  for (std::size_t i = 0; i < timeline.time_s.size(); ++i)
    lengths_s.push_back((i + 1 < timeline.time_s.size() ? timeline.time_s[i + 1] : timeline.duration_s) -
                        timeline.time_s[i]);
  std::vector<double> sorted = lengths_s;
  std::sort(sorted.begin(), sorted.end());
  const double usual_s = sorted.empty() ? 0 : sorted[sorted.size() / 2];
  std::vector<std::string> said(lengths_s.size());
  for (std::size_t i = 0; i < said.size(); ++i)
    if (std::abs(lengths_s[i] - usual_s) > 0.1 * usual_s)
      said[i] = message("shown for ", std::round(1000 * lengths_s[i]), " ms, most for ", std::round(1000 * usual_s),
                        " ms: the frame rate varies");
  return said;
}

}  // namespace

ReportResult report(const engine::Seq<Landmarks>& landmarks, const engine::Seq<std::string>& state,
                    const Timeline* timeline, engine::Progress& progress) {
  check(landmarks.size() == state.size(), "landmarks has ", landmarks.size(), " frames, state has ", state.size());
  if (timeline)
    check(timeline->time_s.size() == landmarks.size(), "landmarks has ", landmarks.size(), " frames, timeline has ",
          timeline->time_s.size());
  std::vector<std::string> states, lost;
  std::size_t points = 0, lost_points = 0;
  std::size_t frames_seen = 0, points_seen = 0, lost_in_seen = 0;  // of frames of which nothing else is said
  for (const std::string& s : state) states.push_back(describe(s));
  std::size_t frame = 0;
  for (const Landmarks& seen : landmarks) {
    std::string names;
    std::size_t count = 0;
    for (const Landmark& point : seen.points)
      if (!point.valid) names += (names.empty() ? "" : ", ") + point.name, ++count;
    points += seen.points.size();
    lost_points += count;
    const std::string& whole = states[frame++];
    if (whole.empty()) ++frames_seen, points_seen += seen.points.size(), lost_in_seen += count;
    lost.push_back(count == 0 || (!whole.empty() && count == seen.points.size()) ? "" : "lost " + names);
  }
  ReportResult result;
  result.text = message(landmarks.size(), " frames, ", points, " points, ", lost_points, " of them lost\n");
  // Of real clips at most one point in 20 is lost; of points that lie on no face, or beside it, one in 6 and more.
  constexpr double many = 0.1;
  constexpr std::size_t enough_frames = 10;
  const double share = static_cast<double>(lost_in_seen) / static_cast<double>(std::max<std::size_t>(points_seen, 1));
  if (frames_seen >= enough_frames && share > many) {
    const std::string line = message(std::round(100 * share),
                                     " % of the points are lost in frames that show something, "
                                     "usually it is less than 5 %: do they lie on the face in the first frame?");
    progress.warn(line);
    result.text += line + "\n";
  }
  for (const std::string& line : lines_of(landmarks, states)) progress.warn(line), result.text += line + "\n";
  if (timeline) {
    const std::vector<std::string> lines = lines_of(landmarks, odd_lengths(*timeline));
    if (!lines.empty())
      progress.warn(lines.size() == 1 ? lines[0]
                                      : message(lines[0], "; and ", lines.size() - 1, " more, see the report"));
    for (const std::string& line : lines) result.text += line + "\n";
  }
  for (const std::string& line : lines_of(landmarks, lost)) result.text += line + "\n";
  result.file = engine::File::from_bytes(result.text, ".txt");
  return result;
}

}  // namespace face::track
