// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/depth_take.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <exception>
#include <map>
#include <optional>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/quantile.h"
#include "nodes/decode/depth_frame.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/scan_camera_file.h"

namespace face::decode {
namespace {

struct Frame {
  long number = 0;
  FramePaths paths;
  double measured_px = 0, median_depth_mm = 0;
  int width = 0, height = 0;
  std::string trouble;  // empty: it is kept
};

// -1 where the text is no number.
long number_of(const std::string& text) {
  long number = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return text.empty() || error != std::errc() || end != text.data() + text.size() ? -1 : number;
}

// The files of a take by frame. Files whose name is no number are trouble of their own.
std::vector<Frame> frames_of(const engine::File& folder, const std::string& take, std::vector<std::string>& troubles) {
  std::map<long, Frame> frames;
  std::vector<std::string> odd;
  constexpr std::array kinds = {std::pair{"depth/", &FramePaths::depth}, std::pair{"cloud/", &FramePaths::cloud},
                                std::pair{"picture/", &FramePaths::picture}, std::pair{"mask/", &FramePaths::mask}};
  for (const engine::File::Entry& entry : folder.entries())
    for (const auto& [kind, member] : kinds) {
      const std::string start = kind + take + "/";
      if (!entry.name.starts_with(start)) continue;
      const std::string leaf = entry.name.substr(start.size());
      const long number = number_of(leaf.substr(0, leaf.find_last_of('.')));
      if (number < 0) {
        odd.push_back(entry.name);
        continue;
      }
      Frame& frame = frames[number];
      frame.number = number;
      std::string& path = frame.paths.*member;
      if (path.empty())
        path = entry.path;
      else
        troubles.push_back(message("frame ", number, ": has a second file ", entry.name, "; left out"));
    }
  if (odd.size() == 1)
    troubles.push_back("file " + odd[0] + ": its name is no frame number, expected one like 17.png; left out");
  if (odd.size() > 1)
    troubles.push_back(message("file ", odd[0], " and ", odd.size() - 1,
                               " more: their names are no frame numbers, expected some like 17.png; left out"));
  const std::string start = "pattern/" + take + "/";
  for (const engine::File::Entry& entry : folder.entries()) {
    if (!entry.name.starts_with(start)) continue;
    const std::string rest = entry.name.substr(start.size());
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const long number = number_of(rest.substr(0, slash)),
               pattern =
                   slash == rest.size() ? -1 : number_of(rest.substr(slash + 1, rest.find_last_of('.') - slash - 1));
    if (number < 0 || pattern < 0 || pattern > 4) {
      troubles.push_back("file " + entry.name + ": is no fringe picture like " + start + "17/0.png to 4.png; left out");
      continue;
    }
    frames[number].number = number;
    frames[number].paths.patterns[static_cast<std::size_t>(pattern)] = entry.path;
  }
  std::vector<Frame> out;
  for (auto& [number, frame] : frames) {
    if (frame.paths.depth.empty() && frame.paths.cloud.empty() && !frame.paths.has_patterns())
      frame.trouble = "it has a picture or mask but no depth";
    out.push_back(std::move(frame));
  }
  return out;
}

// Says what a median depth of the wrong size would be in another unit.
std::string depth_trouble(double depth_mm, bool whole_numbers, const ScanCameraFile& camera,
                          const DepthTakeOptions& options) {
  const char* key = whole_numbers ? "depth_unit_mm" : "length_unit";
  const bool says = whole_numbers ? camera.says_depth_unit : camera.says_length_unit;
  std::string text =
      message("its median depth is ", depth_mm, " mm, expected ", options.near_mm, " to ", options.far_mm);
  for (const double factor : {0.001, 0.01, 0.1, 10.0, 100.0, 1000.0})
    if (depth_mm * factor >= options.near_mm && depth_mm * factor <= options.far_mm)
      return text + (says ? message(": is the unit of depth ", factor, " times what ", key, " in camera.json says?")
                          : message(": is the unit of depth ", factor, " mm? camera.json has no ", key,
                                    ", so that 1 mm is taken"));
  return text;
}

// The size that most frames have; of equally many, the first frame's.
std::pair<int, int> usual_size(const std::vector<Frame>& frames) {
  std::map<std::pair<int, int>, int> counts;
  for (const Frame& frame : frames)
    if (frame.width > 0) ++counts[{frame.width, frame.height}];
  std::pair<int, int> best;
  int most = 0;
  for (const Frame& frame : frames)
    if (frame.width > 0 && counts[{frame.width, frame.height}] > most) {
      best = {frame.width, frame.height};
      most = counts[best];
    }
  return best;
}

std::string first_trouble(const std::vector<Frame>& frames) {
  for (const Frame& frame : frames)
    if (!frame.trouble.empty()) return message("; frame ", frame.number, ": ", frame.trouble);
  return {};
}

}  // namespace

DepthTakeResult depth_take(const engine::File& folder, const std::string& take, engine::SeqWriter<DepthScan>& scans,
                           const DepthTakeOptions& options, engine::Progress& progress) {
  check(folder.is_folder(), title_of(folder), ": is a file, expected the folder of a recorded stream");
  const std::string camera_path = folder.find("camera.json");
  check(!camera_path.empty(), title_of(folder), ": has no camera.json, which says fx, fy, cx and cy");
  const ScanCameraFile camera = read_scan_camera(engine::File::at(camera_path));
  std::optional<ScanProjectorFile> projector;
  if (const std::string path = folder.find("projector.json"); !path.empty())
    projector = read_scan_projector(engine::File::at(path));
  std::vector<std::string> troubles;
  std::vector<Frame> frames = frames_of(folder, take, troubles);
  check(!frames.empty(), title_of(folder), ": has no files of take ", take, " below depth, cloud or pattern");
  if (!camera.says_rate)
    troubles.push_back(message("camera.json has no rate_hz: ", camera.rate_hz, " frames per second are taken"));

  // Twice through: what is a face's size and distance in this take is known only at its end, and scans are not all
  // held.
  const auto read = [&](Frame& frame) -> std::optional<DepthFrame> {
    try {
      return read_depth_frame(frame.paths, camera, projector ? &*projector : nullptr);
    } catch (const std::exception& error) {
      frame.trouble = error.what();
      return {};
    }
  };
  std::vector<double> areas, depths;
  double done = 0;
  for (Frame& frame : frames) {
    progress.report(0.5 * done++ / static_cast<double>(frames.size()));
    if (!frame.trouble.empty()) continue;
    const std::optional<DepthFrame> found = read(frame);
    if (!found) continue;
    frame.measured_px = found->measured_px;
    frame.median_depth_mm = found->median_depth_mm;
    frame.width = found->scan.picture.width;
    frame.height = found->scan.picture.height;
    if (found->median_depth_mm < options.near_mm || found->median_depth_mm > options.far_mm) {
      frame.trouble = depth_trouble(found->median_depth_mm, found->whole_numbers, camera, options);
    } else if (found->width_mm < options.least_width_mm || found->width_mm > options.most_width_mm) {
      frame.trouble =
          message("what is measured is ", std::lround(found->width_mm), " mm wide, expected ", options.least_width_mm,
                  " to ", options.most_width_mm, ": are fx and the unit of depth those of this camera?");
    } else {
      areas.push_back(frame.measured_px);
      depths.push_back(frame.median_depth_mm);
    }
  }
  const double area_px = median(areas), depth_mm = median(depths);
  const auto [width, height] = usual_size(frames);
  for (Frame& frame : frames) {
    if (!frame.trouble.empty()) continue;
    if (frame.width != width || frame.height != height)
      frame.trouble = message("it is ", frame.width, " x ", frame.height, " pixels, expected ", width, " x ", height,
                              " as the others");
    else if (frame.measured_px < options.least_face * area_px)
      frame.trouble =
          message("it shows no face: ", frame.measured_px, " pixels are measured, the take's median is ", area_px);
    else if (std::fabs(frame.median_depth_mm - depth_mm) > options.face_change_mm)
      frame.trouble = message("it shows no face: its median depth is ", std::lround(frame.median_depth_mm),
                              " mm, the take's ", std::lround(depth_mm));
  }
  DepthTakeResult result;
  const long first = frames.front().number;
  done = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Frame& frame = frames[i];
    progress.report(0.5 + 0.5 * done++ / static_cast<double>(frames.size()));
    if (i > 0 && frame.number > frames[i - 1].number + 1) {
      const long from = frames[i - 1].number + 1, to = frame.number - 1;
      troubles.push_back(from == to ? message("frame ", from, " is missing")
                                    : message("frames ", from, " to ", to, " are missing"));
    }
    if (frame.trouble.empty()) {
      if (std::optional<DepthFrame> found = read(frame)) {
        result.timeline.time_s.push_back(static_cast<double>(frame.number - first) / camera.rate_hz);
        scans.push(std::to_string(frame.number), std::move(found->scan));
        continue;
      }
    }
    ++result.dropped;
    // One line for frames that follow one another with the same trouble.
    const std::size_t start = i;
    while (i + 1 < frames.size() && frames[i + 1].number == frames[i].number + 1 &&
           frames[i + 1].trouble == frame.trouble)
      ++i, ++result.dropped;
    troubles.push_back(message(
        i == start ? message("frame ", frame.number) : message("frames ", frame.number, " to ", frames[i].number), ": ",
        frame.trouble, "; left out"));
  }
  result.kept = scans.count() > 0;
  if (result.kept) result.timeline.duration_s = result.timeline.time_s.back() + 1 / camera.rate_hz;
  const auto report = [&](const std::string& line, bool warn) {
    if (warn) progress.warn(line);
    result.report += line + "\n";
  };
  if (!result.kept)
    report(message("take ", take, ": none of its ", frames.size(), " frames is left", first_trouble(frames),
                   "; the take is left out"),
           true);
  for (const std::string& trouble : troubles) report("take " + take + ", " + trouble, result.kept);
  return result;
}

}  // namespace face::decode
