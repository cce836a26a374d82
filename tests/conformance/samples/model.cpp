// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "nodes/base/random.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/rig.h"
#include "nodes/types/weights.h"
#include "tests/conformance/samples/shared.h"
#include "tests/support/lip_sheet.h"

namespace conformance {
namespace {

// Without the outline: the sample's head is a sheet, which has none.
const Maker inner_points = changed<face::Landmarks>(face_points, [](face::Landmarks& landmarks, int) {
  landmarks.points.erase(landmarks.points.begin(), landmarks.points.begin() + 17);
});

// With more shapes of its own from variant to variant.
const Maker larger_rig = changed<face::Rig>(another("rig", 0), [](face::Rig& rig, int variant) {
  for (int s = 0; s < variant; ++s) rig.shapes.push_back({"own_" + std::to_string(s), {}, {}});
});

// Of shapes alone, larger from variant to variant.
const Maker bare_model =
    changed<face::MorphableModel>(made_by("model.from_rig", "model"), [](face::MorphableModel& model, int variant) {
      model.mean_albedo.clear();
      model.albedo = {};
      for (face::Vec3f& point : model.mean.points_mm) point[0] *= 1 + 0.1f * static_cast<float>(variant);
    });

// A sheet with a mouth, which in the second is shut, and a scan of it whose mouth is open farther.
const Maker lips = made([](int variant) { return test::lip_sheet(2, 90, variant != 1); });
const Maker lip_points = made([](int variant) { return face::MeshPoints{test::lip_sheet(0.5 * variant).points_mm}; });
const Maker open_lips = made([](int variant) {
  constexpr int size = 96;  // a pixel is about a millimetre
  face::DepthScan scan;
  scan.camera.focal_px = 200;
  scan.camera.position_mm = {0, 0, 290};
  scan.camera.centre_x_px = scan.camera.centre_y_px = 47.5f;
  scan.picture = {size, size, 1, std::vector<std::uint8_t>(size * size, 90)};
  scan.depth_mm.assign(size * size, 202);
  for (int y = 45 - variant; y < 52 + variant; ++y)
    for (int x = 34; x < 62; ++x) scan.depth_mm[static_cast<std::size_t>(size * y + x)] = 0;
  return scan;
});

// A head that sways and trembles, differently from variant to variant.
const Maker trembling_fit = made([](int variant) {
  face::Random random(static_cast<std::uint64_t>(variant));
  const double turn = 0.05 * std::sin(0.3 * variant) + 0.01 * random.normal();
  face::FaceFit fit;
  fit.converged = true;
  fit.camera.position_mm = {0, 0, 600};
  const auto c = static_cast<float>(std::cos(turn)), s = static_cast<float>(std::sin(turn));
  fit.camera.cam_from_world = {c, 0, s, 0, 1, 0, -s, 0, c};
  return fit;
});

const Registered model({
    .inputs =
        {
            {"model.add_albedo.model", bare_model},
            {"model.smooth_track.fits", trembling_fit},
            {"model.leave_openings.mesh", lips},
            {"model.leave_openings.shape", lip_points},
            {"model.leave_openings.scan", open_lips},
            {"model.region_pca.weights", matrices(525, 1)},
            {"model.fit_landmarks.landmarks", inner_points},
            {"model.fit_landmarks.picture", sized_picture},
            {"model.fit_image.landmarks", inner_points},
            {"model.fit_image.picture", made_by("phantom.video_frame", "image")},
            {"model.fit_images.landmarks", inner_points},
            {"model.fit_images.pictures", made_by("phantom.video_frame", "image")},
            {"model.mouth_shapes.rig", larger_rig},
            {"model.rebuild_shape.coefficients", made([](int variant) {
               return face::Weights{{0.5f, 0.2f + 0.1f * static_cast<float>(variant)}};
             })},
        },
    .types =
        {
            {"morphable_model", made_by("model.from_rig", "model")},
            {"shape_model", made_by("model.region_pca", "model")},
        },
    .lengths = {{"model.fit_images.pictures", 2}, {"model.fit_images.landmarks", 2}, {"model.smooth_track.fits", 24}},
    .values = {{"model.scan_template.longest_edge_mm", {6.0, 8.0, 10.0}}},
});

}  // namespace
}  // namespace conformance
