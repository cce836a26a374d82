// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/annotate.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "nodes/base/check_image.h"

namespace face::track {
namespace {

using Json = nlohmann::ordered_json;

// A name and, for the person who places it, where the point is. Right and left are the filmed person's.
Json layout_of(PointLayout layout) {
  Json points = Json::array();
  const auto add = [&](const std::string& name, const std::string& hint) {
    points.push_back({{"name", name}, {"hint", hint}});
  };
  if (layout == PointLayout::lips18) {
    add("eye_inner_r", "inner corner of the right eye (left in the picture)");
    add("eye_inner_l", "inner corner of the left eye");
    add("nose_tip", "tip of the nose, or its base between the nostrils");
  }
  constexpr const char* lips[] = {"right corner of the mouth (left in the picture)",
                                  "upper lip's outer edge, near that corner",
                                  "upper lip, peak of the bow",
                                  "upper lip, notch in the middle",
                                  "upper lip, other peak",
                                  "upper lip, near the left corner",
                                  "left corner of the mouth",
                                  "lower lip's outer edge, near the left corner",
                                  "lower lip, left of its middle",
                                  "lower lip, lowest point in the middle",
                                  "lower lip, right of its middle",
                                  "lower lip, near the right corner"};
  for (std::size_t i = 0; i < std::size(lips); ++i) add("lip_" + std::to_string(i), lips[i]);
  if (layout == PointLayout::lips18) {
    add("jaw_r", "jaw, below the right corner of the mouth");
    add("chin", "tip of the chin");
    add("jaw_l", "jaw, below the left corner of the mouth");
  }
  return points;
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string jpeg_url(const Image& image, int quality) {
  cv::Mat picture(image.height, image.width, CV_8UC(image.channels),
                  const_cast<std::uint8_t*>(image.pixels.data()));  // only read
  cv::Mat bgr;  // of its own: a copy of the header would be converted in place
  if (image.channels == 1) bgr = picture;
  if (image.channels == 3) cv::cvtColor(picture, bgr, cv::COLOR_RGB2BGR);
  if (image.channels == 4) cv::cvtColor(picture, bgr, cv::COLOR_RGBA2BGR);
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return "data:image/jpeg;base64," + base64(bytes);
}

double tenth(double value) { return std::round(value * 10) / 10; }

}  // namespace

engine::File annotate(const engine::Seq<Image>& frames, const engine::Seq<Landmarks>* tracks,
                      const engine::Seq<Landmarks>* corrections, const AnnotateOptions& options) {
  check(!frames.empty(), "the clip has no frames");
  check(options.first_frame < static_cast<std::int64_t>(frames.size()), "first_frame is ", options.first_frame,
        ", the clip has ", frames.size(), " frames");
  check(!tracks || tracks->size() == frames.size(), "frames has ", frames.size(), " elements, tracks has ",
        tracks ? tracks->size() : 0);
  Json data;
  data["points"] = layout_of(options.points);
  data["frames"] = Json::array();
  for (std::int64_t i = options.first_frame; i < static_cast<std::int64_t>(frames.size()); i += options.every) {
    if (static_cast<std::int64_t>(data["frames"].size()) >= options.max_frames) break;
    const auto index = static_cast<std::size_t>(i);
    const auto image = frames.at(index);
    check_image(*image, "frame " + frames.id(index));
    if (data["frames"].empty()) data["image_size"] = {image->width, image->height};
    Json entry{{"frame", i}, {"picture", jpeg_url(*image, static_cast<int>(options.jpeg_quality))}};
    if (tracks) {
      Json points = Json::object();
      const auto track = tracks->at(index);  // loaded for as long as it is held
      for (const Landmark& p : track->points) points[p.name] = {tenth(p.x_px), tenth(p.y_px), p.valid ? 1 : 0};
      entry["points"] = points;
    }
    data["frames"].push_back(std::move(entry));
  }
  data["fixes"] = Json::object();
  for (std::size_t i = 0; corrections && i < corrections->size(); ++i) {
    const auto fixed = corrections->at(i);
    for (const Landmark& p : fixed->points) data["fixes"][corrections->id(i)][p.name] = {p.x_px, p.y_px};
  }
  std::string page(annotate_page_head());
  std::string json = data.dump();
  for (std::size_t k = 0; (k = json.find('<', k)) != std::string::npos; k += 6) json.replace(k, 1, "\\u003c");  // names
  page += json;
  page += annotate_page_tail();
  return engine::File::from_bytes(std::move(page), ".html");
}

}  // namespace face::track
