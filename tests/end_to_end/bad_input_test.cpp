// SPDX-License-Identifier: Apache-2.0
// What a person is told who gives the command something wrong, and what is left on the disk after it.
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/end_to_end/command.h"

namespace {

using test::operator+;
using test::Ended;
using test::wav_of;
using test::Words;
using Lines = std::vector<std::string>;

std::vector<double> silence(double seconds) { return std::vector<double>(static_cast<std::size_t>(16000 * seconds)); }

class BadInput : public test::CommandTest {
 protected:
  BadInput() {
    write("good.txt", "We put the big blue book upon the table.");
    write("good.wav", wav_of(silence(1)));
  }

  Words talk(const Words& sets) const {
    Words words = {"run", graph("speech/talk.json")};
    for (const std::string& set : sets) words = words + Words{"--set", set};
    return words;
  }
  Ended listen(const std::string& audio) const {
    return command(talk({"audio=" + audio}) + Words{"--to", "recording"});
  }
  Ended read_script(const std::string& text) const { return command(talk({"text=" + text}) + Words{"--to", "script"}); }
  Ended take_rig(const std::string& rig) const {
    return command(talk({"text=good.txt", "rig=" + rig}) + Words{"--to", "given_rig"});
  }
  // A sentence spoken by flite, as a recording.
  void record(const std::string& text, const std::string& name) const {
    const Ended ended =
        command({"get", graph("speech/talk.json"), "say.audio", "--set", "text=" + text, "-o", path("said.json")});
    ASSERT_EQ(ended.code, 0) << ended.output;
    write(name, wav_of(nlohmann::json::parse(read("said.json"))["samples"]));
  }
  // An OBJ rig of four vertices: one line with another z per shape.
  void write_rig(const std::string& rig, const Lines& shapes) const {
    write(rig + "/generic_neutral_mesh.obj", quad(0, 4));
    for (std::size_t s = 0; s < shapes.size(); ++s)
      write(rig + "/" + shapes[s] + ".obj", quad(static_cast<double>(s + 1), 4));
  }
  static std::string quad(double z, int vertices) {
    const Lines corners = {"0 0 ", "10 0 ", "10 10 ", "0 10 "};
    std::string text;
    for (int v = 0; v < vertices; ++v) text += "v " + corners[static_cast<std::size_t>(v)] + std::to_string(z) + "\n";
    return text + (vertices == 4 ? "f 1 2 3 4\n" : "f 1 2 3\n");
  }
};

// --- recordings
// ---------------------------------------------------------------------------------------------------------

TEST_F(BadInput, MissingRecordingIsToldBeforeAnythingRuns) {
  const Ended ended = command(talk({"audio=nope.wav", "text=good.txt"}) + Words{"--out", "out"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.output, "command line: --set audio: the file nope.wav does not exist\n1 problem; nothing was run\n");
  EXPECT_FALSE(exists("out"));
  EXPECT_EQ(command(talk({"audio=goood.wav"})).output,
            "command line: --set audio: the file goood.wav does not exist (did you mean 'good.wav'?)\n"
            "1 problem; nothing was run\n");
  EXPECT_EQ(
      command(talk({"audio=~/line.wav"})).output,
      "command line: --set audio: the file ~/line.wav does not exist: a shell puts the home folder in the place of "
      "~ only where a word begins with it, so write $HOME\n1 problem; nothing was run\n");
}

TEST_F(BadInput, UnusableRecordingsSayWhatIsWrongOnce) {
  const std::string whole = wav_of(silence(1));
  write("empty.wav", "");
  write("cut.wav", whole.substr(0, 3000));
  write("header.wav", wav_of({}));
  write("text.wav", "this is no recording");
  write("text.mp4", "this is no recording");
  write("cut.m4a", std::string("\0\0\0\x18"
                               "ftypM4A \0\0\2\0M4A isom",
                               24));
  const std::string start = "recording (decode.audio): ";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"empty.wav", "empty.wav: is empty (0 bytes), expected a recording"},
      {"cut.wav", "cut.wav: is truncated: found 2956 bytes of samples from byte 44, its header promises 32000"},
      {"header.wav", "header.wav: holds no samples, expected a recording"},
      {"text.wav",
       "text.wav: cannot be read: Invalid data found when processing input; expected a recording (WAV, AIFF, FLAC, "
       "Ogg, MP3, M4A, or a video file with sound)"},
      {"text.mp4",
       "text.mp4: cannot be read: Invalid data found when processing input; expected a recording (WAV, AIFF, FLAC, "
       "Ogg, MP3, M4A, or a video file with sound)"},
      {"cut.m4a",
       "cut.m4a: cannot be read: the list of its frames (moov) was not found: is the file whole?; expected a recording "
       "(WAV, AIFF, FLAC, Ogg, MP3, M4A, or a video file with sound)"}};
  for (const auto& [name, text] : cases) {
    const Ended ended = listen(name);
    EXPECT_EQ(ended.code, 1) << name;
    EXPECT_EQ(ended.failures(), Lines{start + text});
    EXPECT_EQ(test::lines_of(ended.output).size(), 2U) << ended.output;  // the failure and the counts
  }
}

