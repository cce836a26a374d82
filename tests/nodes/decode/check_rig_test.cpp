// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/check_rig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "nodes/decode/read_rig.h"
#include "nodes/types/arkit.h"
#include "tests/nodes/decode/temporary.h"

using namespace face;
using namespace face::decode;

TEST(GuessArkit, GoesByTheWordsOfAName) {
  const std::vector<std::string> all = {"jawOpen",         "mouthPucker",  "mouthSmileLeft",
                                        "mouthSmileRight", "eyeBlinkLeft", "browInnerUp"};
  EXPECT_EQ(guess_arkit("Smile_L_mouth", all), "mouthSmileLeft");
  EXPECT_EQ(guess_arkit("head.Jaw_Open", all), "jawOpen");  // what stands before a dot is no name
  EXPECT_EQ(guess_arkit("Jaw opened", all), "jawOpen");
  EXPECT_EQ(guess_arkit("lips-kiss", all), "mouthPucker");
  EXPECT_EQ(guess_arkit("BlinkLeft", all), "eyeBlinkLeft");
  EXPECT_EQ(guess_arkit("inner_brow_raise", all), "browInnerUp");
  EXPECT_EQ(guess_arkit("Wolf3D_Head_mouthSmile_L", all), "mouthSmileLeft");
  EXPECT_EQ(guess_arkit("bs_jawOpen", all), "jawOpen");
  EXPECT_EQ(guess_arkit("jawOpen.001", all), "jawOpen");
  EXPECT_EQ(guess_arkit("smile", all), "");  // left or right
  EXPECT_EQ(guess_arkit("Key 12", all), "");
  EXPECT_EQ(guess_arkit("", all), "");
}

TEST(CheckRig, ProposesNamesAndTheProposalServes) {
  const test::Temporary temporary;
  const std::string v = "v 0 0 0\nv 10 0 0\nv 0 20 0\n", f = "f 1 2 3\n";
  std::vector<engine::File::Entry> entries;
  const auto add = [&](const std::string& name, const std::string& text) {
    entries.push_back({name, temporary.write(name, text)});
  };
  add("neutral.obj", v + f);
  for (const char* name :
       {"Jaw_Opened", "mouth closing", "mouthClose", "lips_funnel", "lip_kiss", "roll_lower_lip", "Key7"})
    add(std::string(name) + ".obj", "v 0 -1 0\nv 10 0 0\nv 0 20 0\n");
  add("roll_upper_mouth.obj", "v 0 -2 0\nv 10 0 0\nv 0 20 0\n");
  const engine::File folder = engine::File::folder(temporary.folder().string(), entries);
  const CheckRigResult first = check_rig(folder, nullptr);
  EXPECT_FALSE(first.sound);
  EXPECT_NE(first.text.find("8 shapes; 1 of ARKit's 52 are there\n"), std::string::npos) << first.text;
  EXPECT_NE(first.text.find("names.json proposes jawOpen for \"Jaw_Opened\"\n"), std::string::npos) << first.text;
  EXPECT_NE(first.text.find("as it is it cannot be used: "), std::string::npos) << first.text;
  const auto names = nlohmann::json::parse(first.names.bytes());
  EXPECT_EQ(names["lip_kiss"], "mouthPucker");
  EXPECT_EQ(names["Key7"], "");

  const engine::File filled = engine::File::at(temporary.write("names.json", first.names.bytes()));
  const CheckRigResult second = check_rig(folder, &filled);
  EXPECT_TRUE(second.sound) << second.text;
  EXPECT_NE(second.text.find("it can be used as it is\n"), std::string::npos);
  EXPECT_NE(second.text.find("for points of a video they are found by its shapes, to a few mm\n"), std::string::npos);
  EXPECT_NE(second.text.find("100 mm wide, 200 mm high"), std::string::npos) << second.text;
  EXPECT_EQ(read_rig(folder, &filled).shapes[arkit_index("jawOpen")].vertices.size(), 1u);
}

TEST(CheckRig, SaysWhereAHeadDoesNotStandAndLookToTheViewer) {
  const test::Temporary temporary;
  // A chin of three vertices before the back of the head, and where jawOpen takes it.
  const auto text = [&](const std::string& folder, const std::string& chin_z, const std::string& jaw) {
    std::vector<engine::File::Entry> entries;
    const auto add = [&](const std::string& name, const std::string& chin) {
      entries.push_back({name + ".obj", temporary.write(folder + "/" + name + ".obj",
                                                        chin + "v 0 0 0\nv 80 80 0\nv 0 80 0\nf 1 2 3\nf 1 4 5 6\n")});
    };
    const auto chin = [&](const std::string& y, const std::string& z) {
      return "v 0 " + y + " " + z + "\nv 2 " + y + " " + z + "\nv 1 " + y + " " + z + "\n";
    };
    for (const char* name : {"mouthClose", "mouthFunnel", "mouthPucker", "mouthRollLower", "mouthRollUpper", "neutral"})
      add(name, chin("0", chin_z));
    add("jawOpen", jaw == "down" ? chin("-1", chin_z) : chin("0", "9"));
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return check_rig(engine::File::folder(temporary.path(folder), entries), nullptr).text;
  };
  EXPECT_NE(text("right", "10", "down").find("it can be used as it is\n"), std::string::npos)
      << text("right", "10", "down");
  EXPECT_NE(text("lying", "10", "back")
                .find("as it is it cannot be used: jawOpen does not move the jaw down: is y up in the file?"),
            std::string::npos);
  EXPECT_NE(text("away", "-10", "down").find("does it look to -z? Turn it round in the file\n"), std::string::npos);
}

