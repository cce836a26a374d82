// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/animate_original.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "nodes/decode/glb.h"
#include "nodes/decode/read_rig.h"
#include "nodes/export/export_gltf.h"
#include "tests/nodes/decode/temporary.h"
#include "tests/nodes/export/test_head.h"
#include "tests/support/expect_throw_text.h"

namespace face::exports {
namespace {

using nlohmann::json;

std::uint32_t uint_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}
json document_of(const std::string& glb) { return json::parse(glb.substr(20, uint_at(glb, 12))); }
std::string binary_of(const std::string& glb) { return glb.substr(20 + uint_at(glb, 12) + 8); }

Timeline two_times() { return {{0, 0.5}, 1}; }

engine::Seq<Weights> two_frames() {
  Weights open;
  open.values.assign(arkit_count, 0.0f);
  open.values[arkit_index("jawOpen")] = 0.75f;
  open.values[arkit_index("mouthClose")] = 0.25f;
  return engine::Seq<Weights>({Weights{}, open});
}

// Somebody's own head: of another exporter, with textures and bones that this program does not know.
engine::File own_head(const std::function<void(json&)>& change = {}) {
  const std::string made = export_gltf(test::square_rig(), engine::Seq<Weights>({Weights{}}), {{0}, 1}).bytes();
  json document = document_of(made);
  document["textures"] = {{{"source", 0}}};
  document["images"] = {{{"uri", "data:image/png;base64,iVBORw0KGgo="}}};
  document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  document["nodes"].push_back({{"name", "hat"}, {"extras", {{"worn", true}}}});
  document["extensionsUsed"] = {"VRM"};
  document["extensions"] = {{"VRM", {{"title", "somebody"}}}};
  json& extras = document["meshes"][0]["extras"];
  extras.erase("facegraph");
  for (json& name : extras["targetNames"]) name = "Head." + name.get<std::string>();
  extras["targetNames"][arkit_index("mouthClose")] = "lips_shut";
  document["animations"][0]["channels"].push_back({{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}});
  document["animations"][0]["name"] = "idle";
  if (change) change(document);
  return engine::File::from_bytes(decode::glb_bytes(document, binary_of(made)), ".glb");
}

engine::File lips_shut_is_mouth_close() { return engine::File::from_bytes(R"({"lips_shut": "mouthClose"})", ".json"); }

TEST(AnimateOriginal, KeepsEverythingAndAddsTheAnimation) {
  const engine::File head = own_head(), names = lips_shut_is_mouth_close();
  const Rig rig = decode::read_rig(head, &names);
  const std::string out = export_gltf(rig, two_frames(), two_times(), &head, &names).bytes();
  json now = document_of(out), before = document_of(head.bytes());

  const json animation = now["animations"][0];
  ASSERT_EQ(animation["channels"].size(), 1u);
  EXPECT_EQ(animation["channels"][0]["target"], (json{{"node", 0}, {"path", "weights"}}));
  const json accessor = now["accessors"][animation["samplers"][0]["output"].get<std::size_t>()];
  ASSERT_EQ(accessor["count"], 2 * arkit_count);
  const json view = now["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  std::vector<float> values(2 * arkit_count);
  std::memcpy(values.data(), binary_of(out).data() + view["byteOffset"].get<std::size_t>(), values.size() * 4);
  for (std::size_t i = 0; i < arkit_count; ++i) EXPECT_EQ(values[i], 0) << i;
  EXPECT_EQ(values[arkit_count + arkit_index("jawOpen")], 0.75f);
  EXPECT_EQ(values[arkit_count + arkit_index("mouthClose")], 0.25f);  // by the file of names

  // The same weights are moved by nothing else, and all the rest is as it was.
  ASSERT_EQ(now["animations"].size(), 2u);
  EXPECT_EQ(now["animations"][1]["name"], "idle");
  ASSERT_EQ(now["animations"][1]["channels"].size(), 1u);
  EXPECT_EQ(now["animations"][1]["channels"][0]["target"]["path"], "translation");
  for (const char* list : {"accessors", "bufferViews"})
    for (std::size_t i = 0; i < before[list].size(); ++i) EXPECT_EQ(now[list][i], before[list][i]);
  for (json* document : {&now, &before})
    for (const char* changed : {"animations", "accessors", "bufferViews", "buffers"}) document->erase(changed);
  EXPECT_EQ(now, before);
  const std::string binary = binary_of(head.bytes());
  EXPECT_EQ(binary_of(out).substr(0, binary.size()), binary);
}

TEST(AnimateOriginal, ReplacesItsOwnAnimationOfBefore) {
  const engine::File head = own_head([](json& document) { document["animations"][0]["channels"].erase(1); });
  const engine::File names = lips_shut_is_mouth_close();
  const Rig rig = decode::read_rig(head, &names);
  const auto again = [&](const engine::File& file) {
    return export_gltf(rig, two_frames(), two_times(), &file, &names);
  };
  const engine::File once = again(head), twice = again(once);
  EXPECT_EQ(document_of(twice.bytes())["animations"].size(), 1u);
  EXPECT_EQ(twice.bytes(), once.bytes());  // nothing of the animation before is left in it
}

TEST(AnimateOriginal, MovesEveryMeshWithTargetsByItsOwnNames) {
  const engine::File head = own_head([](json& document) {
    json teeth = document["meshes"][0];
    teeth["extras"]["targetNames"] = {"jaw_open"};
    for (json& primitive : teeth["primitives"]) primitive["targets"] = {primitive["targets"][arkit_index("jawOpen")]};
    teeth["weights"] = {0.0};
    document["meshes"].push_back(teeth);
    document["nodes"][1]["mesh"] = 1;
    document["scenes"][0]["nodes"] = {0, 1};
  });
  const engine::File names = lips_shut_is_mouth_close();
  const Rig rig = decode::read_rig(head, &names);
  const json now = document_of(export_gltf(rig, two_frames(), two_times(), &head, &names).bytes());
  const json& animation = now["animations"][0];
  ASSERT_EQ(animation["channels"].size(), 2u);
  EXPECT_EQ(animation["channels"][1]["target"]["node"], 1);
  EXPECT_EQ(now["accessors"][animation["samplers"][1]["output"].get<std::size_t>()]["count"], 2);
}

// The same head as programs hand it out in a folder: JSON, its buffer and its picture each in a file.
TEST(AnimateOriginal, TakesInTheFilesOfAFolder) {
  const engine::File head = own_head([](json& document) { document["images"] = {{{"uri", "skin%20tone.jpg"}}}; });
  const test::Temporary folder;
  json document = document_of(head.bytes());
  document["buffers"][0]["uri"] = "scene.bin";
  const auto write = [&](const std::string& name, const std::string& content) {
    return engine::File::Entry{name, folder.write(name, content)};
  };
  const engine::File given =
      engine::File::folder("head", {write("scene.bin", binary_of(head.bytes())), write("scene.gltf", document.dump()),
                                    write("skin tone.jpg", "a picture")});
  const engine::File names = lips_shut_is_mouth_close();
  const Rig rig = decode::read_rig(head, &names);
  const std::string out = export_gltf(rig, two_frames(), two_times(), &given, &names).bytes();
  const json now = document_of(out);
  ASSERT_EQ(now["buffers"].size(), 1u);
  EXPECT_FALSE(now["buffers"][0].contains("uri"));
  const json& image = now["images"][0];
  EXPECT_EQ(image["mimeType"], "image/jpeg");
  EXPECT_FALSE(image.contains("uri"));
  const json& view = now["bufferViews"][image["bufferView"].get<std::size_t>()];
  EXPECT_EQ(binary_of(out).substr(view["byteOffset"].get<std::size_t>(), view["byteLength"].get<std::size_t>()),
            "a picture");
  const Rig back = decode::read_rig(engine::File::from_bytes(out, ".glb"), &names);
  EXPECT_EQ(back.neutral.points_mm, rig.neutral.points_mm);
  EXPECT_EQ(back.shapes[arkit_index("jawOpen")].offsets_mm, rig.shapes[arkit_index("jawOpen")].offsets_mm);
}

TEST(AnimateOriginal, TakesInBuffersThatTheTextHolds) {
  const engine::File head = own_head([](json& document) {
    document["buffers"].push_back({{"byteLength", 4}, {"uri", "data:application/octet-stream;base64,AQIDBA=="}});
    document["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 4}});
  });
  const engine::File names = lips_shut_is_mouth_close();
  const std::size_t views = document_of(head.bytes())["bufferViews"].size();
  const std::string out = export_gltf(decode::read_rig(head, &names), two_frames(), two_times(), &head, &names).bytes();
  const json now = document_of(out);
  ASSERT_EQ(now["buffers"].size(), 1u);
  const json view = now["bufferViews"][views - 1];
  EXPECT_EQ(view["buffer"], 0);
  EXPECT_EQ(binary_of(out).substr(view["byteOffset"].get<std::size_t>(), 4), "\1\2\3\4");
}

// Our own file after another program had it: the notes' numbers are no longer the vertices', their places are.
Rig numbered_anew(const Rig& rig, const std::function<void(json&)>& change) {
  const std::string made = export_gltf(rig, engine::Seq<Weights>({Weights{}}), {{0}, 1}).bytes();
  json document = document_of(made);
  json& notes = document["meshes"][0]["extras"]["facegraph"];
  notes["inner_lips"] = {{0, 0}};
  notes["lower_lip"] = {900, 5};
  notes["upper_teeth"] = {1};
  change(notes);
  return decode::read_rig(engine::File::from_bytes(decode::glb_bytes(document, binary_of(made)), ".glb"), nullptr);
}

TEST(ReadRig, FindsMarksAgainByTheirPlacesWhereVerticesWereNumberedAnew) {
  Rig rig = test::square_rig();
  rig.neutral.points_mm[4] = rig.neutral.points_mm[1];  // lips that meet at rest
  const Rig back = numbered_anew(rig, [](json&) {});
  ASSERT_EQ(back.inner_lips.size(), 1u);
  EXPECT_EQ(back.inner_lips[0].upper, 4u);
  EXPECT_EQ(back.inner_lips[0].lower, 1u);
  EXPECT_EQ(back.lower_lip, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(back.upper_teeth, std::vector<std::uint32_t>{3});
}

TEST(ReadRig, DropsMarksThatAreNoMore) {
  const Rig back = numbered_anew(test::square_rig(), [](json& notes) {
    for (json& x : notes["places"]["upper_teeth"]) x = x.get<int>() + 500;  // 5 mm off, each way
    notes["places"]["lower_lip"].erase(0);
  });
  EXPECT_TRUE(back.upper_teeth.empty());
  EXPECT_NE(back.lower_lip, (std::vector<std::uint32_t>{900, 5}));
}

TEST(AnimateOriginal, LeavesToTheRigWhatIsNoGltf) {
  const Rig rig = test::square_rig();
  const auto animated = [&](const engine::File& file) {
    return animate_original(file, {}, rig, two_frames(), two_times());
  };
  EXPECT_FALSE(animated(engine::File::from_bytes("{\"asset\": {}}", ".gltf")));
  EXPECT_FALSE(animated(engine::File::folder("head", {})));
  EXPECT_FALSE(animated(own_head([](json& document) {
    for (json& primitive : document["meshes"][0]["primitives"]) primitive.erase("targets");
  })));
  EXPECT_FALSE(animated(engine::File::from_bytes("glTF", ".glb")));
}

TEST(AnimateOriginal, NamesAFileThatIsDamaged) {
  const std::string whole = own_head().bytes();
  const Rig rig = test::square_rig();
  const auto animated = [&](const std::string& bytes) {
    return animate_original(engine::File::from_bytes(bytes, ".glb"), {}, rig, two_frames(), two_times());
  };
  EXPECT_THROW_TEXT(animated(whole.substr(0, 300)),
                    "the data: is truncated: found 300 bytes, a chunk at byte 12 promises more");
  std::string unreadable = whole;
  unreadable[20] = 'x';
  EXPECT_THROW_TEXT(animated(unreadable), "the data: is damaged: its JSON cannot be read");
}

}  // namespace
}  // namespace face::exports
