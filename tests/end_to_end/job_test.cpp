// SPDX-License-Identifier: Apache-2.0
// The two jobs, from the command to the files: what they make, and what a change reruns.
extern "C" {
#include <libavformat/avformat.h>
}

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/end_to_end/command.h"
#include "tests/support/data.h"

namespace {

using test::operator+;
using test::Ended;
using test::lines_of;
using test::Words;
using Json = nlohmann::json;
using Counts = std::map<std::string, std::size_t>;

// Small pictures: what is asked here does not depend on their size.
const Words small = {"--set", "pictures.width_px=64", "--set", "pictures.height_px=64", "--set", "sheet.picture_px=64"};
const std::string sentence = "We put the big blue book upon the table before he came.";

struct Done : Ended {
  Json tasks;                      // counts of the summary
  Counts finished;                 // tasks that ran, by node
  std::set<std::string> elements;  // of tasks that ran: "take03/17"
  std::size_t of(const std::string& node) const { return finished.contains(node) ? finished.at(node) : 0; }
};

double stream_seconds(const AVFormatContext& file, AVMediaType kind) {
  for (unsigned i = 0; i < file.nb_streams; ++i) {
    const AVStream& stream = *file.streams[i];
    if (stream.codecpar->codec_type == kind) return static_cast<double>(stream.duration) * av_q2d(stream.time_base);
  }
  return -1;
}

class Job : public test::CommandTest {
 protected:
  static std::string talk() { return graph("speech/talk.json"); }
  static std::string talk_many() { return graph("speech/talk_many.json"); }
  static std::string track() { return graph("video_to_mesh/track.json"); }

  Done run(const std::string& graph_path, const Words& sets) const {
    Done done;
    static_cast<Ended&>(done) = command(
        Words{"run", graph_path, "--out", "out", "--summary", "summary.json", "--events", "events.ndjson"} + sets);
    EXPECT_EQ(done.code, 0) << done.output;
    if (done.code != 0) return done;
    done.tasks = Json::parse(read("summary.json"))["tasks"];
    for (const std::string& line : lines_of(read("events.ndjson"))) {
      const Json event = Json::parse(line);
      if (event["event"] != "finished") continue;
      ++done.finished[event["node"]];
      if (event.contains("element")) done.elements.insert(event["element"]);
    }
    return done;
  }

  // What flite says, as a recording.
  void record(const std::string& text, const std::string& name, double pause_s = 0) const {
    write("line.txt", text);
    const Ended ended = command({"get", talk(), "say.audio", "--set", "text=line.txt", "-o", "said.json"});
    ASSERT_EQ(ended.code, 0) << ended.output;
    std::vector<double> samples = Json::parse(read("said.json"))["samples"];
    samples.resize(samples.size() + static_cast<std::size_t>(16000 * pause_s));
    write(name, test::wav_of(samples));
  }

