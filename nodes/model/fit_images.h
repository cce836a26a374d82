// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/model/fit_image.h"

namespace face::model {

// fit_image over several pictures of one person: identity and albedo are shared, everything else is each picture's own.
// pictures and landmarks have the same length. Fits that are not to be believed are warned of.
engine::Seq<FaceFit> fit_images(const MorphableModel& model, const engine::Seq<Image>& pictures,
                                const engine::Seq<Landmarks>& landmarks, const FitImageOptions& options,
                                engine::Progress& progress);

// The same over plain lists.
std::vector<FaceFit> fit_pictures(const MorphableModel& model, const std::vector<const Image*>& pictures,
                                  const std::vector<const Landmarks*>& landmarks, const FitImageOptions& options);

}  // namespace face::model
