// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/opencv_flow.h"

#include <algorithm>
#include <cmath>
#include <opencv2/optflow.hpp>
#include <opencv2/video/tracking.hpp>

#include "nodes/base/check.h"
#include "nodes/flow/plane.h"

namespace face::flow {
namespace {

std::size_t channel_of(const FeatureMap& map, const std::string& name) {
  std::string names;
  for (std::size_t c = 0; c < map.names.size(); ++c) {
    if (map.names[c] == name) return c;
    names += (c > 0 ? ", " : "") + map.names[c];
  }
  fail("channel is \"", name, "\", the pictures have ", names);
}

cv::Mat eight_bit(const FeatureMap& map, std::size_t channel, double low, double high) {
  cv::Mat out(map.height, map.width, CV_8U, cv::Scalar(0));
  const std::size_t count = map.valid.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (!map.valid[i]) continue;
    const double value = (static_cast<double>(map.values[channel * count + i]) - low) * 255 / (high - low);
    out.data[i] = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0l, 255l));
  }
  return out;
}

FlowField run(cv::DenseOpticalFlow& algorithm, const FeatureMap& reference, const FeatureMap& target,
              const FlowField* start, const std::string& name) {
  check_pair(reference, target, start);
  const std::size_t channel = channel_of(reference, name), count = reference.valid.size();
  double low = 0, high = 255;
  if (name != "grey") {
    std::vector<float> values;
    for (std::size_t i = 0; i < count; ++i)
      if (reference.valid[i]) values.push_back(reference.values[channel * count + i]);
    std::sort(values.begin(), values.end());
    if (!values.empty()) {
      low = static_cast<double>(values[values.size() / 100]);
      high = std::max(static_cast<double>(values[values.size() - 1 - values.size() / 100]), low + 1e-3);
    }
  }
  const cv::Mat a = eight_bit(reference, channel, low, high), b = eight_bit(target, channel, low, high);
  Plane u, v;
  start_planes(start, reference.width, reference.height, u, v);
  cv::Mat flow;
  if (start) {
    flow.create(reference.height, reference.width, CV_32FC2);
    for (std::size_t i = 0; i < count; ++i) {
      flow.ptr<float>()[2 * i] = u.values[i];
      flow.ptr<float>()[2 * i + 1] = v.values[i];
    }
  }
  algorithm.calc(a, b, flow);
  for (std::size_t i = 0; i < count; ++i) {
    u.values[i] = flow.ptr<float>()[2 * i];
    v.values[i] = flow.ptr<float>()[2 * i + 1];
  }
  return field_of(reference, target, u, v);
}

}  // namespace

FlowField dis_flow(const FeatureMap& reference, const FeatureMap& target, const FlowField* start,
                   const DisFlowOptions& options) {
  if (start)
    for (const Vec2f& d : start->displacement_px)
      check(std::isfinite(d[0]) && std::isfinite(d[1]), "start has a displacement of (", d[0], ", ", d[1],
            ") px, expected numbers");
  const cv::Ptr<cv::DISOpticalFlow> algorithm = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM);
  algorithm->setUseSpatialPropagation(false);
  return run(*algorithm, reference, target, start, options.channel);
}

FlowField farneback_flow(const FeatureMap& reference, const FeatureMap& target, const FlowField* start,
                         const FarnebackFlowOptions& options) {
  const cv::Ptr<cv::FarnebackOpticalFlow> algorithm = cv::FarnebackOpticalFlow::create();
  if (start) algorithm->setFlags(cv::OPTFLOW_USE_INITIAL_FLOW);
  return run(*algorithm, reference, target, start, options.channel);
}

FlowField tvl1_flow(const FeatureMap& reference, const FeatureMap& target, const FlowField* start,
                    const Tvl1FlowOptions& options) {
  const cv::Ptr<cv::optflow::DualTVL1OpticalFlow> algorithm = cv::optflow::createOptFlow_DualTVL1();
  algorithm->setUseInitialFlow(start != nullptr);
  return run(*algorithm, reference, target, start, options.channel);
}

}  // namespace face::flow