TEST_F(BadInput, EightBitAndSixChannelRecordingsAreRead) {
  write("eight.wav", wav_of(silence(1), 1, 8, 11025));
  write("six.wav", wav_of(silence(1), 6, 16, 48000));
  for (const char* name : {"eight.wav", "six.wav"}) {
    const Ended ended = listen(name);
    EXPECT_EQ(ended.code, 0) << ended.output;
    EXPECT_EQ(ended.failures() + ended.warnings(), Lines{});
  }
}

TEST_F(BadInput, SilentRecordingIsAWarning) {
  const Ended with_text = command(talk({"audio=good.wav", "text=good.txt"}) + Words{"--to", "align"});
  EXPECT_EQ(with_text.code, 0);
  EXPECT_EQ(with_text.warnings(), Lines{"align: the audio is silent: no word of the text was placed"});
  const Ended without = command(talk({"audio=good.wav"}) + Words{"--to", "align"});
  EXPECT_EQ(without.code, 0);
  EXPECT_EQ(without.warnings(), Lines{"align: the audio is silent: no phone was recognised"});
}

// --- texts
// --------------------------------------------------------------------------------------------------------------

TEST_F(BadInput, TextsWithoutTextSayWhatIsWrongOnce) {
  write("empty.txt", "");
  write("blank.txt", " \n\t\n");
  write("latin1.txt", "caf\xE9 noir");
  EXPECT_EQ(read_script("empty.txt").failures(), Lines{"script (decode.text): empty.txt: is empty, expected a text"});
  EXPECT_EQ(read_script("blank.txt").failures(), Lines{"script (decode.text): blank.txt: is empty, expected a text"});
  const Ended ended = read_script("latin1.txt");
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.failures(),
            Lines{"script (decode.text): latin1.txt line 1: found byte 0xE9 at byte 3, expected UTF-8 text"});
}

TEST_F(BadInput, PunctuationAloneCannotBeSaid) {
  write("marks.txt", "?! ... --");
  const Ended ended = command(talk({"text=marks.txt"}) + Words{"--to", "say"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.failures(),
            Lines{"say (speech.say): nothing to say: the text \"?! ... --\" has no letter and no digit"});
}

TEST_F(BadInput, WordsThatNoDictionaryHasAreReportedWithTheirPhones) {
  write("odd.txt", "The zorblax has 3 cats.");
  record("odd.txt", "odd.wav");
  const Ended ended = command(talk({"audio=odd.wav", "text=odd.txt"}) + Words{"--to", "align"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.warnings(), Lines{"align: \"zorblax\" is not in the dictionary: taken as Z AO R B L AE K S"});
}

TEST_F(BadInput, TextOfAnotherRecordingIsAWarningWithThePlace) {
  record("good.txt", "spoken.wav");
  write("other.txt", "Elephants never eat submarines.");
  const Ended ended = command(talk({"audio=spoken.wav", "text=other.txt"}) + Words{"--to", "align"});
  EXPECT_EQ(ended.code, 0);
  ASSERT_FALSE(ended.warnings().empty()) << ended.output;
  EXPECT_TRUE(ended.warnings()[0].starts_with("align: the text does not fit the sound from 0.")) << ended.output;
}

// --- rigs
// ---------------------------------------------------------------------------------------------------------------

const Lines needed = {"jawOpen", "mouthClose", "mouthFunnel", "mouthPucker", "mouthRollLower", "mouthRollUpper"};

TEST_F(BadInput, RigWithoutTheShapesOfSpeechNamesThem) {
  write_rig("head", {"jawOpen", "mouthClose"});
  const Ended ended = take_rig("head");
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.failures(),
            Lines{"given_rig (decode.rig): head: lacks the shapes mouthFunnel, mouthPucker, mouthRollLower, "
                  "mouthRollUpper; a rig needs jawOpen, mouthClose, mouthFunnel, mouthPucker, "
                  "mouthRollLower, mouthRollUpper. Found jawOpen, mouthClose"});
}

TEST_F(BadInput, ShapeWithAnotherVertexCountIsNamedWithBothCounts) {
  write_rig("head", needed);
  write("head/mouthPucker.obj", quad(4, 3));
  const Ended ended = take_rig("head");
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.failures(), Lines{"given_rig (decode.rig): mouthPucker.obj: has 3 vertices, the neutral mesh "
                                    "generic_neutral_mesh.obj has 4"});
}

