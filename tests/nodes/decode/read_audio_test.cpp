// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_audio.h"

#include <sndfile.h>

#include <algorithm>
#include <cmath>

#include "tests/nodes/decode/temporary.h"
#include "tests/support/data.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::decode;

namespace {

constexpr double tone_hz = 440, tone_level = 0.5;

// Half a second of a tone in every channel that `sounds` has, silence in the others.
void write_tone(const std::string& path, int format, int rate_hz, const std::vector<bool>& sounds,
                double level = tone_level, double seconds = 0.5) {
  SF_INFO info{};
  info.samplerate = rate_hz;
  info.channels = static_cast<int>(sounds.size());
  info.format = format;
  SNDFILE* out = sf_open(path.c_str(), SFM_WRITE, &info);
  ASSERT_NE(out, nullptr) << sf_strerror(nullptr);
  std::vector<float> samples;
  const int frames = static_cast<int>(seconds * rate_hz);
  for (int i = 0; i < frames; ++i)
    for (const bool sounding : sounds)
      samples.push_back(sounding ? static_cast<float>(level * std::sin(2 * M_PI * tone_hz * i / rate_hz)) : 0.0f);
  sf_writef_float(out, samples.data(), frames);
  sf_close(out);
}

// Largest difference to the tone, away from the ends where the filter has no neighbours.
double tone_error(const Audio& audio, double level = tone_level) {
  double worst = 0;
  for (std::size_t i = 400; i + 400 < audio.samples.size(); ++i)
    worst = std::max(worst, std::abs(static_cast<double>(audio.samples[i]) -
                                     level * std::sin(2 * M_PI * tone_hz * static_cast<double>(i) / audio.rate_hz)));
  return worst;
}

ReadAudioResult read(const std::string& path) { return read_audio(engine::File::at(path)); }

struct Kind {
  const char* name;
  int format;
  double error;  // the quantisation step, and the filter's ripple
};
const Kind kinds[] = {
    {"u8", SF_FORMAT_WAV | SF_FORMAT_PCM_U8, 0.012},    {"s16", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 2e-3},
    {"s24", SF_FORMAT_WAV | SF_FORMAT_PCM_24, 2e-3},    {"s32", SF_FORMAT_WAV | SF_FORMAT_PCM_32, 2e-3},
    {"float", SF_FORMAT_WAV | SF_FORMAT_FLOAT, 2e-3},   {"double", SF_FORMAT_WAV | SF_FORMAT_DOUBLE, 2e-3},
    {"ulaw", SF_FORMAT_WAV | SF_FORMAT_ULAW, 0.02},     {"aiff", SF_FORMAT_AIFF | SF_FORMAT_PCM_16, 2e-3},
    {"flac", SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 2e-3},  {"ogg", SF_FORMAT_OGG | SF_FORMAT_VORBIS, 0.03},
    {"wavex", SF_FORMAT_WAVEX | SF_FORMAT_PCM_24, 2e-3}};

}  // namespace

TEST(ReadAudio, ReadsEveryDepthAndRateToTheSameTone) {
  const test::Temporary temporary;
  for (const Kind& kind : kinds)
    for (const int rate_hz : {8000, 11025, 16000, 22050, 44100, 48000, 96000}) {
      const std::string path = temporary.path(std::string(kind.name) + std::to_string(rate_hz));
      write_tone(path, kind.format, rate_hz, {true});
      const ReadAudioResult result = read(path);
      EXPECT_EQ(result.audio.rate_hz, 16000);
      EXPECT_NEAR(static_cast<double>(result.audio.samples.size()), 8000, 1) << path;
      EXPECT_LE(tone_error(result.audio), kind.error) << path;
      EXPECT_EQ(result.source_rate_hz, rate_hz);
      EXPECT_FALSE(result.silent);
    }
}

TEST(ReadAudio, AveragesChannelsAndLeavesSilentOnesOut) {
  const test::Temporary temporary;
  const std::vector<std::vector<bool>> layouts = {
      {true, true}, {true, false}, {false, false, true, false, false, false}, {true, true, true, true, true, true}};
  for (const auto& sounds : layouts) {
    const std::string path = temporary.path("c" + std::to_string(sounds.size()) + ".wav");
    write_tone(path, SF_FORMAT_WAV | SF_FORMAT_PCM_16, 44100, sounds);
    const ReadAudioResult result = read(path);
    EXPECT_LE(tone_error(result.audio), 2e-3);
    EXPECT_EQ(result.source_channels, static_cast<double>(sounds.size()));
  }
}

TEST(ReadAudio, RemovesWhatTheNewRateCannotHold) {
  const test::Temporary temporary;
  const std::string path = temporary.path("high.wav");
  std::vector<float> samples;
  for (int i = 0; i < 48000; ++i) samples.push_back(static_cast<float>(0.5 * std::sin(2 * M_PI * 10000 * i / 48000.0)));
  SF_INFO info{};
  info.samplerate = 48000, info.channels = 1, info.format = SF_FORMAT_WAV | SF_FORMAT_FLOAT;
  SNDFILE* out = sf_open(path.c_str(), SFM_WRITE, &info);
  sf_writef_float(out, samples.data(), 48000);
  sf_close(out);
  const ReadAudioResult result = read(path);
  double power = 0;
  for (std::size_t i = 400; i < 15600; ++i) power += std::pow(static_cast<double>(result.audio.samples[i]), 2);
  EXPECT_LE(std::sqrt(power / 15200), 0.5 * 1e-3);  // -60 dB
}

