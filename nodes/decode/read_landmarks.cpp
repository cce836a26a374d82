// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_landmarks.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/base/find_landmark.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/json_file.h"
#include "nodes/decode/landmark_sets.h"

namespace face::decode {
namespace {

using Json = nlohmann::ordered_json;

constexpr double other_shape = 0.02;  // by which the sides' ratio may be rounded where a picture is scaled
constexpr const char* known_files = "our JSON, MediaPipe's JSON, or .pts";

bool inside(const Landmark& point, const ReadLandmarksResult& result) {
  return point.x_px >= -0.5 && point.y_px >= -0.5 && point.x_px <= static_cast<double>(result.image_width_px) - 0.5 &&
         point.y_px <= static_cast<double>(result.image_height_px) - 0.5;
}

void refuse_outside(const Landmark& point, const ReadLandmarksResult& result, const std::string& place) {
  if (!inside(point, result))
    fail(place, ": found (", point.x_px, ", ", point.y_px, "), expected a point inside the image of ",
         result.image_width_px, " x ", result.image_height_px, " pixels");
}

// Takes the size from the file, the image or both, which must agree.
void set_size(const Json* size, const Image* image, const std::string& title, ReadLandmarksResult& result) {
  if (size) {
    if (!size->is_array() || size->size() != 2)
      fail(title, " at /image_size: found ", describe_json(*size), ", expected [width, height] in pixels");
    result.image_width_px = json_index((*size)[0], title, "/image_size/0");
    result.image_height_px = json_index((*size)[1], title, "/image_size/1");
    const auto scaled_height = image ? static_cast<double>(image->width) * static_cast<double>(result.image_height_px) /
                                           static_cast<double>(std::max<std::int64_t>(result.image_width_px, 1))
                                     : 0;
    if (image && std::abs(scaled_height - image->height) > other_shape * image->height)
      fail(title, " at /image_size: found ", result.image_width_px, " x ", result.image_height_px,
           ", but the image is ", image->width, " x ", image->height, " pixels, which is no other size of it");
  } else if (image) {
    result.image_width_px = image->width;
    result.image_height_px = image->height;
  }
}

ReadLandmarksResult read_ours(const Json& json, const Image* image, const std::string& title) {
  ReadLandmarksResult result;
  set_size(&json_member(json, "image_size", title, ""), image, title, result);
  const auto& points = json_member(json, "points", title, "");
  if (!points.is_object() || points.empty())
    fail(title, " at /points: found ", describe_json(points), ", expected an object of names with [x, y]");
  for (const auto& [name, xy] : points.items()) {
    Landmark point{name, 0, 0, true};
    json_xy(xy, title, "/points/" + name, point.x_px, point.y_px);
    refuse_outside(point, result, title + " at /points/" + name);
    result.landmarks.points.push_back(point);
  }
  return result;
}

// Brings points of the file's picture to the size of the one at hand.
void scale_to(const Image& image, ReadLandmarksResult& result) {
  const auto width = static_cast<int>(result.image_width_px), height = static_cast<int>(result.image_height_px);
  if (width == image.width && height == image.height) return;
  for (Landmark& point : result.landmarks.points) {
    point.x_px = scaled_px(point.x_px, width, image.width);
    point.y_px = scaled_px(point.y_px, height, image.height);
  }
  result.image_width_px = image.width;
  result.image_height_px = image.height;
}

// Of the points of a clip, which are those of a face that is more upright than lying.
void check_places(const Landmarks& landmarks, const std::string& title) {
  for (const auto& [right, left] : {std::pair{"eye_inner_r", "eye_inner_l"}, {"lip_0", "lip_6"}, {"jaw_r", "jaw_l"}}) {
    const Landmark *const r = find_landmark(landmarks, right), *const l = find_landmark(landmarks, left);
    if (r && l && r->x_px >= l->x_px)
      fail(title, ": ", right, " lies at ", r->x_px, ", ", r->y_px, ", right of ", left, " at ", l->x_px, ", ", l->y_px,
           "; _r (and lip_0) is the face's own right, which is left in the picture: are the names swapped?");
  }
  for (const auto& [above, below] : {std::pair{"eye_inner_r", "lip_9"},
                                     {"eye_inner_l", "lip_9"},
                                     {"nose_tip", "lip_9"},
                                     {"lip_3", "lip_9"},
                                     {"lip_9", "chin"}}) {
    const Landmark *const a = find_landmark(landmarks, above), *const b = find_landmark(landmarks, below);
    if (a && b && a->y_px > b->y_px)
      fail(title, ": ", above, " lies at ", a->x_px, ", ", a->y_px, ", below ", below, " at ", b->x_px, ", ", b->y_px,
           ": are the names swapped, or the picture upside down?");
  }
}

bool is_point(const Json& json) { return json.is_object() && json.contains("x") && json.contains("y"); }

// The list of points, of the first face: by itself, in lists, or as a member that MediaPipe's programs use. Null where
// there is none; pointer is where it stands.
const Json* media_pipe_points(const Json& json, std::string& pointer, int depth = 0) {
  if (depth > 4) return nullptr;
  if (json.is_array() && !json.empty()) {
    if (is_point(json[0])) return &json;
    pointer += "/0";
    return media_pipe_points(json[0], pointer, depth + 1);
  }
  if (!json.is_object()) return nullptr;
  for (const char* name : {"face_landmarks", "faceLandmarks", "multi_face_landmarks", "landmarks", "landmark"})
    if (const auto member = json.find(name); member != json.end()) {
      pointer += std::string("/") + name;
      return media_pipe_points(*member, pointer, depth + 1);
    }
  return nullptr;
}

ReadLandmarksResult read_media_pipe(const Json& json, const Json& points, const std::string& pointer,
                                    const Image* image, const std::string& title) {
  ReadLandmarksResult result;
  const Json* size = json.is_object() && json.contains("image_size") ? &json["image_size"] : nullptr;
  set_size(size, image, title, result);
  check(result.image_width_px > 0 && result.image_height_px > 0, title,
        ": its points are shares of an image's width and height: connect the image, or put \"image_size\": [width, "
        "height] into the file");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string at = pointer + "/" + std::to_string(i);
    const double x = json_number(json_member(points[i], "x", title, at), title, at + "/x");
    const double y = json_number(json_member(points[i], "y", title, at), title, at + "/y");
    Landmark point{std::to_string(i), x * static_cast<double>(result.image_width_px) - 0.5,
                   y * static_cast<double>(result.image_height_px) - 0.5, true};
    point.valid = inside(point, result);
    result.landmarks.points.push_back(std::move(point));
  }
  return result;
}

// The numbers between braces, two per line.
ReadLandmarksResult read_pts(const std::string& text, const Image* image, const std::string& title) {
  ReadLandmarksResult result;
  set_size(nullptr, image, title, result);
  long stated = -1;
  bool open = false, closed = false;
  std::size_t line = 0;
  for (std::size_t at = 0; at < text.size() && !closed;) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view rest(text.data() + at, end - at);
    at = end + 1;
    ++line;
    const auto skip = [&] {
      while (!rest.empty() && (rest[0] == ' ' || rest[0] == '\t' || rest[0] == '\r')) rest.remove_prefix(1);
    };
    skip();
    if (rest.empty()) continue;
    const std::string shown(rest.substr(0, std::min<std::size_t>(rest.find('\r'), 40)));
    const auto number = [&](auto& value) {
      skip();
      const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
      if (error != std::errc()) return false;
      rest.remove_prefix(static_cast<std::size_t>(stop - rest.data()));
      return true;
    };
    if (!open) {
      if (rest.starts_with("n_points:")) {
        rest.remove_prefix(9);
        if (!number(stated)) fail(title, ":", line, ": found \"", shown, "\", expected n_points: and a count");
      } else if (rest[0] == '{') {
        open = true;
      } else if (!rest.starts_with("version:")) {
        fail(title, ":", line, ": found \"", shown, "\", expected version:, n_points: or {");
      }
      continue;
    }
    if (rest[0] == '}') {
      closed = true;
      continue;
    }
    Landmark point{std::to_string(result.landmarks.points.size()), 0, 0, true};
    const bool two = number(point.x_px) && number(point.y_px);
    skip();
    if (!two || !rest.empty() || !std::isfinite(point.x_px) || !std::isfinite(point.y_px))
      fail(title, ":", line, ": found \"", shown, "\", expected x and y of a point");
    point.x_px -= 1;  // pixels count from 1
    point.y_px -= 1;
    if (image) refuse_outside(point, result, title + ":" + std::to_string(line));
    result.landmarks.points.push_back(std::move(point));
  }
  check(closed, title, ":", line, ": found the end of the file, expected }");
  const auto count = static_cast<long>(result.landmarks.points.size());
  check(stated < 0 || stated == count, title, ": found ", count, " points, n_points says ", stated);
  check(count > 0, title, ": found no points");
  return result;
}

