// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/list_takes.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/nodes/decode/temporary.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face::decode;
using Names = std::vector<std::string>;

class Heard : public engine::Progress {
 public:
  void warn(const std::string& text) override { texts.push_back(text); }
  Names texts;
};

// A WAV of 8 bits whose samples are a text's bytes.
std::string spoken(const std::string& text) {
  const auto number = [](std::size_t value, int bytes) {
    std::string out;
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
    return out;
  };
  const std::string even = text.size() % 2 ? text + " " : text;
  return "RIFF" + number(36 + even.size(), 4) + "WAVEfmt " + number(16, 4) + number(1, 2) + number(1, 2) +
         number(16000, 4) + number(16000, 4) + number(1, 2) + number(8, 2) + "data" + number(text.size(), 4) + even;
}

// Every file of sounds and texts says its own name; "bad" ones cannot be read.
engine::File folder_of(const std::string& name, const Names& files, const test::Temporary* disk = nullptr) {
  std::vector<engine::File::Entry> entries;
  for (const std::string& file : files) {
    const std::string says = name + "/" + file;
    const bool text = file.ends_with(".txt"), bad = file.find("bad") != std::string::npos;
    entries.push_back({file, disk ? disk->write(says, bad ? "\xFF?" : text ? says : spoken(says)) : "/x/" + says});
  }
  return engine::File::folder("/x/" + name, entries);
}

struct Listed {
  Names ids, takes, sounds, scripts, warnings;
  std::string report;
};

Listed list(const Names& stream, const Names* sound = nullptr, const Names* texts = nullptr) {
  Listed out;
  engine::SeqWriter<std::string> takes([&](std::string id, std::string take) {
    out.ids.push_back(std::move(id));
    out.takes.push_back(std::move(take));
  });
  const auto writer = [&](Names& list) {
    return engine::SeqWriter<engine::File>([&](std::string id, engine::File file) {
      EXPECT_EQ(id, out.ids[list.size()]);
      const std::string bytes = file.bytes(), says = bytes.starts_with("RIFF") ? bytes.substr(44) : bytes;
      list.push_back(says.substr(0, says.find(' ', says.find_last_of('.'))));
      EXPECT_EQ(file.suffix(), list.back().substr(list.back().find_last_of('.')));
    });
  };
  auto sounds = writer(out.sounds), scripts = writer(out.scripts);
  const test::Temporary disk;
  const engine::File sound_folder = folder_of("sound", sound ? *sound : Names(), &disk),
                     text_folder = folder_of("texts", texts ? *texts : Names(), &disk);
  Heard heard;
  out.report = list_takes(folder_of("stream", stream), sound ? &sound_folder : nullptr, texts ? &text_folder : nullptr,
                          takes, sounds, scripts, heard)
                   .report;
  for (const engine::File* folder : {&sound_folder, &text_folder})  // they are the user's
    for (const auto& entry : folder->entries()) EXPECT_TRUE(std::filesystem::exists(entry.path)) << entry.path;
  out.warnings = heard.texts;
  return out;
}

TEST(ListTakes, NamesTheFoldersOfDepthAndClouds) {
  const Listed listed = list({"camera.json", "cloud/b/1.ply", "depth/a/1.png", "depth/a/2.png", "mask/c/1.png"});
  EXPECT_EQ(listed.takes, (Names{"a", "b"}));
  EXPECT_EQ(listed.ids, listed.takes);
  EXPECT_TRUE(listed.sounds.empty());
  EXPECT_EQ(listed.report, "");
}

TEST(ListTakes, AreInTheOrderOfTheirNumbersWithTheirOwnSoundAndText) {
  const Names sound = {"01.wav", "10.wav", "2.wav"}, texts = {"1.txt", "10.txt", "2.txt"};
  const Listed listed = list({"depth/1/1.png", "depth/10/1.png", "depth/2/1.png"}, &sound, &texts);
  EXPECT_EQ(listed.ids, (Names{"1", "2", "10"}));
  EXPECT_EQ(listed.sounds, (Names{"sound/01.wav", "sound/2.wav", "sound/10.wav"}));
  EXPECT_EQ(listed.scripts, (Names{"texts/1.txt", "texts/2.txt", "texts/10.txt"}));
  EXPECT_TRUE(listed.warnings.empty());
}

