// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/node_samples.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <stdexcept>

#include "engine/port.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"
#include "nodes/types/table.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"
#include "tests/support/samples.h"
#include "tests/support/toy_run.h"

namespace conformance {
namespace fs = std::filesystem;
namespace {

// A port's own sample, by "node.port".
using face::Matrix;
using Maker = std::function<AnyValue(engine::Plugins&, int variant)>;

template <class T>
AnyValue held(T value) {
  return std::make_shared<const T>(std::move(value));
}

// The first value of an output of another node, called with its own samples.
Maker made_by(const std::string& node, const std::string& output) {
  return [node, output](engine::Plugins& plugins, int variant) -> AnyValue {
    if (!plugins.find(node)) return nullptr;
    const engine::NodeDeclaration& declaration = plugins.load(node);
    PortValues inputs;
    for (std::size_t p = 0; p < declaration.info.inputs.size(); ++p) {
      const auto input = port_sample(plugins, declaration, p, variant);
      if (!input) return nullptr;
      inputs.push_back(*input);
    }
    const Outcome outcome = call_node(declaration, inputs, sample_params(declaration.info));
    if (outcome.threw) throw std::runtime_error("the sample that " + node + " makes: " + outcome.what);
    return outcome.values.at(static_cast<std::size_t>(declaration.info.find_output(output))).at(0);
  };
}

// The same, as a file on disk.
Maker file_by(const std::string& node) {
  return [node](engine::Plugins& plugins, int variant) -> AnyValue {
    const engine::NodeInfo* info = plugins.find(node);
    if (!info) return nullptr;
    const AnyValue value = made_by(node, info->outputs[0].name)(plugins, variant);
    const auto& file = *static_cast<const engine::File*>(value.get());
    if (!file.in_memory()) return value;
    return test::sample_file(node + std::to_string(variant) + file.suffix(), file.bytes());
  };
}

Maker text_file(const std::string& suffix, std::vector<std::string> texts) {
  return [suffix, texts](engine::Plugins&, int variant) {
    const auto at = static_cast<std::size_t>(variant) % texts.size();
    return test::sample_file("sample" + std::to_string(at) + suffix, texts[at]);
  };
}

// A file or folder of a Debian package.
Maker installed(const std::string& path) {
  return [path](engine::Plugins&, int) -> AnyValue {
    if (!fs::exists(path)) return nullptr;
    if (!fs::is_directory(path)) return held(engine::File::at(path));
    std::vector<engine::File::Entry> entries;
    for (const auto& entry : fs::directory_iterator(path))
      entries.push_back({entry.path().filename().string(), entry.path().string()});
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return held(engine::File::folder(path, entries));
  };
}

// One second of a tone as 16-bit WAV.
AnyValue wav(int variant) {
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
  return test::sample_file("tone" + std::to_string(variant) + ".wav", bytes);
}

Matrix matrix(std::size_t rows, std::size_t columns, int variant) {
  Matrix made{rows, columns, {}};
  for (std::size_t i = 0; i < rows * columns; ++i)
    made.values.push_back(1.5 + std::sin(1.7 * static_cast<double>(i) + 0.1 * variant));
  return made;
}
Maker matrices(std::size_t rows, std::size_t columns) {
  return [=](engine::Plugins&, int variant) { return held(matrix(rows, columns, variant)); };
}

// A tetrahedron's, of which the variants leave out another one.
AnyValue faces(engine::Plugins&, int variant) {
  const std::vector<double> all = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0, 0, 1, 3};
  const auto from = static_cast<std::ptrdiff_t>(variant == 0 ? 0 : 3);
  return held(Matrix{4, 3, {all.begin() + from, all.begin() + from + 12}});
}

// Weights of as many example meshes as a sequence of samples has.
AnyValue few_weights(engine::Plugins&, int variant) {
  const float more = 0.1f * static_cast<float>(variant);
  return held(face::Weights{{0.1f + more, 0.3f, 0.2f, 0.1f}});
}

// The 68 points by number, where a picture of 64 x 48 pixels would show them.
AnyValue face_points(engine::Plugins&, int variant) {
  face::Landmarks landmarks;
  for (int i = 0; i < 68; ++i) {
    const double angle = M_PI * std::min(i, 16) / 16;
    const bool jaw = i < 17;
    const double x = jaw ? -13 * std::cos(angle) : -9 + 18.0 * (i % 6) / 5;
    const double y = jaw ? 18 * std::sin(angle) - 4 : -12 + 26.0 * (i - 17) / 50;
    landmarks.points.push_back({std::to_string(i), 32 + x + 0.3 * variant, 24 + y, true});
  }
  return held(landmarks);
}

// The 18 points of a lip tracker; another variant has the mouth farther open and the head elsewhere.
AnyValue speaker_points(engine::Plugins&, int variant) {
  face::Landmarks landmarks{{{"eye_inner_r", 26, 14, true}, {"eye_inner_l", 38, 14, true}, {"nose_tip", 32, 22, true}}};
  for (int i = 0; i < 12; ++i)
    landmarks.points.push_back({"lip_" + std::to_string(i), 32 - 8 * std::cos(M_PI * i / 6),
                                32 - (3 + 0.4 * variant) * std::sin(M_PI * i / 6), true});
  for (face::Landmark& point : landmarks.points) point.y_px += 0.05 * variant * (point.x_px - 20);
  return held(landmarks);
}

// Four frames that are seconds apart: a face blinks now and then.
AnyValue slow_timeline(engine::Plugins&, int variant) {
  face::Timeline timeline;
  const double step = 1.7 + 0.3 * variant;
  for (int f = 0; f < 4; ++f) timeline.time_s.push_back(step * f);
  timeline.duration_s = 4 * step;
  return held(timeline);
}

// The shipped table; in its variants another first target.
AnyValue viseme_table(engine::Plugins&, int variant) {
  std::string text = test::read_file(FACEGRAPH_SOURCE_DIR "/graphs/speech/visemes.json");
  const std::size_t digit = text.find("0.", text.find("\"weights\"")) + 2;
  if (variant > 0) text[digit] = static_cast<char>('1' + variant);
  return test::sample_file("visemes" + std::to_string(variant) + ".json", text);
}

// A projector stands beside its camera.
AnyValue projector(engine::Plugins&, int variant) { return test::sample("camera", 12 + variant); }

// What a truth is: not what is judged.
Maker another(const std::string& type) {
  return [type](engine::Plugins&, int variant) { return test::sample(type, variant + 1); };
}
AnyValue other_face_points(engine::Plugins& plugins, int variant) { return face_points(plugins, variant + 2); }

// A row per frame of the timeline.
AnyValue curves(engine::Plugins&, int variant) {
  face::Table table{{"own_mm", "truth_mm"}, {}};
  for (int f = 0; f < 4; ++f) table.rows.push_back({std::to_string(f), {std::sin(f + variant), std::cos(f)}});
  return held(table);
}

// Four frames over all that is said.
AnyValue spread_timeline(engine::Plugins&, int variant) {
  face::Timeline timeline;
  const double step = 0.25 + 0.02 * variant;
  for (int f = 0; f < 4; ++f) timeline.time_s.push_back(step * f);
  timeline.duration_s = 4 * step;
  return held(timeline);
}

// One number per row; the variants take another list in turn.
Maker columns_of(std::vector<std::vector<double>> lists) {
  return [lists](engine::Plugins&, int variant) {
    const std::vector<double>& list = lists[static_cast<std::size_t>(variant) % lists.size()];
    return held(Matrix{list.size(), 1, list});
  };
}

// A mask: one channel of the sample picture.
AnyValue grey_picture(engine::Plugins&, int variant) {
  const AnyValue sample = test::sample("image", variant);
  const auto& picture = *static_cast<const face::Image*>(sample.get());
  face::Image grey{picture.width, picture.height, 1, {}};
  for (std::size_t i = 0; i < picture.pixels.size(); i += static_cast<std::size_t>(picture.channels))
    grey.pixels.push_back(picture.pixels[i]);
  return held(grey);
}

// The 68 points with the names of a track: two digits.
AnyValue two_digit_points(engine::Plugins& plugins, int variant) {
  face::Landmarks landmarks = *static_cast<const face::Landmarks*>(face_points(plugins, variant).get());
  for (face::Landmark& point : landmarks.points)
    if (point.name.size() == 1) point.name = "0" + point.name;
  return held(landmarks);
}

// A head that moved by some pixels.
AnyValue perspective(engine::Plugins&, int variant) {
  return held(Matrix{3, 3, {1, 0.01, 1.5 + variant, -0.01, 1, 2, 0, 1e-4, 1}});
}

const std::map<std::string, Maker>& makers() {
  const std::string pocketsphinx = "/usr/share/pocketsphinx/model/en-us/";
  static const std::map<std::string, Maker> all = {
      {"decode.audio.file", [](engine::Plugins&, int variant) { return wav(variant); }},
      {"decode.video.file", file_by("export.video")},
      {"decode.rig.file", file_by("export.gltf")},
      {"decode.npy.file", file_by("export.npy")},
      {"decode.landmarks.file",
       text_file(".json", {R"({"image_size": [64, 48], "points": {"a": [10, 12], "b": [20.5, 30]}})",
                           R"({"image_size": [80, 60], "points": {"a": [11, 12], "c": [20.5, 30]}})"})},
      {"decode.corrections.file", text_file(".json", {R"([{"frame": 4, "point": "a", "xy": [10, 12]}])",
                                                      R"([{"frame": 5, "point": "b", "xy": [10, 13]}])"})},
      {"decode.rig.names",
       text_file(".json", {R"({"jawOpen": "jawOpen"})", R"({"jawOpen": "jawLeft", "jawLeft": "jawOpen"})"})},
      {"speech.read_phones.file", file_by("export.phones_json")},
      {"speech.align.acoustic_model", installed(pocketsphinx + "en-us")},
      {"speech.align.dictionary", installed(pocketsphinx + "cmudict-en-us.dict")},
      {"speech.align.phone_model", installed(pocketsphinx + "en-us-phone.lm.bin")},
      {"speech.align.audio", made_by("speech.say", "audio")},
      {"trajectory.read_visemes.file", viseme_table},
      {"trajectory.add_idle.timeline", slow_timeline},
      {"trajectory.gaussian_path.variances", matrices(6, 4)},
      {"track.stabilise.landmarks", speaker_points},
      {"track.stabilise.rest", speaker_points},
      {"track.find_rest.landmarks", speaker_points},
      {"meshik.reconstruct.weights", few_weights},
      {"meshik.blend_linear.weights", few_weights},
      {"meshik.transfer_landmarks.weights", few_weights},
      {"meshik.solve.start", few_weights},
      {"mmm.scale_motion.reference", speaker_points},
      {"mmm.scale_motion.landmarks", speaker_points},
      {"mmm.head_mask.landmarks", two_digit_points},
      {"mmm.warp_perspective.perspective", perspective},
      {"mmm.build.exemplars", columns_of({{0, 2}, {1, 3}})},
      {"model.region_pca.weights", matrices(525, 1)},
      {"align.common_cover.covers", grey_picture},
      {"mask.reopen.interior", grey_picture},
      {"texture.reveal_background.mask", grey_picture},
      {"meshik.reconstruct_matrix.reference", matrices(4, 3)},
      {"meshik.reconstruct_matrix.examples", matrices(4, 12)},
      {"meshik.reconstruct_matrix.faces", faces},
      {"weights.nnls.targets", matrices(3, 6)},
      {"weights.nnls.neutral", matrices(1, 6)},
      {"weights.least_squares.targets", matrices(3, 6)},
      {"weights.least_squares.neutral", matrices(1, 6)},
      {"model.fit_landmarks.landmarks", face_points},
      {"model.fit_image.landmarks", face_points},
      {"model.fit_images.landmarks", face_points},
      {"evaluate.clustering.labels", columns_of({{0, 0, 0, 1, 1, 1}, {0, 1, 0, 1, 0, 1}})},
      {"evaluate.clustering.exemplars", columns_of({{1, 4}, {0, 3}})},
      {"evaluate.clustering.planted", columns_of({{0, 0, 0, 1, 1, 2}, {0, 1, 1, 1, 1, 1}})},
      {"evaluate.curve_plot.curves", curves},
      {"evaluate.curve_plot.more", curves},
      {"evaluate.landmarks.track", face_points},
      {"evaluate.landmarks.truth", other_face_points},
      {"evaluate.lip_gap.truth", another("weights")},
      {"evaluate.lip_gap.timeline", spread_timeline},
      {"evaluate.lip_vertex_error.truth", another("weights")},
      {"evaluate.mesh_error.truth", another("mesh_points")},
      {"evaluate.texture_consistency.frames", another("image")},
      {"phantom.scan_frame.projector", projector},
      {"phantom.lose_points.projector", projector},
      {"phantom.read_configurations.file",
       text_file(".json", {R"({"open": {"jawOpen": 0.5}})", R"({"open": {"jawOpen": 0.7}})"})},
  };
  return all;
}

// Types that only a node can make.
const std::map<std::string, Maker>& made_types() {
  static const std::map<std::string, Maker> all = {
      {"mesh_space", made_by("meshik.prepare", "space")},
      {"morphable_model", made_by("model.from_rig", "model")},
      {"shape_model", made_by("model.region_pca", "model")},
      {"mmm", made_by("mmm.build", "model")},
  };
  return all;
}

AnyValue one_sample(engine::Plugins& plugins, const std::string& node, const engine::InputInfo& port, int variant) {
  if (const auto own = makers().find(node + "." + port.name); own != makers().end())
    return own->second(plugins, variant);
  if (const auto made = made_types().find(port.type); made != made_types().end()) return made->second(plugins, variant);
  return test::sample(port.type, variant);
}

}  // namespace