TEST_F(BadInput, WhatIsNoRigIsToldFromARig) {
  write("photos/me.jpg", "a picture");
  write("cut.glb", std::string("glTF\2\0\0\0\0\1\0\0JSON", 16));
  EXPECT_EQ(
      take_rig("photos").failures(),
      Lines{"given_rig (decode.rig): photos: is not a rig: found 1 files, of which 0 are GLB or glTF; expected an "
            "ICT-FaceKit folder (generic_neutral_mesh.obj or neutral.obj, and one OBJ file per shape) or one glTF file "
            "with its "
            "buffers"});
  EXPECT_EQ(
      take_rig("good.txt").failures(),
      Lines{"given_rig (decode.rig): good.txt: is not a rig: found neither \"glTF\" nor JSON at byte 0, expected an "
            "ICT-FaceKit folder, or a GLB or glTF file with morph targets"});
  EXPECT_EQ(take_rig("cut.glb").failures(),
            Lines{"given_rig (decode.rig): cut.glb: is truncated: found 16 bytes, its header promises 256"});
}

// --- landmarks
// ----------------------------------------------------------------------------------------------------------

TEST_F(BadInput, LandmarkOutsideTheImageIsNamed) {
  write("points.json", R"({"image_size": [360, 288], "points": {"nose": [150, 90], "chin": [400, 20]}})");
  write("frame.ppm", "P6 360 288 255\n" + std::string(360 * 288 * 3, 'x'));
  const Ended ended = command({"run", graph("video_to_mesh/track.json"), "--set", "video=frame.ppm", "--set",
                               "points=points.json", "--to", "start"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.failures(),
            Lines{"start (decode.landmarks): points.json at /points/chin: found (400, 20), expected a point "
                  "inside the image of 360 x 288 pixels"});
}

// --- the command line and the graph
// -----------------------------------------------------------------------------------

TEST_F(BadInput, MisspeltSettingsNameTheNearestOne) {
  const Ended ended =
      command(talk({"txt=good.txt", "pictures.widht_px=64", "pictures.height_px=tall", "rate_hz=1000"}));
  EXPECT_EQ(ended.code, 2);
  const std::string expected =
      "command line: --set txt: the graph has no parameter 'txt' (did you mean 'text'?)\n"
      "command line: --set pictures.widht_px: the node 'pictures' has no parameter 'widht_px' (did you mean "
      "'width_px'?)\n"
      "command line: --set pictures.height_px: found the string \"tall\", expected an integer from 16 to 4096 px\n"
      "command line: --set rate_hz: found the number 1000, expected a number from 25 to 120 Hz (used at "
      "/nodes/speak/params/rate_hz)\n";
  for (const std::string& line : test::lines_of(expected))
    EXPECT_NE(ended.output.find(line + "\n"), std::string::npos) << ended.output;
}

TEST_F(BadInput, AWordThatNoNodeHasIsTold) {
  const Ended ended = command({"nodes", "xyzzy"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.output, "no node has 'xyzzy' in its name or its text\n");
}

TEST_F(BadInput, AMisspeltParameterIsNotToldAsAnUnsetOneToo) {
  EXPECT_EQ(command(talk({"txt=good.txt"})).output,
            "command line: --set txt: the graph has no parameter 'txt' (did you mean 'text'?)\n"
            "1 problem; nothing was run\n");
}

TEST_F(BadInput, ValuesThatAreNotThereAreToldWithThoseThatAre) {
  EXPECT_EQ(command(Words{"get", graph("speech/talk.json"), "recording.sound", "--set", "audio=good.wav"}).output,
            "error: node 'recording' has no output 'sound'; it has 'audio', 'silent', 'source_rate_hz' and "
            "'source_channels'\n");
  EXPECT_EQ(command(Words{"get", graph("speech/talk.json"), "speak.weights", "--set", "text=good.txt"}).output,
            "error: output 'weights' of node 'speak' is a sequence 1 deep, so it is named speak.weights[ID]\n");
}

TEST_F(BadInput, GraphWithCommentsRunsAndWithTyposNamesTheirPlaces) {
  write("good.json", "{ // a comment\n \"extends\": \"" + graph("speech/talk.json") + "\" /* and another */ }");
  EXPECT_EQ(command({"validate", "good.json", "--set", "text=good.txt"}).code, 0);
  write("typo.json", "{\"extends\": \"" + graph("speech/talk.json") +
                         "\",\n \"nodes\": {\"say\": {\"params\": {\"voce\": \"kal\"}}}}");
  const Ended typo = command({"run", "typo.json", "--set", "text=good.txt"});
  EXPECT_EQ(typo.code, 2);
  EXPECT_EQ(typo.output,
            "typo.json:2:31: /nodes/say/params/voce: 'speech.say' has no parameter \"voce\" (did you mean 'voice'?)\n"
            "1 problem; nothing was run\n");
}

TEST_F(BadInput, WrongWordsOnTheCommandLineAreInvalidArguments) {
  const std::vector<std::pair<Words, std::string>> told = {
      {{"rn", "x.json"}, "there is no command 'rn' (did you mean 'run'?)"},
      {{"run", "x.json", "--ouut", "x"}, "run: there is no option '--ouut' (did you mean '--out'?)"},
      {{"run", "x.json", "--strore", "x"}, "run: there is no option '--strore' (did you mean '--store'?)"},
      {{"run", "x.json", "y.json"}, "run: found a word too much: 'y.json'"},
      {{"run"}, "run: graph is required"},
      {{"--foo"}, "there is no option '--foo'"},
      {{"cache"}, "cache: expected one of the commands 'stat', 'gc', 'pin', 'unpin', 'verify' or 'audit'"},
      {{"cache", "stt"}, "cache: there is no command 'stt' (did you mean 'stat'?)"}};
  for (const auto& [words, text] : told)
    EXPECT_EQ(command(words).output, "command line: " + text + "\nRun with --help for more information.\n");
  for (const Words& words :
       {Words{"rn"}, Words{}, Words{"run"}, Words{"run", "nope.json"}, Words{"run", "."},
        talk({"text=good.txt"}) + Words{"--ouut", "x"}, talk({"text=good.txt"}) + Words{"--to", "cvs"},
        talk({"text=good.txt"}) + Words{"--memory", "lots"}, talk({"text"}), talk({})})
    EXPECT_EQ(command(words).code, 2) << ::testing::PrintToString(words);
}

TEST_F(BadInput, PluginFolderThatIsNotThereIsTold) {
  const Ended ended = command(Words{"--plugins", "nowhere"} + talk({"text=good.txt"}));
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.output, "error: command line: --plugins nowhere: there is no such folder\n");
}

// --- disks
// ----------------------------------------------------------------------------------------------------------------

TEST_F(BadInput, FoldersThatCannotBeWrittenAreToldBeforeAnythingRuns) {
  const Words job = talk({"text=good.txt"});
  write("file", "in the way");
  const Ended out = command(job + Words{"--out", "file"});
  EXPECT_EQ(out.code, 1);
  EXPECT_EQ(out.output, "error: cannot make the output folder file: Not a directory\n");
  const Ended store = wait(start(Words{"--store", "file/store"} + job));
  EXPECT_EQ(store.code, 1);
  EXPECT_NE(store.output.find("file/store"), std::string::npos) << store.output;
  const Ended summary = command(job + Words{"--summary", "file/summary.json"});
  EXPECT_EQ(summary.code, 1);
  EXPECT_EQ(summary.output, "error: cannot write file/summary.json: Not a directory\n");
  EXPECT_EQ(read("file"), "in the way");
}

// A limit on the size of files stands for a full disk: both fail in the middle of a write.
TEST_F(BadInput, FileThatDoesNotFitIsNotPublishedInPart) {
  const Words job = talk({"text=good.txt"}) + Words{"--to", "gltf", "--quiet"};
  ASSERT_EQ(command(job).code, 0);
  write("small.json", "{\"extends\": \"" + graph("speech/talk.json") +
                          R"(", "outputs": {"talk.mp4": null, "talk.sheet.png": null}})");
  const Words publish = {"run", "small.json", "--set", "text=good.txt", "--out", "out"};
  ASSERT_EQ(command(publish).code, 0);
  std::filesystem::remove_all(folder() / "out");
  std::string line = "ulimit -f 600; exec " FACEGRAPH_COMMAND " --store " + path("store");
  for (const std::string& word : publish) line += " '" + word + "'";
  const Ended full = wait(start({"-c", line}, "/bin/sh"));
  EXPECT_EQ(full.code, 1);
  EXPECT_NE(full.output.find("failed: output talk.glb: cannot write out/"), std::string::npos) << full.output;
  for (const auto& entry : std::filesystem::directory_iterator(folder() / "out"))
    EXPECT_NE(entry.path().extension(), ".glb") << entry.path();
  const Ended again = command(publish);
  EXPECT_EQ(again.code, 0) << again.output;
  EXPECT_TRUE(exists("out/talk.glb"));
  EXPECT_EQ(command({"cache", "verify"}).code, 0);
}

