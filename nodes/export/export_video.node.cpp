// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_video.h"

#include "engine/node.h"
#include "nodes/types/audio.h"
#include "nodes/types/image.h"
#include "nodes/types/timeline.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.video", &export_video, version{2}, doc{"Writes pictures and their sound as MP4 (H.264 and AAC)."},
     input{"frames", "Pictures, all of one size"}, input{"timeline", "When every picture is shown"},
     input{"audio", "Sound from the timeline's beginning; without samples the video has none"},
     param("quality", &ExportVideoOptions::quality, range{0, 51}, unit{"1"},
           "Constant rate factor of the encoder: 0 is lossless, 18 looks so, 51 is worst"),
     param("audio_kbit_per_s", &ExportVideoOptions::audio_kbit_per_s, range{16, 320}, unit{"kbit/s"},
           "Bit rate of the sound", inert{"without sound there is nothing to encode"}),
     output("file", "The .mp4 file"));
