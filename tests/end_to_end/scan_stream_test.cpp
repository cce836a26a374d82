// SPDX-License-Identifier: Apache-2.0
// Recorded streams of scans, as a person with a scanner has them: written by graphs/scan_stream/record.json, read back,
// with frames that are wrong, and with one frame's threshold put right.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/end_to_end/command.h"

namespace {

using test::operator+;
using test::Ended;
using test::Words;
namespace fs = std::filesystem;

class ScanStream : public test::CommandTest {
 protected:
  void SetUp() override { record(160, 120); }

  void record(int width_px, int height_px) const {
    write("sentences/1.txt", "Five.\n");
    const Ended ended = command({"run", graph("scan_stream/record.json"), "--quiet", "--set", "sentences=sentences",
                                 "--set", "width_px=" + std::to_string(width_px), "--set",
                                 "height_px=" + std::to_string(height_px), "--out", "stream"});
    ASSERT_EQ(ended.code, 0) << ended.output;
  }

  // Reads the stream and writes it again, the mouths removed. overrides: of the removal.
  Ended reread(const std::string& overrides = {}) const {
    write("reread.json", R"({"facegraph": 1, "params": {"scans": {"type": "path"}}, "nodes": {
        "takes": { "node": "decode.list_takes", "inputs": {"folder": "${scans}"} },
        "scan": { "node": "decode.depth_take", "inputs": {"folder": "${scans}", "take": "takes.takes"} },
        "again": { "node": "export.depth", "inputs": {"scan": "scan.scans"} },
        "mouth": { "node": "mask.remove_mouth", "inputs": {"scan": "scan.scans"}, "overrides": {)" +
                             overrides + R"(} },
        "cleared": { "node": "export.depth", "inputs": {"scan": "mouth.scan"} },
        "report": { "node": "export.text", "inputs": {"text": "scan.report"} }},
      "outputs": {"depth.png": "again.depth", "picture.png": "again.picture", "cleared.png": "cleared.depth",
                  "report.txt": "report"}})");
    return command({"run", "reread.json", "--set", "scans=stream", "--out", "out"});
  }

  std::vector<std::string> names(const std::string& folder) const {
    std::vector<std::string> list;
    for (const auto& entry : fs::directory_iterator(path(folder))) list.push_back(entry.path().filename().string());
    return list;
  }
};

TEST_F(ScanStream, ComesBackFromFilesBitForBit) {
  const Ended ended = reread();
  ASSERT_EQ(ended.code, 0) << ended.output;
  const std::vector<std::string> frames = names("stream/depth/1");
  EXPECT_GE(frames.size(), 20u);
  for (const std::string& frame : frames) {
    EXPECT_EQ(read("out/depth/1/" + frame), read("stream/depth/1/" + frame)) << frame;
    EXPECT_EQ(read("out/picture/1/" + frame), read("stream/picture/1/" + frame)) << frame;
  }
  EXPECT_EQ(read("out/report/1.txt"), "");
}

TEST_F(ScanStream, NamesWhatIsWrongAndKeepsTheRest) {
  const std::size_t count = names("stream/depth/1").size();
  write("stream/depth/1/3.png", "no picture");
  fs::remove(path("stream/depth/1/7.png"));
  fs::remove(path("stream/picture/1/7.png"));
  fs::remove(path("stream/picture/1/9.png"));
  const Ended ended = reread();
  ASSERT_EQ(ended.code, 0) << ended.output;
  EXPECT_EQ(names("out/depth/1").size(), count - 3);
  for (const char* text :
       {"take 1, frame 3: depth/1/3.png", "take 1, frame 7 is missing", "take 1, frame 9: it has no picture"}) {
    EXPECT_NE(ended.output.find(text), std::string::npos) << text << "\n" << ended.output;
    EXPECT_NE(read("out/report/1.txt").find(text), std::string::npos) << text;
  }
}

// Folders as people name them, a take whose depth is no depth, one without sound, one whose sound is none.
TEST_F(ScanStream, LeavesOutATakeOfWhichNothingIsLeftAndKeepsTheRest) {
  const auto copy_take = [&](const std::string& take) {
    for (const std::string kind : {"depth", "picture"})
      fs::copy(path("stream/" + kind + "/1"), path("stream/" + kind + "/" + take));
    fs::copy(path("sentences/1.txt"), path("sentences/" + take + ".txt"));
    fs::copy(path("stream/sound/1.wav"), path("stream/sound/" + take + ".wav"));
  };
  for (const char* take : {"M\xc3\xa4rz, second try", "dark", "mute", "hiss"}) copy_take(take);
  const std::size_t count = names("stream/depth/1").size();
  for (const std::string& frame : names("stream/depth/dark")) write("stream/depth/dark/" + frame, "no picture");
  fs::remove(path("stream/sound/mute.wav"));
  write("stream/sound/hiss.wav", "no sound");
  fs::remove_all(path("stream/depth/1"));
  const Ended ended =
      command({"run", graph("scan_stream/recorded.json"), "--set", "scans=stream", "--set", "sound=stream/sound",
               "--set", "texts=sentences", "--to", "learned/all_smooth", "--events", "events.ndjson"});
  EXPECT_EQ(ended.code, 0) << ended.output;
  for (const char* text :
       {"take M\xc3\xa4rz, second try: it is called M_rz__second_try in what is written",
        "take mute: it has no file mute.wav in sound; left out", "take hiss: hiss.wav: cannot be read",
        "sound/1.wav belongs to no take; left out", "take dark: none of its ",
        " frames is left; frame 0: depth/dark/0.png", "; the take is left out"})
    EXPECT_NE(ended.output.find(text), std::string::npos) << text << "\n" << ended.output;
  std::size_t smoothed = 0;
  for (const std::string& line : test::lines_of(read("events.ndjson"))) {
    const nlohmann::json event = nlohmann::json::parse(line);
    if (event["event"] == "finished" && event["node"] == "learned/smooth") ++smoothed;
  }
  EXPECT_EQ(smoothed, count);
  EXPECT_TRUE(fs::exists(path("stream/sound/1.wav")));
  const Ended joined = command({"run", graph("scan_stream/recorded.json"), "--set", "scans=stream", "--set",
                                "sound=stream/sound", "--set", "texts=sentences", "--to", "joined"});
  EXPECT_EQ(joined.code, 0) << joined.output;
  EXPECT_EQ(joined.output.find("warning: joined"), std::string::npos) << joined.output;
}

