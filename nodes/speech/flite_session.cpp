// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/flite_session.h"

#include <flite/flite.h>

#include <cstdlib>
#include <memory>
#include <mutex>

#include "nodes/base/check.h"

extern "C" {
cst_voice* register_cmu_us_slt(const char* voxdir);
cst_voice* register_cmu_us_rms(const char* voxdir);
cst_voice* register_cmu_us_awb(const char* voxdir);
cst_voice* register_cmu_us_kal16(const char* voxdir);
cst_lexicon* cmu_lex_init(void);
}

namespace face::speech {
namespace {

struct UtteranceRelease {
  void operator()(cst_utterance* utterance) const { delete_utterance(utterance); }
};

// Guards the C library's own process-wide state; holds none of ours.
std::mutex& library() {
  static std::mutex mutex;
  return mutex;
}

cst_voice* voice_object(Voice voice) {
  switch (voice) {
    case Voice::slt:
      return register_cmu_us_slt(nullptr);
    case Voice::rms:
      return register_cmu_us_rms(nullptr);
    case Voice::awb:
      return register_cmu_us_awb(nullptr);
    case Voice::kal:
      return register_cmu_us_kal16(nullptr);
  }
  fail("unknown voice ", static_cast<int>(voice));
}

bool is_clitic(const cst_item* word) { return word && item_feat_string(word, "name")[0] == '\''; }

// The word that a segment belongs to; flite's "'s", "'ll" and the like are put back to the word before them.
std::string word_of(const cst_item* segment) {
  const cst_item* syllable = item_parent(item_as(segment, "SylStructure"));
  const cst_item* parent = syllable ? item_parent(syllable) : nullptr;
  const cst_item* word = parent ? item_as(parent, "Word") : nullptr;
  if (!word) return {};
  if (is_clitic(word) && item_prev(word)) word = item_prev(word);
  std::string name = item_feat_string(word, "name");
  if (is_clitic(item_next(word))) name += item_feat_string(item_next(word), "name");
  return name;
}

}  // namespace

SpokenUtterance flite_speak(const std::string& text, Voice voice, double stretch) {
  const std::lock_guard lock(library());
  flite_init();
  cst_voice* speaker = voice_object(voice);
  check(speaker != nullptr, "flite cannot make its voice");
  feat_set_float(speaker->features, "duration_stretch", static_cast<float>(stretch));
  std::srand(1);  // flite's excitation noise is rand()'s: the same text sounds the same each time
  std::unique_ptr<cst_utterance, UtteranceRelease> utterance(flite_synth_text(text.c_str(), speaker));
  check(utterance != nullptr, "flite cannot speak this text");
  SpokenUtterance spoken;
  const cst_wave* wave = utt_wave(utterance.get());
  check(wave != nullptr && wave->num_channels == 1, "flite gave no sound for this text");
  spoken.rate_hz = wave->sample_rate;
  spoken.samples.assign(wave->samples, wave->samples + wave->num_samples);
  for (const cst_item* item = relation_head(utt_relation(utterance.get(), "Segment")); item; item = item_next(item))
    spoken.phones.push_back({item_feat_string(item, "name"), word_of(item), item_feat_float(item, "end")});
  return spoken;
}

std::vector<std::string> flite_pronounce(const std::string& word) {
  const std::lock_guard lock(library());
  flite_init();
  cst_val* phones = lex_lookup(cmu_lex_init(), word.c_str(), nullptr, nullptr);
  std::vector<std::string> names;
  for (const cst_val* v = phones; v; v = val_cdr(v)) names.emplace_back(val_string(val_car(v)));
  delete_val(phones);
  return names;
}

}  // namespace face::speech