const std::map<std::string, std::string>& shown_elsewhere() {
  static const std::string one_installed = "Debian has one of it; tests/nodes/speech names what it takes";
  static const std::string no_such_part =
      "the sample's head has no part of that name; the embedded head has, in tests/nodes/phantom";
  static const std::string nothing_lost = "no point is lost in four smooth pictures; tests/nodes/track loses some";
  static const std::string nothing_drawn =
      "nothing of the sample's head is drawn within its picture; tests/nodes/texture/texture_test.cpp draws one";
  static const std::string fit_undrawn =
      "nothing of the sample's head is drawn within its picture; tests/nodes/texture/draw_fit_test.cpp draws one";
  static const std::string same_uvs =
      "the samples of meshes share their uvs; tests/nodes/model/region_weights_test.cpp has others";
  static const std::string not_reached = "samples that lead there are still to be made (node_samples.cpp)";
  static const std::map<std::string, std::string> all = {
      {"texture.reanimate.albedo", nothing_drawn},
      {"texture.reanimate.background", nothing_drawn},
      {"texture.reanimate.fit", nothing_drawn},
      {"texture.reanimate.model", nothing_drawn},
      {"texture.reanimate.person", nothing_drawn},
      {"texture.reanimate.weights", nothing_drawn},
      {"texture.reanimate.moments", nothing_drawn},
      {"texture.reanimate.samples", nothing_drawn},
      {"texture.draw_fit.fit", fit_undrawn},
      {"texture.draw_fit.model", fit_undrawn},
      {"texture.draw_fit.opacity", fit_undrawn},
      {"model.region_weights.mesh", same_uvs},
      {"cluster.affinity_propagation.method", not_reached},
      {"cluster.key_shapes.frames", not_reached},
      {"cluster.key_shapes.labels", not_reached},
      {"evaluate.jitter.rig", not_reached},
      {"evaluate.mouth_time_offset.max_offset_ms", not_reached},
      {"evaluate.mouth_time_offset.rig", not_reached},
      {"evaluate.mouth_time_offset.timeline", not_reached},
      {"evaluate.sync.audio", not_reached},
      {"evaluate.sync.weights", not_reached},
      {"flow.dis.start", not_reached},
      {"flow.robust.remove_spikes", not_reached},
      {"flow.scan.radius_weight", not_reached},
      {"flow.start.target", not_reached},
      {"cluster.landmark_points.max_lost", "no sample has lost landmarks; tests/nodes/cluster/groups_test.cpp"},
      {"weights.fit_key_shapes.max_lost", "no sample has lost landmarks; tests/nodes/weights/fit_key_shapes_test.cpp"},
      {"meshik.blend_linear.weights", not_reached},
      {"mmm.analyse.restraint", not_reached},
      {"mmm.head_mask.frame", "only its size counts, and all samples have one size"},
      {"mmm.normalise.coarse_warps",
       "no sample moves as a plane; tests/nodes/mmm/normalise_test.cpp has one that does"},
      {"mmm.normalise.fine_warps", "no sample moves as a plane; tests/nodes/mmm/normalise_test.cpp has one that does"},
      {"mmm.normalise.levels", "no sample moves as a plane; tests/nodes/mmm/normalise_test.cpp has one that does"},
      {"mmm.normalise.outlier_px", "no sample moves as a plane; tests/nodes/mmm/normalise_test.cpp has one that does"},
      {"mmm.paste.feather_px", not_reached},
      {"mmm.paste.heads", not_reached},
      {"mmm.scale_motion.hold_head", not_reached},
      {"mmm.scale_motion.rig", not_reached},
      {"model.mouth_shapes.rig", not_reached},
      {"texture.reveal_background.fit", not_reached},
      {"mask.fill_holes.longest_px", not_reached},
      {"mask.fill_holes.largest_step_mm", not_reached},
      {"mask.fill_holes.vertical_too", not_reached},
      {"mask.remove_mouth.centre_x", not_reached},
      {"mask.remove_mouth.centre_y", not_reached},
      {"mask.remove_mouth.width", not_reached},
      {"mask.remove_mouth.height", not_reached},
      {"mask.remove_mouth.moved", not_reached},
      {"mask.remove_mouth.before", not_reached},
      {"model.fit_image.albedos", not_reached},
      {"model.fit_image.points", not_reached},
      {"model.fit_image.steps", not_reached},
      {"model.fit_image.image_weight", not_reached},
      {"model.fit_image.mouth_sigma_mm", not_reached},
      {"model.fit_image.max_image_rms", not_reached},
      {"model.fit_image.seed", not_reached},
      {"model.fit_image.picture", not_reached},
      {"model.fit_images.albedos", not_reached},
      {"model.fit_images.points", not_reached},
      {"model.fit_images.steps", not_reached},
      {"model.fit_images.image_weight", not_reached},
      {"model.fit_images.mouth_sigma_mm", not_reached},
      {"model.fit_images.max_image_rms", not_reached},
      {"model.fit_images.seed", not_reached},
      {"model.fit_images.pictures", not_reached},
      {"model.fit_landmarks.mouth_evidence", not_reached},
      {"model.fit_landmarks.iterations", not_reached},
      {"model.fit_landmarks.picture", not_reached},
      {"phantom.lose_points.seed", not_reached},
      {"phantom.lose_points.camera", not_reached},
      {"phantom.truth_flow.tolerance_mm", not_reached},
      {"phantom.truth_flow.target", not_reached},
      {"phantom.video_frame.samples", not_reached},
      {"phantom.video_frame.highlight", not_reached},
      {"phantom.video_frame.shadow", not_reached},
      {"phantom.video_frame.gamma", not_reached},
      {"phantom.video_frame.rig", not_reached},
      {"phantom.video_frame.weights", not_reached},
      {"phantom.video_frame.world_from_head", not_reached},
      {"phantom.video_frame.camera", not_reached},
      {"phantom.video_frame.lighting", not_reached},
      {"phantom.video_frame.dots", not_reached},
      {"texture.extract.picture", not_reached},
      {"texture.extract.fit", not_reached},
      {"texture.render_into.samples", not_reached},
      {"texture.render_into.model", not_reached},
      {"texture.render_into.person", not_reached},
      {"texture.render_into.albedo", not_reached},
      {"texture.render_into.fit", not_reached},
      {"texture.render_into.background", not_reached},
      {"texture.render_into.weights", not_reached},
      {"track.klt.outline", not_reached},
      {"track.klt.edge_reach_px", not_reached},
      {"track.report.landmarks", not_reached},
      {"track.report.state", not_reached},
      {"track.report.timeline", not_reached},
      {"trajectory.add_idle.blink", not_reached},
      {"trajectory.speak_gaussian.covariance", not_reached},
      {"align.choose_reference.openness", not_reached},
      {"align.link_markers.tolerance_px", not_reached},
      {"align.link_markers.reference", not_reached},
      {"align.orient.scale_mm", not_reached},
      {"align.track_markers.search_px", not_reached},
      {"align.track_markers.least_likeness", not_reached},
      {"speech.align.phone_model", one_installed},
      {"render.contact_sheet.pictures", not_reached},
      {"render.contact_sheet.columns", not_reached},
      {"meshik.reconstruct.weights", not_reached},
      {"speech.align.acoustic_model", one_installed},
      {"speech.align.dictionary", one_installed},
      {"phantom.laser_scan.bathing_cap", no_such_part},
      {"phantom.laser_scan.missing_hair", no_such_part},
      {"phantom.make_person.skin", no_such_part},
      {"phantom.make_person.beard", no_such_part},
      {"phantom.make_person.moles", no_such_part},
      {"phantom.make_person.painted", no_such_part},
      {"phantom.make_person.lipstick", no_such_part},
      {"phantom.make_person.marker_radius_mm", no_such_part},
      {"track.klt.max_return_error_px", nothing_lost},
      {"track.klt.max_offset_px", nothing_lost},
      {"track.klt.min_likeness", nothing_lost},
      {"track.klt.rigid", nothing_lost},
      {"track.klt.search_px", nothing_lost},
  };
  return all;
}

