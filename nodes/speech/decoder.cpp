// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/decoder.h"

#include <pocketsphinx.h>
#include <sphinxbase/err.h>
#include <sphinxbase/fsg_model.h>

#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <set>

#include "nodes/base/check.h"

namespace face::speech {
namespace {

// PocketSphinx reports by a process-wide callback and ends the process after a fatal message. Nothing of it is printed;
// a fatal message becomes an exception before it comes to that (its C code holds nothing that unwinding would break).
void on_message(void*, err_lvl_t level, const char* format, ...) {
  if (level != ERR_FATAL) return;
  char text[512];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  std::string line = text;
  while (!line.empty() && line.back() == '\n') line.pop_back();
  fail("PocketSphinx: ", line);
}

void silence_library() {
  static std::once_flag once;
  std::call_once(once, [] { err_set_callback(&on_message, nullptr); });
}

struct ConfigRelease {
  void operator()(cmd_ln_t* config) const { cmd_ln_free_r(config); }
};
struct DecoderRelease {
  void operator()(ps_decoder_t* decoder) const { ps_free(decoder); }
};

// Where a model file is: an entry of the folder, or below its path.
std::string model_file(const engine::File& model, const std::string& name) {
  if (std::string path = model.find(name); !path.empty()) return path;
  if (!model.entries().empty()) return {};
  const std::filesystem::path path = std::filesystem::path(model.path()) / name;
  return std::filesystem::is_regular_file(path) ? path.string() : std::string();
}

// PocketSphinx takes a file that is no language model without a word, and recognises phones without one.
void check_phone_model(const engine::File& file) {
  constexpr std::size_t looked_at = 1 << 16;
  std::string start(looked_at, '\0');
  std::ifstream in(file.path(), std::ios::binary);
  in.read(start.data(), looked_at);
  start.resize(static_cast<std::size_t>(in.gcount()));
  const bool known =
      start.starts_with("Trie Language Model") || start.substr(0, 32).find("Darpa") != std::string::npos ||
      start.find("\\data\\") != std::string::npos || start.starts_with("\x1F\x8B") || start.starts_with("BZh");
  check(known, file.name(),
        ": is not a phone model: expected a language model over phones, as PocketSphinx's binary or ARPA text");
}

}  // namespace

struct Decoder::State {
  std::unique_ptr<ps_decoder_t, DecoderRelease> decoder;
  std::set<std::string> words;
};

Decoder::Decoder(const engine::File& acoustic_model, const DecoderOptions& options)
    : state_(std::make_unique<State>()) {
  silence_library();
  err_set_logfp(nullptr);  // per thread
  std::unique_ptr<cmd_ln_t, ConfigRelease> config(
      cmd_ln_init(nullptr, ps_args(), FALSE, "-cmn", "batch", "-remove_silence", "no", "-dither", "no", "-bestpath",
                  "no", "-allphone_ci", "yes", "-wip", "1", "-pip", "1", "-fsgusefiller", "no", "-fsgusealtpron", "no",
                  "-maxhmmpf", "-1", "-remove_noise", "yes", nullptr));
  check(config != nullptr, "PocketSphinx refuses its configuration");
  for (const char* beam : {"-beam", "-pbeam", "-wbeam"}) cmd_ln_set_float_r(config.get(), beam, options.beam);
  cmd_ln_set_int_r(config.get(), "-ds", options.frame_step);
  cmd_ln_set_float_r(config.get(), "-lw", options.phone_model_weight);
  const std::map<std::string, std::string> files = {
      {"-mdef", "mdef"}, {"-mean", "means"}, {"-var", "variances"}, {"-tmat", "transition_matrices"}};
  for (const auto& [option, name] : files) {
    const std::string path = model_file(acoustic_model, name);
    check(!path.empty(), "the acoustic model ", acoustic_model.name(), " has no file ", name,
          ": expected a PocketSphinx model folder such as en-us");
    cmd_ln_set_str_r(config.get(), option.c_str(), path.c_str());
  }
  for (const auto& [option, name] : std::map<std::string, std::string>{{"-sendump", "sendump"},
                                                                       {"-mixw", "mixture_weights"},
                                                                       {"-fdict", "noisedict"},
                                                                       {"-lda", "feature_transform"},
                                                                       {"-featparams", "feat.params"},
                                                                       {"-senmgau", "senmgau"}}) {
    const std::string path = model_file(acoustic_model, name);
    if (path.empty()) continue;
    cmd_ln_set_str_r(config.get(), option.c_str(), path.c_str());
  }
  state_->decoder.reset(ps_init(config.get()));
  check(state_->decoder != nullptr, "PocketSphinx cannot load the acoustic model ", acoustic_model.name());
}

Decoder::~Decoder() = default;

void Decoder::add_word(const std::string& word, const std::string& pronunciation) {
  if (!state_->words.insert(word).second) return;
  check(ps_add_word(state_->decoder.get(), word.c_str(), pronunciation.c_str(), FALSE) >= 0,
        "the acoustic model lacks a phone of ", word, ": ", pronunciation);
}

std::vector<DecodedWord> Decoder::decode(const Grammar& grammar, std::span<const std::int16_t> samples) {
  ps_decoder_t* decoder = state_->decoder.get();
  logmath_t* log = ps_get_logmath(decoder);
  fsg_model_t* graph = fsg_model_init("align", log, 1.0F, grammar.states);
  graph->start_state = 0;
  graph->final_state = grammar.states - 1;
  bool has_nulls = false;
  for (const GrammarArc& arc : grammar.arcs) {
    const int score = logmath_log(log, arc.probability);
    if (arc.word.empty()) {
      fsg_model_null_trans_add(graph, arc.from, arc.to, score);
      has_nulls = true;
    } else {
      fsg_model_trans_add(graph, arc.from, arc.to, score, fsg_model_word_add(graph, arc.word.c_str()));
    }
  }
  for (const int state : grammar.pauses)
    fsg_model_add_silence(graph, "<sil>", state, static_cast<float32>(grammar.pause_probability));
  if (has_nulls) glist_free(fsg_model_null_trans_closure(graph, nullptr));
  const int set = ps_set_fsg(decoder, "align", graph);
  fsg_model_free(graph);
  check(set == 0 && ps_set_search(decoder, "align") == 0, "PocketSphinx refuses a word graph of ", grammar.states,
        " states");
  return run(samples);
}

std::vector<DecodedWord> Decoder::decode_phones(const engine::File* phone_model,
                                                std::span<const std::int16_t> samples) {
  if (phone_model) check_phone_model(*phone_model);
  ps_decoder_t* decoder = state_->decoder.get();
  const int set = phone_model ? ps_set_allphone_file(decoder, "phones", phone_model->path().c_str())
                              : ps_set_allphone(decoder, "phones", nullptr);
  check(set == 0 && ps_set_search(decoder, "phones") == 0, "PocketSphinx cannot recognise phones",
        phone_model ? " with the phone model " + phone_model->name() : std::string());
  return run(samples);
}

std::vector<DecodedWord> Decoder::run(std::span<const std::int16_t> samples) {
  ps_decoder_t* decoder = state_->decoder.get();
  std::vector<DecodedWord> words;
  ps_start_stream(decoder);
  check(ps_start_utt(decoder) == 0, "PocketSphinx cannot start an utterance");
  ps_process_raw(decoder, samples.data(), samples.size(), FALSE, TRUE);
  ps_end_utt(decoder);
  // Senone scores are logarithms to the decoder's base, shifted right by 10 bits (SENSCR_SHIFT of PocketSphinx's
  // hmm.h).
  const double score_unit = logmath_log_to_ln(ps_get_logmath(decoder), 1) * 1024;
  for (ps_seg_t* segment = ps_seg_iter(decoder); segment; segment = ps_seg_next(segment)) {
    DecodedWord word;
    word.word = ps_seg_word(segment);
    int last = 0;
    ps_seg_frames(segment, &word.first_frame, &last);
    word.end_frame = last + 1;
    int32 acoustic = 0, language = 0, back = 0;
    ps_seg_prob(segment, &acoustic, &language, &back);
    const int frames = word.end_frame - word.first_frame;
    if (word.word == "(NULL)" || frames <= 0) continue;
    word.score = acoustic * score_unit / frames;
    words.push_back(std::move(word));
  }
  return words;
}

}  // namespace face::speech
