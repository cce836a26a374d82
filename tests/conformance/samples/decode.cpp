// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <sstream>

#include "nodes/types/key_shapes.h"
#include "nodes/types/timeline.h"
#include "tests/conformance/samples/shared.h"
#include "tests/support/depth_pictures.h"
#include "tests/support/model_files.h"
#include "tests/support/samples.h"

namespace conformance {
namespace {

// One second of a tone as 16-bit WAV.
std::string tone_bytes(int variant) {
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
  return bytes;
}

Sample tone(engine::Plugins&, int variant) {
  return {test::sample_file("tone" + std::to_string(variant) + ".wav", tone_bytes(variant)), "file"};
}

// Recorded takes a to d, each of another grey; in each a frame is nearer and one is cut in half.
Sample takes(engine::Plugins&, int variant) {
  std::map<std::string, std::string> files = {{"camera.json", test::depth_camera_json}};
  for (int take = 0; take < 4; ++take)
    for (const int frame : {1, 2, 3, 4, 6}) {
      const std::string name = std::string(1, static_cast<char>('a' + take)) + "/" + std::to_string(frame) + ".pgm";
      const std::vector<int> depth = frame == 3   ? test::ball(860)
                                     : frame == 4 ? test::ball(900, 32)
                                                  : test::ball(900 - 2 * frame - variant);
      files["depth/" + name] = test::pgm(depth, 65535);
      files["picture/" + name] =
          test::pgm(std::vector<int>(test::depth_width * test::depth_height, 60 + 20 * take + frame), 255);
    }
  if (variant > 0) files["cloud/e" + std::to_string(variant) + "/1.xyz"] = "0 0 800\n";
  return {test::sample_folder("takes" + std::to_string(variant), files), "file"};
}

// What lies beside them: of all four, then of three.
enum class Kind { sound, text };

template <Kind kind>
Sample files_of_takes(engine::Plugins&, int variant) {
  const std::string suffix = kind == Kind::sound ? ".wav" : ".txt";
  std::map<std::string, std::string> files;
  for (int take = 0; take < 4 - variant; ++take) {
    const std::string name = std::string(1, static_cast<char>('a' + take)) + suffix;
    files[name] = kind == Kind::sound ? tone_bytes(take) : "of " + name;
  }
  return {test::sample_folder("files" + suffix.substr(1) + std::to_string(variant), files), "file"};
}

// Modes of a square of the size of a head in cm.
Sample modes(engine::Plugins&, int variant) {
  const auto square = [](double x, double z) {
    std::ostringstream text;
    text << "v 0 0 0\nv " << 16 + x << " 0 0\nv 16 24 " << z << "\nv 0 24 0\nf 1 2 3 4\n";
    return text.str();
  };
  return {test::sample_folder("modes" + std::to_string(variant), {{"generic_neutral_mesh.obj", square(0, 0)},
                                                                  {"identity000.obj", square(1 + variant, 0)},
                                                                  {"identity001.obj", square(0, 0.5)}}),
          "file"};
}

// A triangle of the size of a head that eos saved, without expressions.
Sample eos_model(engine::Plugins&, int variant) {
  const float top = 200.0f + static_cast<float>(variant);
  return {test::sample_file(
              "model" + std::to_string(variant) + ".bin",
              test::raw(std::uint32_t{1}) +
                  test::eos_pca({-80, 0, 0, 80, 0, 0, 0, top, 10}, {1, 0, 0, 0, 0, 0, 0, 0, 0}, {4}, {0, 1, 2}) +
                  test::eos_pca({}, {}, {}, {}) + test::raw(std::uint64_t{0})),
          "file"};
}

Sample eos_expressions(engine::Plugins&, int variant) {
  return {test::sample_file(
              "expressions" + std::to_string(variant) + ".bin",
              test::eos_blend_shapes({{"open", {0, 0, 0, 0, 0, 0, 0, 1.0f + static_cast<float>(variant), 0}}})),
          "file"};
}

// Of a film of four frames.
const Maker second_or_third_frame = made([](int variant) {
  return face::KeyShapes{{{std::to_string(1 + variant % 2), 1, {}}}};
});

const Maker timeline_or_its_first_frame =
    changed<face::Timeline>(made_by("decode.video", "timeline"), [](face::Timeline& timeline, int variant) {
      if (variant > 0) timeline.time_s.resize(1);
    });

std::string sixty_eight(int first) {
  std::string list = "[" + std::to_string(first);
  for (int i = 1; i < 68; ++i) list += ", " + std::to_string(i % 3);
  return list + "]";
}

const Registered decode({
    .inputs =
        {
            {"decode.audio.file", tone},
            {"decode.video.file", file_by("export.video")},
            {"decode.key_frames.file", file_by("export.video")},
            {"decode.key_frames.timeline", timeline_or_its_first_frame},
            {"decode.key_frames.key_shapes", second_or_third_frame},
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
            {"decode.identity_modes.folder", modes},
            {"decode.model.file", eos_model},
            {"decode.model.expressions", eos_expressions},
            {"decode.model.landmarks", text_file(".json", {sixty_eight(0), sixty_eight(1)})},
            {"decode.list_takes.folder", takes},
            {"decode.list_takes.sound", files_of_takes<Kind::sound>},
            {"decode.list_takes.texts", files_of_takes<Kind::text>},
            {"decode.depth_take.folder", takes},
            {"decode.depth_take.take",
             made([](int variant) { return std::string(1, static_cast<char>('a' + variant)); })},
            {"decode.structured_light.projector", another("camera", 12)},
        },
    .sequences = {{"decode.structured_light.images", sequence_by("phantom.pattern_images", "images")}},
    .params = {{"decode.structured_light.near_mm", 400.0},
               {"decode.structured_light.far_mm", 900.0},
               {"decode.structured_light.projector_width_px", whole(64)},
               {"decode.structured_light.fine_periods", whole(8)},
               {"decode.structured_light.coarse_periods", whole(1)}},
    // Between what the frames are.
    .values = {{"decode.depth_take.near_mm", {830.0}},
               {"decode.depth_take.far_mm", {830.0}},
               {"decode.depth_take.least_width_mm", {100.0}},
               {"decode.depth_take.most_width_mm", {100.0}},
               {"decode.depth_take.face_change_mm", {10.0}},
               {"decode.depth_take.least_face", {0.9}}},
    .shown_elsewhere = {{"decode.model.identities", "counts for an .npz, the sample is a .bin (ReadModel tests)"}},
    .only_refuses = {{"decode.key_frames.timeline",
                      "says where a frame is looked for; frames that it lacks are refused"}},
});

}  // namespace
}  // namespace conformance
