// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/fit_images.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/model/fit_joint.h"
#include "nodes/model/fit_landmarks.h"
#include "nodes/model/joint_step.h"
#include "nodes/model/likeness.h"
#include "nodes/model/pose_model.h"
#include "nodes/model/settle_mouths.h"

namespace face::model {
namespace {

constexpr double usual_brightness = 0.75;  // of skin; darker pictures are fitted as if they had it
constexpr double least_exposure = 0.1;     // below, what is seen is noise
constexpr int mouth_steps = 8;
constexpr int light_steps = 6;

// One size of the picture: of the eye distance on it, how much the points still weigh, how much of the picture's weight
// is used already (E_F first, E_I growing).
struct Stage {
  double eyes_px;
  StepWeights weights;
  double points, steps;  // factors of the options
  bool mirror;           // whether highlights are sought: a mouth and its teeth are to be in place before
};
constexpr Stage stages[] = {{28, {.points = 1.0, .image = 0.3}, 1, 1, false},
                            {55, {.points = 0.5, .image = 0.7}, 1, 1, false},
                            {110, {.points = 0.2, .image = 1.0}, 1, 1, true},
                            {160, {.points = 0.2, .image = 1.0}, 4, 1.5, true}};
constexpr std::size_t stage_count = std::size(stages);

FitLandmarksOptions points_options(const FitImageOptions& options) {
  FitLandmarksOptions points;
  points.identities = options.identities;
  points.expressions = options.expressions;
  points.point_sigma = options.point_sigma;
  return points;
}

// Where the fits by points alone have the pictures.
Joint start_joint(const MorphableModel& model, const std::vector<const Image*>& pictures,
                  const std::vector<const Landmarks*>& landmarks, const std::vector<FaceFit>& fits,
                  const FitImageOptions& options) {
  Joint joint;
  joint.model = &model;
  joint.options = options;
  joint.basis =
      make_skin_basis(model, static_cast<std::size_t>(options.identities),
                      static_cast<std::size_t>(options.expressions), static_cast<std::size_t>(options.albedos));
  joint.gaps = lip_gap_rows(model);
  joint.identity.assign(joint.basis.identities, 0.0);
  joint.albedo.assign(joint.basis.albedos, 0.0);
  for (std::size_t k = 0; k < joint.identity.size(); ++k)
    for (const FaceFit& fit : fits) joint.identity[k] += fit.identity[k] / static_cast<double>(fits.size());
  const Vec3f centre = turning_point(model);
  for (std::size_t m = 0; m < pictures.size(); ++m) {
    Picture& picture = joint.pictures.emplace_back();
    picture.landmarks = make_landmark_basis(model, *landmarks[m], joint.basis.identities, joint.basis.expressions);
    picture.state.pose = pose_of(fits[m].camera, centre);
    picture.state.expression.assign(fits[m].expression.begin(), fits[m].expression.end());
    picture.log_focal =
        std::log(points_options(options).focal_share * std::max(pictures[m]->width, pictures[m]->height));
    const std::vector<Vec3f> points = posed(picture.landmarks, joined(joint.identity, picture.state.expression));
    picture.eyes_px = eye_distance_px(picture.landmarks, points, picture.state.pose);
    // The usual light over the camera, from a little above.
    picture.state.light.direction = {0.0f, 0.4f, 0.9165f};
  }
  return joint;
}

// A picture at every stage's size, and last at the one that likeness takes.
std::vector<PictureLevel> sizes_of(const Image& image, double eyes_px) {
  std::vector<double> factors;
  for (const Stage& stage : stages) factors.push_back(std::min(1.0, stage.eyes_px / eyes_px));
  factors.push_back(std::min(1.0, likeness_eyes_px / eyes_px));
  return make_levels(image, factors);
}

// What to divide a picture by so that its skin is of usual brightness. A camera's gain does this to all that is seen.
double exposure_of(const Joint& joint, const Picture& picture, const PictureLevel& level, Random& random) {
  const PixelRows rows = pixel_rows(joint.basis, joint.identity, skin_albedo(joint.basis, joint.albedo), picture.state,
                                    level, {0, 0, 0, false}, static_cast<std::size_t>(joint.options.points), random);
  return rows.residual.empty() ? 1.0 : std::clamp(rows.brightness / usual_brightness, least_exposure, 1.0);
}

PictureLevel exposed(PictureLevel level, double exposure) {
  if (exposure == 1) return level;
  for (Vec3f& colour : level.colours)
    for (float& value : colour) value = static_cast<float>(value / exposure);
  return level;
}

// All stages, then mouths. sizes: of every picture.
void run_stages(const std::vector<std::vector<PictureLevel>>& sizes, Random& random, Joint& joint) {
  const FitImageOptions options = joint.options;
  std::vector<PictureLevel> levels;
  for (std::size_t i = 0; i < stage_count; ++i) {
    const Stage& stage = stages[i];
    levels.clear();
    for (std::size_t m = 0; m < sizes.size(); ++m) levels.push_back(exposed(sizes[m][i], joint.pictures[m].exposure));
    joint.mirror_held = !stage.mirror;
    StepWeights light_only = stage.weights;
    light_only.light_only = true;
    for (int k = 0; i == 0 && k < light_steps; ++k) step_joint(levels, light_only, random, joint);
    joint.options.points = std::llround(stage.points * static_cast<double>(options.points));
    const std::int64_t steps = std::llround(stage.steps * static_cast<double>(options.steps));
    for (std::int64_t k = 0; k < steps; ++k) step_joint(levels, stage.weights, random, joint);
  }
  joint.mirror_held = true;  // or teeth pass for highlights of lips
  settle_mouths(
      levels,
      [&](Joint& tried) {
        for (int k = 0; k < mouth_steps; ++k) step_joint(levels, stages[stage_count - 1].weights, random, tried);
      },
      joint);
}

std::vector<float> floats(const std::vector<double>& values) { return {values.begin(), values.end()}; }

// What was found of one picture. The exposure becomes part of gain and offset.
void write_fit(std::size_t index, const std::vector<PictureLevel>& sizes, Joint& joint, FaceFit& fit) {
  Picture& picture = joint.pictures[index];
  FaceLight& light = picture.state.light;
  for (std::size_t c = 0; c < 3; ++c) {
    light.gain[c] = static_cast<float>(picture.exposure * light.gain[c]);
    light.offset[c] = static_cast<float>(picture.exposure * light.offset[c]);
  }
  fit.identity = floats(joint.identity);
  fit.albedo = floats(joint.albedo);
  fit.expression = floats(picture.state.expression);
  fit.camera = camera_of(picture.state.pose);
  fit.light = light;
  report(joint, index, sizes[stage_count - 1], sizes.back(), fit);
}

}  // namespace

std::vector<FaceFit> fit_pictures(const MorphableModel& model, const std::vector<const Image*>& pictures,
                                  const std::vector<const Landmarks*>& landmarks, const FitImageOptions& options) {
  check(pictures.size() == landmarks.size(), "there are ", pictures.size(), " pictures and ", landmarks.size(),
        " sets of points");
  check(!pictures.empty(), "there is no picture");
  std::vector<FaceFit> fits;
  for (std::size_t m = 0; m < pictures.size(); ++m)
    fits.push_back(fit_landmarks(model, *landmarks[m], *pictures[m], points_options(options)));
  if (std::any_of(fits.begin(), fits.end(), [](const FaceFit& fit) { return !fit.converged; })) {
    // A picture whose points are no use spoils them all; those without a problem of their own say so.
    for (FaceFit& fit : fits) {
      if (fit.converged) fit.problem = "the points of another picture of this person could not be used";
      fit.converged = false;
    }
    return fits;
  }
  Joint joint = start_joint(model, pictures, landmarks, fits, options);
  std::vector<std::vector<PictureLevel>> sizes;
  for (std::size_t m = 0; m < pictures.size(); ++m) sizes.push_back(sizes_of(*pictures[m], joint.pictures[m].eyes_px));
  Random random(static_cast<std::uint64_t>(options.seed));
  for (std::size_t m = 0; m < pictures.size(); ++m)
    joint.pictures[m].exposure = exposure_of(joint, joint.pictures[m], sizes[m].front(), random);
  run_stages(sizes, random, joint);
  for (std::size_t m = 0; m < fits.size(); ++m) write_fit(m, sizes[m], joint, fits[m]);
  return fits;
}

engine::Seq<FaceFit> fit_images(const MorphableModel& model, const engine::Seq<Image>& pictures,
                                const engine::Seq<Landmarks>& landmarks, const FitImageOptions& options,
                                engine::Progress& progress) {
  std::vector<std::shared_ptr<const Image>> images;
  std::vector<std::shared_ptr<const Landmarks>> points;
  std::vector<const Image*> image_list;
  std::vector<const Landmarks*> point_list;
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    images.push_back(pictures.at(i));
    image_list.push_back(images.back().get());
    ids.push_back(pictures.id(i));
  }
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    points.push_back(landmarks.at(i));
    point_list.push_back(points.back().get());
  }
  std::vector<FaceFit> fits = fit_pictures(model, image_list, point_list, options);
  for (std::size_t m = 0; m < fits.size(); ++m)
    if (!fits[m].converged) progress.warn("the fit of picture " + ids[m] + " is not to be used: " + fits[m].problem);
  return {std::move(fits), ids};
}

}  // namespace face::model