const std::map<std::string, std::string>& nodes_without_sample() {
  static const std::map<std::string, std::string> nodes = {
      {"toy.unsteady", "it is the bad example that `facegraph cache audit` finds in tests"},
      {"toy.slow_read", "it only waits while it reads, for tests of files that change"},
      {"toy.sleep", "it only waits"},
      {"cluster.k_means", "a sample that it takes is still to be made (node_samples.cpp)"},
      {"cluster.k_medoids", "a sample that it takes is still to be made (node_samples.cpp)"},
      {"cluster.key_shapes_direct", "a sample that it takes is still to be made (node_samples.cpp)"},
      {"cluster.merge", "a sample that it takes is still to be made (node_samples.cpp)"},
      {"decode.structured_light", "a sample that it takes is still to be made (node_samples.cpp)"},
      {"mask.review", "a sample that it takes is still to be made (node_samples.cpp)"},
      {"mask.smooth_depth", "a sample that it takes is still to be made (node_samples.cpp)"},
      {"texture.continue_background", "a sample that it takes is still to be made (node_samples.cpp)"},
      {"align.crop", "a sample that it takes is still to be made (node_samples.cpp)"},
      {"cluster.key_shape_sheet", "a sample that it takes is still to be made (node_samples.cpp)"},
      {"meshik.sculpt_keys", "a sample that it takes is still to be made (node_samples.cpp)"},
      {"meshik.transfer_landmarks", "its landmarks have a tracker's names; tests/nodes/meshik gives it some"},
      {"mmm.check_labels", "its phones end with the video; no sample's do"},
      {"mmm.synthesise", "its parameters are twice as many as the model's pictures; tests/nodes/mmm/model_test.cpp"},
      {"model.rebuild_shape", "its coefficients are no more than the model's; tests/nodes/model/region_pca_test.cpp"},
      {"decode.identity_modes", "it reads an ICT-FaceKit folder; tests/nodes/decode reads the real one"},
  };
  return nodes;
}