// --- the end before the end
// ---------------------------------------------------------------------------------------------

TEST_F(BadInput, InterruptedRunKeepsItsWorkAndPublishesNothing) {
  using Clock = std::chrono::steady_clock;
  const Words job = talk({"text=good.txt", "pictures.width_px=160", "pictures.height_px=160", "sheet.picture_px=64"});
  const pid_t child = start(job + Words{"--out", "out", "--events", "events.ndjson"});
  const auto rendered = [&] {
    std::size_t count = 0;
    for (const std::string& line : test::lines_of(read("events.ndjson")))
      if (line.starts_with("{\"event\":\"finished\"") && line.find("\"node\":\"pictures\"") != std::string::npos)
        ++count;
    return count;
  };
  const auto patience = Clock::now() + std::chrono::seconds(60);
  while (rendered() < 4 && Clock::now() < patience) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const auto begin = Clock::now();
  ::kill(child, SIGINT);
  const Ended ended = wait(child);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  EXPECT_EQ(ended.code, 130);
  EXPECT_LE(seconds, 1.0);
  EXPECT_NE(ended.output.find("finished tasks are kept\n"), std::string::npos) << ended.output;
  EXPECT_TRUE(std::filesystem::is_empty(folder() / "out"));

  const std::size_t kept = rendered();
  ASSERT_GE(kept, 4U);
  const Ended again = command(job + Words{"--out", "out", "--events", "events.ndjson"});
  EXPECT_EQ(again.code, 0) << again.output;
  const std::size_t frames = test::lines_of(read("out/talk.csv")).size() - 1;
  EXPECT_LT(kept, frames);
  EXPECT_EQ(rendered(), frames - kept);
}

