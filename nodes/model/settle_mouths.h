// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <vector>

#include "nodes/model/fit_joint.h"

namespace face::model {

// Decides whether mouths are shut or open where steps alone cannot: both lie in valleys of their own. A slightly open
// mouth may be a closed one with lips of another colour: where closing it costs next to nothing, it is closed. A closed
// one may be open, with teeth taken for lips: where what is between the lips of one that was opened does not look like
// lips, and picture and points like the open one better, it is opened. run_steps: some steps of the last size.
void settle_mouths(const std::vector<PictureLevel>& levels, const std::function<void(Joint&)>& run_steps, Joint& joint);

}  // namespace face::model
