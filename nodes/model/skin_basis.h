// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "nodes/types/morphable_model.h"

namespace face::model {

// The part of a model that is compared with pictures: the skin from below the chin to the middle of the forehead,
// between the ears, where hair rarely hides it. Laid out by vertex, because pixels touch three vertices and all modes.
struct SkinBasis {
  std::size_t identities = 0, expressions = 0, albedos = 0;
  std::vector<std::uint32_t> vertices;                  // local to the model's
  std::vector<std::array<std::uint32_t, 3>> triangles;  // local
  std::vector<Vec3f> mean_mm, mean_albedo;              // local
  std::vector<float> shape_modes;                       // local x 3 x (identities + expressions)
  std::vector<float> albedo_modes;                      // local x 3 x albedos

  std::size_t shapes() const { return identities + expressions; }
};

SkinBasis make_skin_basis(const MorphableModel& model, std::size_t identities, std::size_t expressions,
                          std::size_t albedos);

// Local vertices, mm; coefficients: identity, then expression. Shorter lists leave the rest 0.
std::vector<Vec3f> posed_skin(const SkinBasis& basis, const std::vector<double>& identity,
                              const std::vector<double>& expression);
std::vector<Vec3f> skin_albedo(const SkinBasis& basis, const std::vector<double>& albedo);

}  // namespace face::model
