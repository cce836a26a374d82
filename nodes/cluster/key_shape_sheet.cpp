// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/key_shape_sheet.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <string>

#include "nodes/base/check.h"
#include "nodes/render/draw_landmarks.h"
#include "nodes/render/make_contact_sheet.h"

namespace face::cluster {
namespace {

Image image_of(const cv::Mat& mat) {
  Image image{mat.cols, mat.rows, 3, {}};
  image.pixels.assign(mat.datastart, mat.dataend);
  return image;
}

// A square about the landmarks, a third larger than they need; black outside the frame.
Image crop(const Image& frame, const Landmarks& landmarks, int picture_px) {
  double low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};
  for (const Landmark& point : landmarks.points) {
    const double xy[2] = {point.x_px, point.y_px};
    for (std::size_t d = 0; d < 2; ++d) {
      low[d] = std::min(low[d], xy[d]);
      high[d] = std::max(high[d], xy[d]);
    }
  }
  const double side = 1.33 * std::max({high[0] - low[0], high[1] - low[1], 8.0}), scale = picture_px / side;
  Landmarks enlarged = landmarks;
  for (Landmark& point : enlarged.points) {
    point.x_px = (point.x_px - (low[0] + high[0] - side) / 2) * scale;
    point.y_px = (point.y_px - (low[1] + high[1] - side) / 2) * scale;
  }
  const int type = frame.channels == 1 ? CV_8UC1 : frame.channels == 3 ? CV_8UC3 : CV_8UC4;
  const cv::Mat source(frame.height, frame.width, type, const_cast<std::uint8_t*>(frame.pixels.data()));
  const double values[6] = {scale, 0,     -(low[0] + high[0] - side) / 2 * scale,
                            0,     scale, -(low[1] + high[1] - side) / 2 * scale};
  cv::Mat picture;
  cv::warpAffine(source, picture, cv::Mat(2, 3, CV_64F, const_cast<double*>(values)), {picture_px, picture_px},
                 cv::INTER_LINEAR);
  Image cut{picture_px, picture_px, frame.channels, {}};
  cut.pixels.assign(picture.datastart, picture.dataend);
  return render::draw_landmarks(cut, enlarged);
}

Image plot(const Table& curve, std::size_t kept, int picture_px) {
  cv::Mat mat(picture_px, picture_px, CV_8UC3, cv::Scalar(255, 255, 255));
  const double border = 0.08 * picture_px, span = picture_px - 2 * border;
  const auto column_of = [&](double groups) {
    const double last = std::max(2.0, static_cast<double>(curve.rows.size()));
    return border + span * (groups - 1) / (last - 1);
  };
  const auto draw = [&](std::size_t column, const cv::Scalar& color) {
    double largest = 0;
    for (const TableRow& row : curve.rows) largest = std::max(largest, row.values[column]);
    cv::Point before;
    for (std::size_t i = 0; i < curve.rows.size() && largest > 0; ++i) {
      const cv::Point here(
          static_cast<int>(std::lround(column_of(curve.rows[i].values[0]))),
          static_cast<int>(std::lround(picture_px - border - span * curve.rows[i].values[column] / largest)));
      if (i > 0) cv::line(mat, before, here, color, 2, cv::LINE_AA);
      before = here;
    }
  };
  const int at = static_cast<int>(std::lround(column_of(static_cast<double>(kept))));
  cv::line(mat, {at, 0}, {at, picture_px}, cv::Scalar(190, 190, 190), 1);
  draw(1, cv::Scalar(40, 80, 220));
  draw(2, cv::Scalar(210, 40, 40));
  return image_of(mat);
}

}  // namespace

Image key_shape_sheet(const KeyShapes& key_shapes, const engine::Seq<Image>& frames,
                      const engine::Seq<Landmarks>* tracks, const Table* curve, const KeyShapeSheetOptions& options) {
  check(!key_shapes.shapes.empty(), "there are no key shapes");
  const auto landmarks_of = [&](const KeyShape& key) {
    for (std::size_t i = 0; tracks && i < tracks->size(); ++i)
      if (tracks->id(i) == key.frame) return *tracks->at(i);
    check(tracks == nullptr, "tracks has no landmarks of key shape ", key.frame);
    return key.landmarks;
  };
  const int picture_px = static_cast<int>(options.picture_px);
  // In the frames' order: a video is decoded once.
  std::map<std::string, Image> cuts;
  for (std::size_t i = 0; i < frames.size(); ++i)
    for (const KeyShape& key : key_shapes.shapes) {
      if (key.frame != frames.id(i)) continue;
      const auto frame = frames.at(i);
      const std::size_t expected = static_cast<std::size_t>(std::max(0, frame->width)) *
                                   static_cast<std::size_t>(std::max(0, frame->height)) *
                                   static_cast<std::size_t>(std::max(0, frame->channels));
      check(expected > 0 && frame->pixels.size() == expected, "frame ", key.frame, " has ", frame->pixels.size(),
            " bytes, expected ", frame->width, " x ", frame->height, " x ", frame->channels);
      cuts[key.frame] = crop(*frame, landmarks_of(key), picture_px);
    }
  std::vector<Image> pictures;
  std::vector<render::Caption> captions;
  for (const KeyShape& key : key_shapes.shapes) {
    const auto cut = cuts.find(key.frame);
    check(cut != cuts.end(), "key shape ", key.frame, " is no frame of the video");
    pictures.push_back(cut->second);
    captions.push_back({"frame " + key.frame, "stands for " + std::to_string(key.size) + " frames"});
  }
  if (curve) {
    for (const TableRow& row : curve->rows)
      check(row.values.size() == 3, "row ", row.name, " of the curve has ", row.values.size(),
            " numbers, expected groups, distance and error");
    pictures.push_back(plot(*curve, key_shapes.shapes.size(), picture_px));
    captions.push_back({"1 to " + std::to_string(curve->rows.size()) + " groups", "red: error, blue: cost of merging"});
  }
  return render::make_contact_sheet(pictures, captions, static_cast<int>(options.columns));
}

}  // namespace face::cluster
