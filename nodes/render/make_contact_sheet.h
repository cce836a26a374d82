// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "nodes/types/image.h"

namespace face::render {

struct Caption {
  std::string large;  // in the middle under the picture
  std::string small;  // below it
};

// Pictures in rows from the top left, each with its caption under it. All pictures have one size; fewer captions than
// pictures leave the rest without. Only ASCII is drawn; anything else becomes '?'.
Image make_contact_sheet(const std::vector<Image>& images, const std::vector<Caption>& captions, int columns);

}  // namespace face::render
