// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>

#include "nodes/types/image.h"

struct AVFrame;
struct SwsContext;

namespace face::decode {

// Converts decoded frames of one size and pixel format to 8-bit sRGB. Unmarked video is BT.709 from 720 lines on,
// BT.601 below, as every player assumes.
class RgbConverter {
 public:
  // For frames like this one. with_alpha: RGBA where the format has transparency, which is left out otherwise. Throws,
  // beginning with the title, where the pixel format cannot be converted.
  RgbConverter(const AVFrame& frame, const std::string& title, bool with_alpha = false);
  bool fits(const AVFrame& frame) const;
  Image convert(const AVFrame& frame) const;

 private:
  int width_, height_, format_, channels_;
  std::unique_ptr<SwsContext, void (*)(SwsContext*)> context_;
};

}  // namespace face::decode
