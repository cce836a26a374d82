// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/make_contact_sheet.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "nodes/base/check.h"
#include "nodes/render/rgb_image.h"

namespace face::render {
namespace {

constexpr int gap_px = 4;
const cv::Scalar paper(24, 26, 30), ink(240, 238, 232), pale_ink(150, 158, 168);

// One '?' per character that the font lacks, not per byte of UTF-8.
std::string ascii(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 32 && byte < 127)
      out += c;
    else if (byte < 0x80 || byte >= 0xC0)
      out += '?';
  }
  return out;
}

// Centred on x, with its base line on y; made smaller where it is wider than the room.
void write_text(cv::Mat& sheet, const std::string& text, int x, int y, int room_px, double height_px,
                const cv::Scalar& colour) {
  if (text.empty()) return;
  constexpr double font_height_px = 22;  // of a capital at scale 1
  double scale = height_px / font_height_px;
  const int thickness = height_px > 14 ? 2 : 1;
  int base_line = 0;
  cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, scale, thickness, &base_line);
  if (size.width > room_px) {
    scale *= static_cast<double>(room_px) / size.width;
    size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, scale, thickness, &base_line);
  }
  cv::putText(sheet, text, {x - size.width / 2, y}, cv::FONT_HERSHEY_SIMPLEX, scale, colour, thickness, cv::LINE_AA);
}

}  // namespace

Image make_contact_sheet(const std::vector<Image>& images, const std::vector<Caption>& captions, int columns) {
  check(!images.empty(), "there are no pictures for the sheet");
  check(columns > 0, "columns is ", columns, ", expected at least 1");
  check(captions.size() <= images.size(), "there are ", captions.size(), " captions for ", images.size(), " pictures");
  const int count = static_cast<int>(images.size());
  const int used_columns = std::min(columns, count), rows = (count + columns - 1) / columns;
  const int width = images[0].width, height = images[0].height;
  const int large_px = std::clamp(height / 14, 8, 40), small_px = std::clamp(height / 20, 7, 28);
  const int caption_px = captions.empty() ? 0 : large_px + small_px + large_px;
  cv::Mat sheet(rows * (height + caption_px + gap_px) + gap_px, used_columns * (width + gap_px) + gap_px, CV_8UC3,
                paper);
  for (int i = 0; i < count; ++i) {
    Image tile = rgb_image(images[static_cast<std::size_t>(i)]);
    check(tile.width == width && tile.height == height, "picture ", i, " is ", tile.width, " x ", tile.height,
          ", but picture 0 is ", width, " x ", height);
    const int x = gap_px + i % columns * (width + gap_px), y = gap_px + i / columns * (height + caption_px + gap_px);
    cv::Mat(height, width, CV_8UC3, tile.pixels.data()).copyTo(sheet(cv::Rect(x, y, width, height)));
    if (static_cast<std::size_t>(i) >= captions.size()) continue;
    const Caption& caption = captions[static_cast<std::size_t>(i)];
    const int middle = x + width / 2, base = y + height + large_px / 3 + large_px;
    write_text(sheet, ascii(caption.large), middle, base, width - 4, large_px, ink);
    write_text(sheet, ascii(caption.small), middle, base + large_px / 3 + small_px, width - 4, small_px, pale_ink);
  }
  Image result{sheet.cols, sheet.rows, 3, {}};
  result.pixels.assign(sheet.data, sheet.data + sheet.total() * 3);
  return result;
}

}  // namespace face::render
