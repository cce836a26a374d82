// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/picture_sheet.h"

#include <vector>

#include "nodes/render/make_contact_sheet.h"

namespace face::render {

Image picture_sheet(const engine::Seq<Image>& images, const PictureSheetOptions& options) {
  std::vector<Image> pictures;
  std::vector<Caption> captions;
  for (std::size_t k = 0; k < images.size(); ++k) {
    pictures.push_back(*images.at(k));
    if (options.captions) captions.push_back({images.id(k), ""});
  }
  return make_contact_sheet(pictures, captions, options.columns);
}

}  // namespace face::render
