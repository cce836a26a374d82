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

// Every file of sounds and texts holds its own name.
engine::File folder_of(const std::string& name, const Names& files, const test::Temporary* disk = nullptr) {
  std::vector<engine::File::Entry> entries;
  for (const std::string& file : files)
    entries.push_back({file, disk ? disk->write(name + "/" + file, name + "/" + file) : "/x/" + name + "/" + file});
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
      list.push_back(file.bytes());
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
                    "stream: none of its 1 takes is left; take a has no file a.wav in sound");
}

}  // namespace
