// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/types/image.h"
#include "nodes/types/rig.h"
#include "nodes/types/table.h"
#include "nodes/types/vec.h"

namespace face::evaluate {

// How far the vertices of an animation are from the true ones.
struct VertexErrorResult {
  Table table;     // row "all": lve_mm2, lip_error_mm, worst_lip_mm, mve_mm, readable_percent, lost_frames
  Table frames;    // a row per frame: worst_lip_mm, mean_vertex_mm (NaN where it was lost), valid (1, or 0 where lost)
  Image heat_map;  // mean over the frames
};

// Collects the errors of frames one by one. With e_ti the distance of vertex i to its true place in frame t,
//   lve_mm2 = 1/T sum_t max_{i in lips} e_ti^2   (lip vertex error: Richard et al., MeshTalk, ICCV 2021, section 4.2;
//             computed as by Xing et al., CodeTalker, CVPR 2023, cal_metric: squared, no root)
//   lip_error_mm = sqrt(lve_mm2)
//   worst_lip_mm = 1/T sum_t max_{i in lips} e_ti
//   mve_mm = mean of e_ti over all frames and the vertices of the skin
//   readable_percent = share of frames with max_{i in lips} e_ti <= readable_mm.
// T and the shares are of the frames that were not lost; NaN where all were.
class VertexErrors {
 public:
  VertexErrors(const Rig& rig, std::vector<std::uint32_t> lips);
  // points, truth: V x 3.
  void add(const std::string& frame, const std::vector<Vec3f>& points, const std::vector<Vec3f>& truth);
  // A frame that nothing is known of.
  void lose(const std::string& frame);
  VertexErrorResult result(double readable_mm, double full_scale_mm) const;

 private:
  const Rig& rig_;
  std::vector<std::uint32_t> lips_, skin_;
  std::vector<double> worst_mm_, mean_mm_, sum_mm_;  // of the frames that were not lost
  std::vector<bool> valid_;                          // of all frames
  std::vector<std::string> frames_;
};

}  // namespace face::evaluate
