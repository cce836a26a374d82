// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/make_person.h"

#include "nodes/base/check.h"
#include "nodes/base/pose.h"
#include "nodes/phantom/face_places.h"
#include "nodes/phantom/person_dots.h"
#include "nodes/phantom/person_random.h"
#include "nodes/phantom/person_skin.h"
#include "nodes/phantom/person_warp.h"
#include "nodes/phantom/set_back_teeth.h"
#include "nodes/phantom/shut_lids.h"

namespace face::phantom {
namespace {

// Normal, without its rare ends: a face that is one in a thousand in many ways at once is nobody's.
double trimmed_normal(Random& random) {
  constexpr double kEnd = 2.5;
  double value = random.normal();
  while (std::abs(value) > kEnd) value = random.normal();
  return value;
}

Matrix random_coefficients(const ShapeSet* modes, std::int64_t seed, double spread) {
  const std::size_t count = modes ? modes->shapes.size() : 0;
  Matrix coefficients{1, count, std::vector<double>(count)};
  Random random = series(seed, 1);
  // Rounded to float: what the vertices were moved by, exactly.
  for (double& value : coefficients.values) value = static_cast<float>(spread * trimmed_normal(random));
  return coefficients;
}

void check_modes(const Rig& rig, const ShapeSet& modes) {
  for (const Shape& mode : modes.shapes) {
    check(mode.vertices.size() == mode.offsets_mm.size(), "mode ", mode.name, " has ", mode.vertices.size(),
          " vertices, but ", mode.offsets_mm.size(), " offsets");
    check(mode.vertices.empty() || mode.vertices.back() < rig.neutral.points_mm.size(), "mode ", mode.name,
          " moves vertex ", mode.vertices.empty() ? 0 : mode.vertices.back(), ", but the rig has ",
          rig.neutral.points_mm.size(), ": is it another head's?");
  }
}

}  // namespace

MakePersonResult make_person(const Rig& rig, const ShapeSet* modes, const std::string* id,
                             const MakePersonOptions& options) {
  check(options.spread >= 0, "spread is ", options.spread, ", expected at least 0");
  check(options.warp_mm >= 0, "warp_mm is ", options.warp_mm, ", expected at least 0");
  check(options.marker_radius_mm > 0, "marker_radius_mm is ", options.marker_radius_mm, ", expected more than 0");
  if (modes) check_modes(rig, *modes);
  MakePersonResult result;
  const std::int64_t seed = person_seed(options.seed, id);
  result.person = rig;
  Rig& person = result.person;
  result.coefficients = random_coefficients(modes, seed, options.spread);
  for (std::size_t k = 0; k < result.coefficients.columns; ++k)
    if (result.coefficients.at(0, k) != 0)
      add_shape(modes->shapes[k], static_cast<float>(result.coefficients.at(0, k)), person.neutral.points_mm);
  if (options.warp_mm > 0) result.warp_mm = warp_person(seed, options.warp_mm, person);
  if (options.warp_mm > 0 || options.spread > 0) {
    shut_lids(rig, person);
    set_back_teeth(rig, person);
  }

  if (!options.skin && !options.moles && !options.lipstick && !options.painted && options.markers == Markers::none)
    return result;
  const FacePlaces places(rig);
  if (options.skin) color_person(rig.neutral, places, {seed, options.beard, options.lightest}, person.neutral);
  if (options.lipstick) put_lipstick(rig.neutral, places, seed, person.neutral);
  if (options.painted) paint_person(seed, person.neutral);
  if (options.moles) result.dots = random_moles(rig, places, seed, options.lightest);
  if (options.markers != Markers::none) {
    const Vector3 white = {0.97, 0.97, 0.96}, black = {0.03, 0.03, 0.03};
    result.markers =
        named_markers(rig, places, options.marker_radius_mm, options.markers == Markers::white ? white : black);
    result.dots.dots.insert(result.dots.dots.end(), result.markers.dots.begin(), result.markers.dots.end());
  }
  return result;
}

}  // namespace face::phantom