// A triangle, hanging, of which the shapes, but for those named, move a corner by 1.
std::string triangle_head(const std::string& names, const std::string& targets) {
  return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"rotation":[1,0,0,0]}],"images":[{"uri":"skin.png"}],
    "meshes":[{"extras":{"targetNames":[)" +
         names + R"(]},"primitives":[{"attributes":{"POSITION":0},"targets":[)" + targets +
         R"(]}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
    {"componentType":5126,"count":3,"type":"VEC3"}],
    "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,
    "uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}
const char* six_names = R"("jawOpen","mouthClose","mouthFunnel","mouthPucker","mouthRollLower","mouthRollUpper")";

TEST(CheckRig, SaysWhatBecomesOfTextures) {
  const test::Temporary temporary;
  const std::string moves = R"({"POSITION":0})", all = moves + "," + moves + "," + moves;
  const CheckRigResult result =
      check_rig(engine::File::at(temporary.write("head.gltf", triangle_head(six_names, all + "," + all))), nullptr);
  EXPECT_TRUE(result.sound) << result.text;
  EXPECT_NE(result.text.find("its textures stay in a GLB that is made of it; pictures and films cannot show them (PNG, "
                             "JPEG and WebP can be read)\n"),
            std::string::npos)
      << result.text;
}

TEST(CheckRig, NamesShapesThatMoveNothingAndProposesAnotherForTheJaw) {
  const test::Temporary temporary;
  const std::string moves = R"({"POSITION":0})", still = R"({"POSITION":1})";
  const std::string names = std::string(six_names) + R"(,"tongueOut","viseme_aa")";
  const std::string targets =
      still + "," + moves + "," + moves + "," + moves + "," + moves + "," + moves + "," + still + "," + moves;
  const engine::File head = engine::File::at(temporary.write("head.gltf", triangle_head(names, targets)));
  const CheckRigResult result = check_rig(head, nullptr);
  EXPECT_FALSE(result.sound);
  EXPECT_NE(result.text.find("there, but move nothing: jawOpen, tongueOut\n"), std::string::npos) << result.text;
  EXPECT_NE(result.text.find("as it is it cannot be used: head.gltf: its jawOpen moves nothing: map a shape that opens "
                             "the mouth to jawOpen, by a file, which facegraph doctor proposes\n"),
            std::string::npos)
      << result.text;
  EXPECT_EQ(result.names.bytes(), "{\n  \"viseme_aa\": \"jawOpen\"\n}\n");
  const CheckRigResult with_names = check_rig(head, &result.names);
  EXPECT_TRUE(with_names.sound) << with_names.text;
  EXPECT_EQ(with_names.text.find("jawOpen, "), std::string::npos) << with_names.text;
}

TEST(CheckRig, SaysWhyShapesHaveNoNames) {
  const test::Temporary temporary;
  const std::string moves = R"({"POSITION":0})";
  const CheckRigResult result =
      check_rig(engine::File::at(temporary.write("head.gltf", triangle_head("", moves + "," + moves))), nullptr);
  EXPECT_FALSE(result.sound);
  EXPECT_NE(result.text.find("\nshapes without names were written without extras.targetNames: export it anew with "
                             "names, or fill in which is which\n"),
            std::string::npos)
      << result.text;
  EXPECT_EQ(result.names.bytes(), "{\n  \"target 0 (unnamed)\": \"\",\n  \"target 1 (unnamed)\": \"\"\n}\n");
}

TEST(CheckRig, SaysOfAMeshWithoutShapesJustThat) {
  const test::Temporary temporary;
  const CheckRigResult result =
      check_rig(engine::File::at(temporary.write("head.gltf", triangle_head("", ""))), nullptr);
  EXPECT_EQ(result.text,
            "head.gltf: 0 shapes; 0 of ARKit's 52 are there\nas it is it cannot be used: head.gltf: is not a "
            "rig: found a mesh of 3 vertices without morph targets\n");
}

TEST(CheckRig, SaysWhatIsNoRig) {
  const test::Temporary temporary;
  const CheckRigResult result = check_rig(engine::File::at(temporary.write("head.glb", "no")), nullptr);
  EXPECT_FALSE(result.sound);
  EXPECT_NE(result.text.find("head.glb: "), std::string::npos);
  EXPECT_EQ(result.names.bytes(), "{}\n");
}