// is_mesh: whether it holds MediaPipe's.
ReadLandmarksResult read_any_json(const engine::File& file, const Image* image, const ReadLandmarksOptions& options,
                                  bool& is_mesh) {
  const std::string title = title_of(file);
  const Json json = read_json(file);
  if (json.is_object() && json.contains("frame")) {
    const std::int64_t frame = json_index(json["frame"], title, "/frame");
    check(options.frame < 0 || frame == options.frame, title, " at /frame: found ", frame, ", expected ", options.frame,
          ": these points are of another frame of the clip");
  }
  if (!json.is_object() || !json.contains("points")) {
    std::string pointer;
    if (const Json* points = media_pipe_points(json, pointer))
      if (points->is_array() && !points->empty() && is_point((*points)[0])) {
        is_mesh = true;
        return read_media_pipe(json, *points, pointer, image, title);
      }
  }
  return read_ours(json, image, title);
}

}  // namespace

ReadLandmarksResult read_landmarks(const engine::File& file, const Image* image, const ReadLandmarksOptions& options) {
  const std::string title = title_of(file);
  const std::string suffix = lower_suffix(file);
  check(suffix != ".xml" && suffix != ".dat" && suffix != ".task" && suffix != ".csv", title, ": found the suffix \"",
        file.suffix(), "\", expected ", known_files);
  const std::string text = read_bytes(file);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const bool is_pts = suffix == ".pts" || (first != std::string::npos && text.compare(first, 8, "version:") == 0);
  bool is_mesh = false;
  ReadLandmarksResult result = is_pts ? read_pts(text, image, title) : read_any_json(file, image, options, is_mesh);
  if (image) scale_to(*image, result);
  Landmarks& landmarks = result.landmarks;
  if (options.names != LandmarkNames::file)
    landmarks = is_mesh ? multi_pie_of_media_pipe(landmarks) : with_two_digits(std::move(landmarks));
  if (options.names == LandmarkNames::clip) {
    if (landmarks.points.size() == 68 && landmarks.points[0].name == "00")
      landmarks = clip_points_of_multi_pie(landmarks);
    check_places(landmarks, title);
  }
  return result;
}

}  // namespace face::decode
