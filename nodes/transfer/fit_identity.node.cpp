// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/fit_identity.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.fit_identity", &fit_identity, version{1},
     doc{"Fits a model of identities to a neutral face that is given around an axis: rigid motion and coefficients."},
     input{"model", "From model.from_rig, or another"}, input{"scan", "The neutral face"},
     input{"marks", "Points of its picture by name, from transfer.project_cylinder or by hand"},
     param("components", &FitIdentityOptions::components, range{0, 10000}, unit{"1"}, "Identity components used"),
     param("stiffness_mm2", &FitIdentityOptions::stiffness_mm2, range{0.0, 1000.0}, unit{"mm^2"},
           "What a coefficient of one standard deviation costs"),
     param("scale_mm", &FitIdentityOptions::scale_mm, range{0.01, 100.0}, unit{"mm"},
           "Distance at which a vertex counts a quarter, in the end"),
     param("steps", &FitIdentityOptions::steps, range{1, 1000}, unit{"1"}, "Steps of each of five stages"),
     output("points", &FitIdentityResult::points, "The fitted head, in the scan's world"),
     output("coefficients", &FitIdentityResult::coefficients, "In standard deviations"),
     output("scan_from_model", &FitIdentityResult::scan_from_model, "Motion of the whole head"),
     output("rms_mm", &FitIdentityResult::rms_mm, "Distance of the surfaces"),
     output("used", &FitIdentityResult::used, "Share of the skin in sight that lies on the scan"),
     output("solved", &FitIdentityResult::solved, "False where nothing could be fitted"));
