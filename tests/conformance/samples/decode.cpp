// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>

#include "tests/conformance/samples/shared.h"
#include "tests/support/samples.h"

namespace conformance {
namespace {

// One second of a tone as 16-bit WAV.
Sample tone(engine::Plugins&, int variant) {
  const std::uint32_t rate = 16000, count = 16000;
  std::string bytes;
  const auto put = [&](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  bytes += "RIFF";
  put(std::uint32_t{36 + 2 * count});
  bytes += "WAVEfmt ";
  put(std::uint32_t{16}), put(std::uint16_t{1}), put(std::uint16_t{1}), put(rate), put(2 * rate), put(std::uint16_t{2});
  put(std::uint16_t{16});
  bytes += "data";
  put(2 * count);
  for (std::uint32_t i = 0; i < count; ++i)
    put(static_cast<std::int16_t>((static_cast<int>(i) * (37 + variant)) % 8000 - 4000));
  return {test::sample_file("tone" + std::to_string(variant) + ".wav", bytes), "file"};
}

const Registered decode({
    .inputs =
        {
            {"decode.audio.file", tone},
            {"decode.video.file", file_by("export.video")},
            {"decode.rig.file", file_by("export.gltf")},
            {"decode.npy.file", file_by("export.npy")},
            // Shares of the picture, whose size it takes from there.
            {"decode.landmarks.file", text_file(".json", {R"([{"x": 0.5, "y": 0.25}, {"x": 0.25, "y": 0.5}])",
                                                          R"([{"x": 0.6, "y": 0.25}, {"x": 0.25, "y": 0.5}])"})},
            {"decode.landmarks.image", sized_picture},
            {"decode.corrections.file", text_file(".json", {R"([{"frame": 4, "point": "a", "xy": [10, 12]}])",
                                                            R"([{"frame": 5, "point": "b", "xy": [10, 13]}])"})},
            {"decode.rig.names",
             text_file(".json", {R"({"jawOpen": "jawOpen"})", R"({"jawOpen": "jawLeft", "jawLeft": "jawOpen"})"})},
            {"decode.structured_light.projector", another("camera", 12)},
        },
    .sequences = {{"decode.structured_light.images", sequence_by("phantom.pattern_images", "images")}},
    .params = {{"decode.structured_light.near_mm", 400.0},
               {"decode.structured_light.far_mm", 900.0},
               {"decode.structured_light.projector_width_px", whole(64)},
               {"decode.structured_light.fine_periods", whole(8)},
               {"decode.structured_light.coarse_periods", whole(1)}},
    .without_sample =
        {
            {"decode.identity_modes", "it reads an ICT-FaceKit folder; tests/nodes/decode reads the real one"},
        },
});

}  // namespace
}  // namespace conformance
