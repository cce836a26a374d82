// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/feature_map.h"
#include "nodes/types/image.h"

namespace face::flow {

enum class Channels { grey, colour };  // one channel "grey", or "red", "green", "blue"

struct ImageChannelsOptions {
  Channels channels = Channels::grey;
};

// An image as dense correspondence compares it, 0 to 255. mask: an image of the same size; pixels where its first
// channel is below 128 are not valid. Without one all are. Throws where sizes do not agree.
FeatureMap image_channels(const Image& image, const Image* mask, const ImageChannelsOptions& options = {});

// Luma (BT.601) of every pixel to `values`, height x width of them.
void write_grey(const Image& image, float* values);

}  // namespace face::flow
