// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_png.h"

#include "engine/node.h"
#include "nodes/types/image.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.png", &export_png, version{1}, doc{"Writes an image as PNG."}, input{"image", "Image to write"},
     output("file", "The .png file"));
