// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/render_sheet.h"

#include <cmath>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/render/make_contact_sheet.h"
#include "nodes/render/pick_key_frames.h"
#include "nodes/render/render_head.h"

namespace face::render {
namespace {

// "1.23 s", whatever the locale.
std::string seconds_text(double time_s) {
  const long long hundredths = std::llround(time_s * 100);
  const std::string fraction = std::to_string(hundredths % 100);
  return std::to_string(hundredths / 100) + (fraction.size() < 2 ? ".0" : ".") + fraction + " s";
}

}  // namespace

Image render_sheet(const Rig& rig, const engine::Seq<Weights>& weights, const Timeline& timeline, const Phones& phones,
                   const RenderSheetOptions& options) {
  check(weights.size() > 0, "there are no frames for the sheet");
  check(timeline.time_s.size() == weights.size(), "there are ", weights.size(), " frames, but the timeline has ",
        timeline.time_s.size(), " times");
  check(options.pictures > 0, "pictures is ", options.pictures, ", expected at least 1");
  RenderHeadOptions view;
  view.width_px = view.height_px = options.picture_px;
  view.yaw_deg = options.yaw_deg;
  view.framing = Framing::face;
  std::vector<Image> pictures;
  std::vector<Caption> captions;
  for (const KeyFrame& key : pick_key_frames(phones, timeline, static_cast<std::size_t>(options.pictures))) {
    const Phone& phone = phones.phones[key.phone];
    pictures.push_back(render_head(rig, *weights.at(key.frame), view));
    captions.push_back(
        {phone.label, (phone.word.empty() ? "" : phone.word + "  ") + seconds_text(timeline.time_s[key.frame])});
  }
  if (pictures.empty()) {  // no phones: the first frame stands for all
    pictures.push_back(render_head(rig, *weights.at(0), view));
    captions.push_back({"", seconds_text(timeline.time_s[0])});
  }
  return make_contact_sheet(pictures, captions, options.columns);
}

}  // namespace face::render