TEST_F(ScanStream, OneFramesThresholdRerunsThatFrameAlone) {
  ASSERT_EQ(reread().code, 0);
  const Ended ended = reread(R"("1/5": {"threshold_mm": 2.5})");
  ASSERT_EQ(ended.code, 0) << ended.output;
  // Its removal, and the export of what is left where that is another.
  EXPECT_TRUE(ended.output.find("\n1 run, ") != std::string::npos ||
              ended.output.find("\n2 run, ") != std::string::npos || ended.output.starts_with("1 run, ") ||
              ended.output.starts_with("2 run, "))
      << ended.output;
}

// With the whole way to the model behind it. The reference is given: another one would be another model.
class ScanModel : public ScanStream {
 protected:
  void SetUp() override { record(320, 240); }

  // Tasks that ran, by node.
  std::map<std::string, int> learn(const nlohmann::json& overrides) const {
    using Json = nlohmann::json;
    Json model = Json::parse(test::read_file(graph("scan_stream/model.json")), nullptr, true, true);
    model.erase("inputs");
    model["params"]["scans"]["type"] = "path";
    model["params"]["every"]["default"] = 1;
    model["params"]["components"]["default"] = 5;
    model["params"]["marker_radius_px"]["default"] = 1.6;
    model["params"]["reference"]["default"] = "1.12";
    Json& nodes = model["nodes"];
    nodes["takes"] = {{"node", "decode.list_takes"}, {"inputs", {{"folder", "${scans}"}}}};
    nodes["scan"] = {{"node", "decode.depth_take"}, {"inputs", {{"folder", "${scans}"}, {"take", "takes.takes"}}}};
    nodes["report"] = {{"node", "export.text"}, {"inputs", {{"text", "scan.report"}}}};
    nodes["found"]["inputs"]["scans"] = "scan.scans";
    nodes["track"]["inputs"]["scan"] = nodes["mouth"]["inputs"]["scan"] = "scan.scans";
    nodes["mouth"]["overrides"] = overrides;
    model["outputs"] = {{"report.txt", "report"}};
    write("learn.json", model.dump());
    const Ended ended =
        command({"run", "learn.json", "--set", "scans=stream", "--to", "coefficients", "--events", "events.ndjson"});
    EXPECT_EQ(ended.code, 0) << ended.output;
    std::map<std::string, int> tasks;
    for (const std::string& line : test::lines_of(read("events.ndjson"))) {
      const nlohmann::json event = nlohmann::json::parse(line);
      if (event["event"] == "finished") ++tasks[event["node"]];
    }
    return tasks;
  }
};

TEST_F(ScanModel, OneFramesThresholdRerunsItsChainAndTheModel) {
  const int frames = static_cast<int>(names("stream/depth/1").size());
  std::map<std::string, int> first = learn(nlohmann::json::object());
  EXPECT_EQ(first["flow"], frames);
  EXPECT_EQ(first["coefficients"], frames);
  const nlohmann::json put_right = {{"1/11", {{"threshold_mm", 3.0}}}};
  const std::map<std::string, int> again = learn(put_right);
  for (const auto& [node, count] : again) EXPECT_LE(count, node == "coefficients" ? frames : 1) << node;
  EXPECT_TRUE(again.contains("mouth"));
  EXPECT_TRUE(again.contains("flow"));
  EXPECT_TRUE(again.contains("space"));
  EXPECT_FALSE(again.contains("track"));
  EXPECT_FALSE(again.contains("scan"));
  EXPECT_TRUE(learn(put_right).empty());
}

TEST_F(ScanStream, ACameraFileThatCannotBeStopsTheRun) {
  write("stream/camera.json", R"({"fx": 0, "cx": 1, "cy": 1})");
  const Ended ended = reread();
  EXPECT_NE(ended.code, 0);
  EXPECT_NE(ended.output.find("camera.json: fx is 0 and fy 0 px, expected both more than 0"), std::string::npos)
      << ended.output;
}

}  // namespace