  // Rows that differ, without the heading.
  static std::size_t changed_rows(const std::string& a, const std::string& b) {
    const std::vector<std::string> before = lines_of(a), after = lines_of(b);
    EXPECT_EQ(before.size(), after.size());
    std::size_t changed = 0;
    for (std::size_t i = 1; i < std::min(before.size(), after.size()); ++i) changed += before[i] != after[i];
    return changed;
  }
};

// --- job A
// --------------------------------------------------------------------------------------------------------------

TEST_F(Job, MakesItsSixFilesOnceAndBringsOneBackWithoutWork) {
  write("line.txt", sentence);
  const Words sets = small + Words{"--set", "text=line.txt"};
  const Done first = run(talk(), sets);
  const std::vector<std::string> files = {"talk.glb",      "talk.csv",         "talk.mp4",
                                          "talk.TextGrid", "talk.phones.json", "talk.sheet.png"};
  std::map<std::string, std::string> made;
  for (const std::string& file : files) {
    made[file] = read("out/" + file);
    EXPECT_GT(made[file].size(), 100U) << file;
  }
  EXPECT_EQ(first.of("pictures"), lines_of(made["talk.csv"]).size() - 1);

  const Done second = run(talk(), sets);
  EXPECT_EQ(second.tasks["run"], 0);
  EXPECT_TRUE(second.finished.empty());
  std::filesystem::remove(folder() / "out/talk.mp4");
  write("out/talk.csv", "spoilt");
  const Done third = run(talk(), sets);
  EXPECT_EQ(third.tasks["run"], 0);
  for (const std::string& file : files) EXPECT_TRUE(read("out/" + file) == made[file]) << file;
}

TEST_F(Job, PicturesAndSoundOfTheVideoAreEquallyLong) {
  write("line.txt", sentence);
  run(talk(), small + Words{"--set", "text=line.txt"});
  AVFormatContext* opened = nullptr;
  ASSERT_EQ(avformat_open_input(&opened, path("out/talk.mp4").c_str(), nullptr, nullptr), 0);
  const auto close = [](AVFormatContext* file) { avformat_close_input(&file); };
  const std::unique_ptr<AVFormatContext, decltype(close)> file(opened, close);
  ASSERT_GE(avformat_find_stream_info(file.get(), nullptr), 0);
  const double pictures_s = stream_seconds(*file, AVMEDIA_TYPE_VIDEO),
               sound_s = stream_seconds(*file, AVMEDIA_TYPE_AUDIO);
  EXPECT_GT(pictures_s, 1);
  EXPECT_NEAR(pictures_s, sound_s, 1.0 / 60);
}

TEST_F(Job, OneWordOfTheTextRerunsOnlyTheFramesThatItMoves) {
  record(sentence, "line.wav");
  const Words sets = small + Words{"--set", "audio=line.wav", "--set", "text=line.txt"};
  const Done first = run(talk(), sets);
  const std::string before = read("out/talk.csv");
  write("line.txt", "We put the big blue boat upon the table before he came.");
  const Done second = run(talk(), sets);
  EXPECT_EQ(second.of("recording"), 0U);
  EXPECT_EQ(second.of("align"), 1U);
  EXPECT_EQ(second.of("speak"), 1U);
  EXPECT_EQ(second.of("embedded_rig"), 0U);
  const std::size_t changed = changed_rows(before, read("out/talk.csv"));
  EXPECT_EQ(second.of("pictures"), changed);
  EXPECT_GT(changed, 5U);
  EXPECT_LT(second.of("pictures"), first.of("pictures") / 2);
}

TEST_F(Job, OneVisemeTargetRerunsNoAlignmentAndNamesItsTable) {
  record(sentence, "line.wav");
  Json table = Json::parse(test::read_file(graph("speech/visemes.json")));
  write("visemes.json", table.dump());
  const Words sets =
      small + Words{"--set", "audio=line.wav", "--set", "text=line.txt", "--set", "visemes=visemes.json"};
  const Done first = run(talk(), sets);
  const std::string before = read("out/talk.csv");
  table["visemes"]["UW"]["weights"]["mouthPucker"] = 0.6;
  write("visemes.json", table.dump());
  const Ended explained = command(Words{"explain", talk(), "csv"} + sets);
  EXPECT_NE(explained.output.find("visemes.json changed"), std::string::npos) << explained.output;
  const Done second = run(talk(), sets);
  EXPECT_EQ(second.of("align") + second.of("recording") + second.of("embedded_rig"), 0U);
  EXPECT_EQ(second.of("table"), 1U);
  EXPECT_EQ(second.of("speak"), 1U);
  EXPECT_EQ(second.of("pictures"), changed_rows(before, read("out/talk.csv")));
  EXPECT_LT(second.of("pictures"), first.of("pictures") / 2);
}

TEST_F(Job, OverrideOfOneElementRendersOnePicture) {
  write("line.txt", "Good morning.");
  write("side.json",
        "{\"extends\": \"" + talk() + R"(", "nodes": {"pictures": {"overrides": {"5": {"yaw_deg": 20}}}}})");
  const Words sets = small + Words{"--set", "text=line.txt"};
  run(talk(), sets);
  const Done second = run(path("side.json"), sets);
  EXPECT_EQ(second.finished, (Counts{{"pictures", 1}, {"video", 1}}));
  EXPECT_EQ(second.elements, (std::set<std::string>{"5"}));
}

TEST_F(Job, EditingOneTakeRerunsThatTakeAlone) {
  record("She looked at her father.", "takes/one.wav");
  write("takes/one.txt", read("line.txt"));
  record("My cat sat by the warm fire for a while.", "takes/two.wav");
  write("takes/two.txt", read("line.txt"));
  record("Please call again.", "takes/three.wav");  // no text
  const Words sets = small + Words{"--set", "folder=takes"};
  run(talk_many(), sets);
  for (const char* take : {"one", "two", "three"})
    EXPECT_TRUE(exists(std::string("out/talk/") + take + ".glb")) << take;
  std::set<std::size_t> lengths;
  for (const char* take : {"one", "two", "three"})
    lengths.insert(lines_of(read(std::string("out/talk/") + take + ".csv")).size());
  EXPECT_EQ(lengths.size(), 3U);
  EXPECT_EQ(run(talk_many(), sets).tasks["run"], 0);

  record("She looked at her father.", "takes/one.wav", 0.25);
  const Done edited = run(talk_many(), sets);
  for (const char* node : {"recording", "align", "speak", "csv", "gltf", "video"})
    EXPECT_EQ(edited.of(node), 1U) << node;
  for (const std::string& element : edited.elements)
    EXPECT_TRUE(element == "one" || element.starts_with("one/")) << element;
}

// --- job B
// --------------------------------------------------------------------------------------------------------------