TEST_F(BadInput, BadTakeLeavesTheOthersWhole) {
  record("good.txt", "takes/good.wav");
  write("takes/bad.wav", "");
  write("small.json", "{\"extends\": \"" + graph("speech/talk_many.json") +
                          R"(", "outputs": {"talk.mp4": null, "talk.sheet.png": null}})");
  const Ended ended = command({"run", "small.json", "--set", "folder=takes", "--out", "out"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.failures(),
            Lines{"recording[bad] (decode.audio): bad.wav: is empty (0 bytes), expected a recording"});
  EXPECT_TRUE(exists("out/talk/good.csv"));
  EXPECT_TRUE(exists("out/talk/good.glb"));
  EXPECT_FALSE(exists("out/talk/bad.csv"));
}

TEST_F(BadInput, AlternativeThatIsNotTakenDoesNotRun) {
  record("good.txt", "spoken.wav");
  write("marks.txt", "?!");
  const Ended ended = command(talk({"audio=spoken.wav", "text=marks.txt"}) + Words{"--to", "csv"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.failures(), Lines{});
  EXPECT_EQ(ended.warnings(), Lines{"align: the text has no words: phones are recognised from the sound"});
}

TEST_F(BadInput, SequenceThatCouldNotBeMadeIsNotAnEmptyOne) {
  write("frames/1.txt", "one");
  write("bad.txt", "this is bad");
  write("graph.json", R"({"facegraph": 1, "nodes": {
    "files": {"node": "files.list", "inputs": {"folder": {"file": "frames"}}},
    "text": {"node": "toy.read_text", "inputs": {"file": "files"}},
    "size": {"node": "toy.length", "inputs": {"text": "text"}},
    "bad": {"node": "toy.read_text", "inputs": {"file": {"file": "bad.txt"}}},
    "checked": {"node": "toy.fail", "inputs": {"text": "bad"}},
    "many": {"node": "toy.repeat", "inputs": {"text": "checked"}},
    "sizes": {"node": "toy.length", "inputs": {"text": "many"}},
    "total": {"node": "toy.sum_all", "inputs": {"numbers": "sizes"}},
    "total_text": {"node": "toy.number_text", "inputs": {"number": "total"}},
    "total_file": {"node": "toy.write_text", "inputs": {"text": "total_text"}},
    "added": {"node": "toy.add", "inputs": {"a": "size", "b": "sizes"}},
    "added_text": {"node": "toy.number_text", "inputs": {"number": "added"}},
    "added_file": {"node": "toy.write_text", "inputs": {"text": "added_text"}}
  }, "outputs": {"total.txt": "total_file", "added.txt": "added_file"}})");
  const Ended ended = command({"run", "graph.json", "--out", "out"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.failures(), Lines{"checked (toy.fail): the text contains 'bad'"});
  EXPECT_FALSE(exists("out/total.txt"));
  EXPECT_FALSE(exists("out/added/1.txt"));
}