Params sample_params(const engine::NodeInfo& info) {
  static const std::map<std::string, engine::ParamValue> given = {
      {"toy.blob.size_mb", 0.001},
      {"toy.cheap_blob.size_mb", 0.001},
      {"toy.blob_size.seconds", 0.0},
      {"toy.fail.when", std::string("nothing of the kind")},
      {"toy.contains.part", std::string("Bob")},
      {"toy.count_up.count", std::int64_t{5}},
      {"render.contact_sheet.pictures", std::int64_t{2}},
      {"render.contact_sheet.columns", std::int64_t{2}},
      {"phantom.video_frame.width_px", std::int64_t{64}},
      {"phantom.video_frame.height_px", std::int64_t{48}},
  };
  Params params = defaults_of(info);
  for (std::size_t i = 0; i < params.size(); ++i)
    if (const auto own = given.find(info.name + "." + info.params[i].name); own != given.end()) params[i] = own->second;
  return params;
}

std::vector<engine::ParamValue> further_values(const std::string& node, const std::string& param) {
  static const std::map<std::string, std::vector<engine::ParamValue>> values = {
      {"toy.fail.when", {std::string("Bob")}},
      {"speech.say.voice", {std::string("kal")}},
  };
  const auto at = values.find(node + "." + param);
  return at == values.end() ? std::vector<engine::ParamValue>() : at->second;
}

std::optional<PortValue> port_sample(engine::Plugins& plugins, const engine::NodeDeclaration& node, std::size_t port,
                                     int variant) {
  const engine::InputInfo& info = node.info.inputs[port];
  PortValue sample;
  if (info.depth > 1) return std::nullopt;
  if (info.depth == 0 && !info.window) {
    sample.value = one_sample(plugins, node.info.name, info, variant);
    if (!sample.value) return std::nullopt;
    return sample;
  }
  constexpr int elements = 4;
  for (int e = 0; e < elements; ++e) {
    sample.elements.push_back(one_sample(plugins, node.info.name, info, variant + e));
    if (!sample.elements.back()) return std::nullopt;
  }
  if (info.window) {
    const std::size_t most = static_cast<std::size_t>(info.before + info.after + 1);
    while (sample.elements.size() > most) sample.elements.pop_back();
  }
  return sample;
}

}  // namespace conformance