class TrackJob : public Job {
 protected:
  // One correction on a frame reruns the frames from there on, and nothing before.
  void correct(const Words& sets, std::size_t frame, const std::string& point, double x_px, double y_px) {
    write("corrections.json", "[]");
    const Words all = sets + Words{"--set", "corrections=corrections.json"};
    const Done first = run(track(), all);
    const std::size_t frames = first.of("track");
    ASSERT_GT(frames, frame);
    EXPECT_EQ(run(track(), all).tasks["run"], 0);
    write("corrections.json", Json::array({{{"frame", frame}, {"point", point}, {"xy", {x_px, y_px}}}}).dump());
    EXPECT_NE(command(Words{"explain", track(), "put_right"} + all).output.find("corrections.json changed"),
              std::string::npos);
    const Done second = run(track(), all);
    EXPECT_EQ(second.finished, (Counts{{"put_right", 1},
                                       {"track", frames - frame},
                                       {"drawn", frames - frame},
                                       {"table", 1},
                                       {"report", 1},
                                       {"overlay", 1}}));
    for (const std::string& element : second.elements) EXPECT_GE(std::stoul(element), frame);
    EXPECT_NE(read("out/tracks.csv").find(std::to_string(frame) + "," + point), std::string::npos);
  }
};

TEST_F(TrackJob, CorrectionOfAMadeClipRerunsFromItsFrameOn) {
  write("line.txt", "Good morning.");
  const Ended made = command({"run", talk(), "--set", "text=line.txt", "--set", "pictures.width_px=160", "--set",
                              "pictures.height_px=160", "--out", "clip", "--set", "sheet.picture_px=64"});
  ASSERT_EQ(made.code, 0) << made.output;
  write("points.json",
        R"({"image_size": [160, 160], "points": {"mouth": [80, 104], "nose": [80, 84], "eye": [66, 66]}})");
  correct({"--set", "video=clip/talk.mp4", "--set", "points=points.json"}, 20, "mouth", 81, 105);
}

TEST_F(TrackJob, AChangedCorrectionRerunsToThePointsNextOne) {
  write("line.txt", "Good morning.");
  ASSERT_EQ(command({"run", talk(), "--set", "text=line.txt", "--set", "pictures.width_px=160", "--set",
                     "pictures.height_px=160", "--out", "clip", "--set", "sheet.picture_px=64"})
                .code,
            0);
  write("points.json",
        R"({"image_size": [160, 160], "points": {"mouth": [80, 104], "nose": [80, 84], "eye": [66, 66]}})");
  const Words sets = {"--set", "video=clip/talk.mp4", "--set", "points=points.json", "--set", "corrections=fix.json"};
  const auto fix = [&](double x_px) {
    write("fix.json", Json::array({{{"frame", 10}, {"point", "mouth"}, {"xy", {x_px, 105}}},
                                   {{"frame", 17}, {"point", "mouth"}, {"xy", {81, 105}}}})
                          .dump());
  };
  fix(81);
  run(track(), sets);
  fix(82.5);
  const Done second = run(track(), sets);
  EXPECT_LE(second.of("track"), 8u);  // 10 to 16; 17 to see that it is what it was
  EXPECT_GE(second.of("track"), 7u);
  for (const std::string& element : second.elements) EXPECT_LE(std::stoul(element), 17u);
}

TEST_F(TrackJob, AClipWithoutSoundIsTracked) {
  write("line.txt", "Good morning.");
  write("mute.json", "{\"extends\": \"" + talk() + R"(", "nodes": {"video": {"inputs": {"audio": null}}}})");
  ASSERT_EQ(command({"run", path("mute.json"), "--set", "text=line.txt", "--set", "pictures.width_px=160", "--set",
                     "pictures.height_px=160", "--out", "clip", "--set", "sheet.picture_px=64"})
                .code,
            0);
  write("points.json", R"({"image_size": [160, 160], "points": {"mouth": [80, 104], "nose": [80, 84]}})");
  run(track(), {"--set", "video=clip/talk.mp4", "--set", "points=points.json"});
  EXPECT_TRUE(exists("out/overlay.mp4"));
  EXPECT_NE(read("out/report.txt").find(" points, 0 of them lost"), std::string::npos) << read("out/report.txt");
}

TEST_F(TrackJob, AnnotateMakesAPageOfAClip) {
  write("line.txt", "Good morning.");
  ASSERT_EQ(command({"run", talk(), "--set", "text=line.txt", "--set", "pictures.width_px=160", "--set",
                     "pictures.height_px=160", "--out", "clip", "--set", "sheet.picture_px=64"})
                .code,
            0);
  const Ended made =
      command({"annotate", "--clip", "clip/talk.mp4", "--points", "lips18", "--max-frames", "5", "--out", "page.html"});
  EXPECT_EQ(made.code, 0) << made.output;
  EXPECT_EQ(read("page.html").substr(0, 15), "<!DOCTYPE html>");
  write("points.json", R"({"image_size": [160, 160], "points": {"mouth": [80, 104], "nose_tip": [80, 84]}})");
  EXPECT_EQ(command({"annotate", "--clip", "clip/talk.mp4", "--start", "points.json", "--out", "again.html"}).code, 0);
  EXPECT_NE(read("again.html").find("\"nose_tip\":[80.0,84.0,1]"), std::string::npos);
}

TEST_F(TrackJob, CorrectionOfAGridClipRerunsFromItsFrameOn) {
  DATA_FILE(video, "grid/bbaf2n.mpg");
  DATA_FILE(points, "grid/bbaf2n.landmarks.json");
  correct({"--set", "video=" + video, "--set", "points=" + points}, 40, "lip_0", 141, 219);
}

}  // namespace