TEST_F(BadInput, WhatManyElementsFailWithIsToldOfTheFirstAndCounted) {
  for (int i = 0; i < 8; ++i) write("texts/" + std::to_string(i) + ".txt", "bad");
  write("graph.json", R"({"facegraph": 1, "nodes": {
    "files": {"node": "files.list", "inputs": {"folder": {"file": "texts"}}},
    "texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
    "checked": {"node": "toy.fail", "inputs": {"text": "texts"}},
    "all": {"node": "toy.concat", "inputs": {"texts": "checked"}},
    "page": {"node": "toy.write_text", "inputs": {"text": "all"}}}, "outputs": {"page.txt": "page"}})");
  const Ended ended = command({"run", "graph.json"});
  EXPECT_EQ(ended.code, 1);
  Lines failures = ended.failures();
  std::sort(failures.begin(), failures.end());
  ASSERT_EQ(failures.size(), 6U) << ended.output;
  EXPECT_EQ(failures[0], "checked: the text contains 'bad' (the same of 3 more)");
}

TEST_F(BadInput, AFileInPlaceOfAFolderOfTakesIsNamed) {
  const Ended ended = command({"run", graph("speech/talk_many.json"), "--set", "folder=good.wav", "--out", "out"});
  EXPECT_EQ(ended.code, 1);
  const std::string text = ": its input 'folder' is the file " + path("good.wav") + ", expected a folder";
  EXPECT_EQ(ended.failures(), (Lines{"recordings" + text, "transcripts" + text}));
}

TEST_F(BadInput, FolderWithoutTakesIsAWarning) {
  std::filesystem::create_directories(folder() / "takes");
  const Ended ended = command({"run", graph("speech/talk_many.json"), "--set", "folder=takes", "--out", "out"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.warnings(),
            Lines{"nothing was published: the sequences that the outputs are made of have no elements"});
}

}  // namespace