TEST(ReadAudio, ScalesFloatsAboveFullScaleDown) {
  const test::Temporary temporary;
  const std::string path = temporary.path("loud.wav");
  write_tone(path, SF_FORMAT_WAV | SF_FORMAT_FLOAT, 16000, {true}, 4.0);
  EXPECT_LE(tone_error(read(path).audio, 1.0), 0.01);
}

TEST(ReadAudio, GivesTheRateThatIsAskedFor) {
  const test::Temporary temporary;
  const std::string path = temporary.path("a.wav");
  write_tone(path, SF_FORMAT_WAV | SF_FORMAT_PCM_16, 16000, {true});
  const ReadAudioResult result = read_audio(engine::File::at(path), {.rate_hz = 44100});
  EXPECT_EQ(result.audio.rate_hz, 44100);
  EXPECT_EQ(result.audio.samples.size(), 22050u);
  EXPECT_LE(tone_error(result.audio), 2e-3);
}

TEST(ReadAudio, MarksSilenceAndDoesNotRefuseIt) {
  const test::Temporary temporary;
  const std::string path = temporary.path("silent.wav");
  write_tone(path, SF_FORMAT_WAV | SF_FORMAT_PCM_16, 16000, {false, false});
  const ReadAudioResult result = read(path);
  EXPECT_TRUE(result.silent);
  EXPECT_EQ(result.audio.samples.size(), 8000u);
}

TEST(ReadAudio, ReadsAFileOfOpenEndedLength) {
  const test::Temporary temporary;
  const std::string path = temporary.path("pipe.wav");
  write_tone(path, SF_FORMAT_WAV | SF_FORMAT_PCM_16, 16000, {true});
  std::string bytes = test::bytes_of(path);
  for (const std::size_t at : {std::size_t{4}, std::size_t{40}}) bytes.replace(at, 4, "\xFF\xFF\xFF\xFF");
  EXPECT_EQ(read(temporary.write("pipe.wav", bytes)).audio.samples.size(), 8000u);
}

TEST(ReadAudio, ReadsTheSoundOfAVideoFile) {
  DATA_FILE(path, "grid/bbaf2n.mpg");
  const ReadAudioResult result = read(path);
  EXPECT_EQ(result.source_rate_hz, 44100);
  EXPECT_NEAR(result.audio.duration_s(), 2.977, 0.03);  // MP2 frames of 26 ms
  EXPECT_FALSE(result.silent);
}

TEST(ReadAudio, ReadsARecordingSampleBySample) {
  DATA_FILE(path, "librivox/0870.wav");
  const ReadAudioResult result = read(path);
  EXPECT_EQ(result.audio.samples.size(), 113600u);
}

TEST(ReadAudio, RejectsAMissingAndAnEmptyFile) {
  EXPECT_THROW_TEXT(read("/nowhere/line.wav"), "line.wav: cannot be opened: No such file or directory");
  const test::Temporary temporary;
  EXPECT_THROW_TEXT(read(temporary.write("line.wav", "")), "line.wav: is empty (0 bytes), expected a recording");
  write_tone(temporary.path("none.wav"), SF_FORMAT_WAV | SF_FORMAT_PCM_16, 16000, {true}, 0.5, 0);
  EXPECT_THROW_TEXT(read(temporary.path("none.wav")), "none.wav: holds no samples, expected a recording");
}

TEST(ReadAudio, RejectsATruncatedWav) {
  const test::Temporary temporary;
  write_tone(temporary.path("whole.wav"), SF_FORMAT_WAV | SF_FORMAT_PCM_16, 16000, {true});
  const std::string half = test::bytes_of(temporary.path("whole.wav")).substr(0, 8000);
  EXPECT_THROW_TEXT(read(temporary.write("half.wav", half)),
                    "half.wav: is truncated: found 7956 bytes of samples from byte 44, its header promises 16000");
}

TEST(ReadAudio, RejectsATruncatedFlac) {
  const test::Temporary temporary;
  write_tone(temporary.path("whole.flac"), SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 16000, {true});
  const std::string whole = test::bytes_of(temporary.path("whole.flac"));
  const std::string path = temporary.write("half.flac", whole.substr(0, whole.size() / 2));
  std::string text = "nothing thrown";
  try {
    read(path);
  } catch (const std::exception& error) {
    text = error.what();
  }
  EXPECT_TRUE(text.starts_with("half.flac: ")) << text;
}

TEST(ReadAudio, RejectsWhatIsNoRecordingAndSaysWhatWouldServe) {
  const test::Temporary temporary;
  EXPECT_THROW_TEXT(
      read(temporary.write("line.wav", "This is a text, not a recording.")),
      "line.wav: cannot be read: Invalid data found when processing input; expected a recording (WAV, AIFF, "
      "FLAC, Ogg, MP3, M4A, or a video file with sound)");
}

TEST(ReadAudio, RejectsSamplesThatAreNotNumbers) {
  const test::Temporary temporary;
  SF_INFO info{};
  info.samplerate = 16000, info.channels = 1, info.format = SF_FORMAT_WAV | SF_FORMAT_FLOAT;
  SNDFILE* out = sf_open(temporary.path("nan.wav").c_str(), SFM_WRITE, &info);
  const float samples[] = {0, 0.5f, INFINITY, 0};
  sf_writef_float(out, samples, 4);
  sf_close(out);
  EXPECT_THROW_TEXT(read(temporary.path("nan.wav")), "nan.wav: found inf at sample 2, expected finite samples");
}