TEST(ListTakes, TakesAnyNameOfAFolder) {
  const Names sound = {"a_b.wav", "M\xc3\xa4rz (1).wav", "a b.flac", "3-4.wav"};
  const Listed listed =
      list({"depth/a b/1.png", "depth/a_b/1.png", "depth/M\xc3\xa4rz (1)/1.png", "depth/3-4/1.png"}, &sound);
  EXPECT_EQ(listed.ids, (Names{"3_4", "M_rz__1_", "a_b", "a_b_2"}));
  EXPECT_EQ(listed.takes, (Names{"3-4", "M\xc3\xa4rz (1)", "a_b", "a b"}));
  EXPECT_EQ(listed.sounds, (Names{"sound/3-4.wav", "sound/M\xc3\xa4rz (1).wav", "sound/a_b.wav", "sound/a b.flac"}));
  EXPECT_EQ(listed.warnings, (Names{"take 3-4: it is called 3_4 in what is written",
                                    "take M\xc3\xa4rz (1): it is called M_rz__1_ in what is written",
                                    "take a b: it is called a_b_2 in what is written"}));
}

TEST(ListTakes, LeavesOutTakesWithoutSoundOrText) {
  const Names sound = {".DS_Store", "a.lab", "a.wav", "b.wav", "d.wav", "old.wav"},
              texts = {"a.txt", "c.txt", "notes.md"};
  const Listed listed =
      list({"depth/a/1.png", "depth/b/1.png", "depth/c/1.png", "depth/d/1.png", "depth/e/1.png"}, &sound, &texts);
  EXPECT_EQ(listed.ids, (Names{"a"}));
  EXPECT_EQ(listed.warnings,
            (Names{"take a: sound has a second file for it, a.lab; left out",
                   "take b: it has no file b.txt in texts; left out", "take c: it has no file c.wav in sound; left out",
                   "take d: it has no file d.txt in texts; left out",
                   "take e: it has no file e.wav in sound and has no file e.txt in texts; left out",
                   "sound/old.wav belongs to no take; left out"}));
  std::string lines;
  for (const std::string& warning : listed.warnings) lines += warning + "\n";
  EXPECT_EQ(listed.report, lines);
}

TEST(ListTakes, LeavesOutTakesWhoseSoundOrTextCannotBeRead) {
  const Names sound = {"a.wav", "b bad.wav", "c.wav", "d bad.txt"}, texts = {"a.txt", "b bad.txt", "c.txt"};
  const Listed listed = list({"depth/a/1.png", "depth/b bad/1.png", "depth/c/1.png"}, &sound, &texts);
  EXPECT_EQ(listed.ids, (Names{"a", "c"}));
  EXPECT_EQ(listed.sounds, (Names{"sound/a.wav", "sound/c.wav"}));
  EXPECT_EQ(listed.warnings,
            (Names{"take b bad: b bad.wav: cannot be read: Invalid data found when processing input; expected a "
                   "recording (WAV, AIFF, FLAC, Ogg, MP3, M4A, or a video file with sound); left out"}));
  const Names good = {"a.wav", "bad.wav"}, odd = {"a.txt", "bad.txt"};
  EXPECT_EQ(list({"depth/a/1.png", "depth/bad/1.png"}, nullptr, &odd).warnings,
            (Names{"take bad: bad.txt line 1: found byte 0xFF at byte 0, expected UTF-8 text; left out"}));
  EXPECT_EQ(list({"depth/a/1.png", "depth/bad/1.png"}, &good).ids, (Names{"a"}));
}

TEST(ListTakes, SoundsAndTextsMayLieInOneFolder) {
  const Names both = {"a.txt", "a.wav"};
  const Listed listed = list({"depth/a/1.png"}, &both, &both);
  EXPECT_EQ(listed.sounds, (Names{"sound/a.wav"}));
  EXPECT_EQ(listed.scripts, (Names{"texts/a.txt"}));
  EXPECT_TRUE(listed.warnings.empty());
}

TEST(ListTakes, RejectsAFolderWithoutTakesOrWithNoneLeft) {
  EXPECT_THROW_TEXT(list({"a.png"}), "stream: has no files like depth/TAKE/17.png or cloud/TAKE/17.ply among its 1");
  const Names sound = {"b.wav"};
  EXPECT_THROW_TEXT(list({"depth/a/1.png"}, &sound),
                    "stream: none of its 1 takes is left; take a: it has no file a.wav in sound");
}

}  // namespace
