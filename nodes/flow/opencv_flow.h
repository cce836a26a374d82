// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "nodes/types/feature_map.h"
#include "nodes/types/flow_field.h"

namespace face::flow {

// OpenCV's dense flows behind the interface of scan_flow. Each compares one channel as an 8-bit picture: "grey" as it
// is, any other stretched from the 1st to the 99th percentile of the reference; pixels that are not measured are black.
// A start is given to the algorithms as theirs.

struct DisFlowOptions {
  std::string channel = "grey";
};

// Fast Optical Flow using Dense Inverse Search (Kroeger, Timofte, Dai, Van Gool, ECCV 2016), OpenCV's preset "medium".
// Without its spatial propagation: OpenCV propagates within as many strips as it has threads, and results would differ
// from machine to machine; 25 steps per patch as in the preset.
FlowField dis_flow(const FeatureMap& reference, const FeatureMap& target, const FlowField* start,
                   const DisFlowOptions& options = {});

struct FarnebackFlowOptions {
  std::string channel = "grey";
};

// Two-Frame Motion Estimation Based on Polynomial Expansion (Farneback, SCIA 2003), OpenCV's defaults.
FlowField farneback_flow(const FeatureMap& reference, const FeatureMap& target, const FlowField* start,
                         const FarnebackFlowOptions& options = {});

struct Tvl1FlowOptions {
  std::string channel = "grey";
};

// A Duality Based Approach for Realtime TV-L1 Optical Flow (Zach, Pock, Bischof, DAGM 2007), OpenCV's defaults.
FlowField tvl1_flow(const FeatureMap& reference, const FeatureMap& target, const FlowField* start,
                    const Tvl1FlowOptions& options = {});

}  // namespace face::flow
