// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_video.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

#include "tests/support/expect_throw_text.h"

namespace face::exports {
namespace {

class Warnings final : public engine::Progress {
 public:
  void warn(const std::string& text) override { texts.push_back(text); }
  std::vector<std::string> texts;
};

// A grey picture whose brightness tells its number.
Image picture(int number, int width = 64, int height = 48) {
  return {width, height, 3,
          std::vector<std::uint8_t>(static_cast<std::size_t>(width * height * 3),
                                    static_cast<std::uint8_t>(20 + number * 2))};
}

engine::Seq<Image> pictures(int count, int width = 64, int height = 48) {
  std::vector<Image> list;
  for (int i = 0; i < count; ++i) list.push_back(picture(i, width, height));
  return engine::Seq<Image>(std::move(list));
}

Timeline regular(int count, double rate_hz) {
  Timeline timeline;
  for (int i = 0; i < count; ++i) timeline.time_s.push_back(i / rate_hz);
  timeline.duration_s = count / rate_hz;
  return timeline;
}

Audio tone(double duration_s, double rate_hz = 16000) {
  Audio audio{rate_hz, {}};
  for (int i = 0; i < static_cast<int>(std::lround(duration_s * rate_hz)); ++i)
    audio.samples.push_back(0.5f * std::sin(static_cast<float>(i) * 0.17f));
  return audio;
}

// What a player finds in the file.
struct Found {
  int width = 0, height = 0;
  std::vector<double> times_s;         // of pictures
  std::vector<int> brightness;         // of their middle
  std::array<int, 3> yuv = {0, 0, 0};  // of the last one's middle
  double video_s = 0, audio_s = 0;
  std::int64_t audio_samples = 0;
};

Found read_back(const std::string& bytes) {
  Found found;
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".mp4");
  std::ofstream(path, std::ios::binary) << bytes;
  AVFormatContext* format = nullptr;
  EXPECT_EQ(avformat_open_input(&format, path.c_str(), nullptr, nullptr), 0);
  EXPECT_GE(avformat_find_stream_info(format, nullptr), 0);
  std::vector<AVCodecContext*> codecs;
  for (unsigned i = 0; i < format->nb_streams; ++i) {
    const AVStream* stream = format->streams[i];
    AVCodecContext* codec = avcodec_alloc_context3(avcodec_find_decoder(stream->codecpar->codec_id));
    avcodec_parameters_to_context(codec, stream->codecpar);
    codec->pkt_timebase = stream->time_base;
    EXPECT_EQ(avcodec_open2(codec, nullptr, nullptr), 0);
    codecs.push_back(codec);
    const double duration_s = static_cast<double>(stream->duration) * av_q2d(stream->time_base);
    (codec->codec_type == AVMEDIA_TYPE_VIDEO ? found.video_s : found.audio_s) = duration_s;
  }
  AVPacket* packet = av_packet_alloc();
  AVFrame* frame = av_frame_alloc();
  const auto drain = [&](AVCodecContext* codec, const AVStream* stream, const AVPacket* sent) {
    EXPECT_EQ(avcodec_send_packet(codec, sent), 0);
    while (avcodec_receive_frame(codec, frame) == 0) {
      if (codec->codec_type == AVMEDIA_TYPE_AUDIO) {
        found.audio_samples += frame->nb_samples;
        continue;
      }
      found.width = frame->width;
      found.height = frame->height;
      found.times_s.push_back(static_cast<double>(frame->best_effort_timestamp) * av_q2d(stream->time_base));
      found.brightness.push_back(frame->data[0][frame->height / 2 * frame->linesize[0] + frame->width / 2]);
      for (std::size_t plane = 0; plane < 3; ++plane) {
        const int shrink = plane == 0 ? 2 : 4;
        found.yuv[plane] = frame->data[plane][frame->height / shrink * frame->linesize[plane] + frame->width / shrink];
      }
    }
  };
  while (av_read_frame(format, packet) == 0) {
    drain(codecs[static_cast<std::size_t>(packet->stream_index)], format->streams[packet->stream_index], packet);
    av_packet_unref(packet);
  }
  for (std::size_t i = 0; i < codecs.size(); ++i) drain(codecs[i], format->streams[i], nullptr);
  for (AVCodecContext*& codec : codecs) avcodec_free_context(&codec);
  av_packet_free(&packet);
  av_frame_free(&frame);
  avformat_close_input(&format);
  std::filesystem::remove(path);
  return found;
}

engine::File written(const engine::Seq<Image>& frames, const Timeline& timeline, const Audio* audio) {
  engine::Progress progress;
  return export_video(frames, timeline, audio, {}, progress);
}

TEST(ExportVideo, ShowsEveryPictureAtItsTime) {
  const engine::File file = written(pictures(50), regular(50, 25), nullptr);
  EXPECT_EQ(file.suffix(), ".mp4");
  const Found found = read_back(file.bytes());
  ASSERT_EQ(found.times_s.size(), 50u);
  for (std::size_t i = 0; i < 50; ++i) EXPECT_NEAR(found.times_s[i], static_cast<double>(i) / 25, 1e-4);
  // 8-bit grey g is 16 + g * 219 / 255 in the video's range; the encoder may lose two steps.
  for (std::size_t i = 0; i < 50; ++i)
    EXPECT_NEAR(found.brightness[i], 16 + (20 + 2.0 * static_cast<double>(i)) * 219 / 255, 2);
  EXPECT_NEAR(found.video_s, 2, 1e-3);
}

TEST(ExportVideo, HoldsSoundAsLongAsThePictures) {
  // 59.94 frames per second and a length that is no multiple of an AAC frame.
  const double rate_hz = 60000.0 / 1001;
  const Timeline timeline = regular(100, rate_hz);
  const Audio audio = tone(timeline.duration_s);
  const Found found = read_back(written(pictures(100), timeline, &audio).bytes());
  EXPECT_EQ(found.times_s.size(), 100u);
  EXPECT_NEAR(found.video_s, timeline.duration_s, 1e-3);
  EXPECT_NEAR(found.audio_s, found.video_s, 1 / rate_hz);
  // A decoder gives the last AAC frame whole; players cut it by the length above.
  EXPECT_GE(found.audio_samples, std::llround(timeline.duration_s * 16000));
  EXPECT_LT(found.audio_samples, std::llround(timeline.duration_s * 16000) + 1024);
}

TEST(ExportVideo, CutsOrFillsUpSoundOfAnotherLengthAndSaysSo) {
  for (const double sound_s : {0.5, 3.0}) {
    Warnings progress;
    const Audio audio = tone(sound_s, 44100);
    const Found found = read_back(export_video(pictures(50), regular(50, 25), &audio, {}, progress).bytes());
    EXPECT_NEAR(found.audio_s, 2, 0.04);
    ASSERT_EQ(progress.texts.size(), 1u);
    EXPECT_EQ(progress.texts[0], sound_s < 2
                                     ? "the sound lasts 0.5 s and the pictures 2 s: it was filled up with silence"
                                     : "the sound lasts 3 s and the pictures 2 s: it was cut");
  }
}

TEST(ExportVideo, KeepsColours) {
  // ITU-R BT.709, studio range: Y = 16 + 219 (0.2126 R + 0.7152 G + 0.0722 B), Cb = 128 + 224 (B - Y') / 1.8556,
  // Cr = 128 + 224 (R - Y') / 1.5748.
  Image orange = picture(0);
  for (std::size_t i = 0; i < orange.pixels.size(); i += 3) {
    orange.pixels[i] = 230;
    orange.pixels[i + 1] = 120;
    orange.pixels[i + 2] = 40;
  }
  const Found found = read_back(written(engine::Seq<Image>({orange}), regular(1, 25), nullptr).bytes());
  const double r = 230 / 255.0, g = 120 / 255.0, b = 40 / 255.0, y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
  EXPECT_NEAR(found.yuv[0], 16 + 219 * y, 2);
  EXPECT_NEAR(found.yuv[1], 128 + 224 * (b - y) / 1.8556, 2);
  EXPECT_NEAR(found.yuv[2], 128 + 224 * (r - y) / 1.5748, 2);
}

TEST(ExportVideo, KeepsIrregularTimes) {
  Timeline timeline{{0, 0.1, 0.15, 0.4}, 0.5};
  const Found found = read_back(written(pictures(4), timeline, nullptr).bytes());
  ASSERT_EQ(found.times_s.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(found.times_s[i], timeline.time_s[i], 1e-4);
  EXPECT_NEAR(found.video_s, 0.5, 1e-3);
}

TEST(ExportVideo, GrowsOddSizesToEvenOnes) {
  const Found found = read_back(written(pictures(3, 33, 21), regular(3, 25), nullptr).bytes());
  EXPECT_EQ(found.width, 34);
  EXPECT_EQ(found.height, 22);
}

TEST(ExportVideo, GivesTheSameBytesTwice) {
  const Audio audio = tone(1);
  EXPECT_EQ(written(pictures(25), regular(25, 25), &audio).bytes(),
            written(pictures(25), regular(25, 25), &audio).bytes());
}

TEST(ExportVideo, GivesTheSameBytesWhateverTheMemoryHeldBefore) {
  // A pattern that moves: only then has the encoder something to choose.
  std::vector<Image> moving;
  for (int i = 0; i < 40; ++i) {
    Image image = picture(0, 160, 64);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const double wave = std::sin(0.3 * (x + i)) * std::cos(0.2 * y + 0.05 * i) + 0.5 * std::sin(0.07 * x * y);
        for (int c = 0; c < 3; ++c)
          image.pixels[static_cast<std::size_t>((y * image.width + x) * 3 + c)] =
              static_cast<std::uint8_t>(std::lround(128 + 60 * wave));
      }
    moving.push_back(std::move(image));
  }
  const engine::Seq<Image> frames(std::move(moving));
  const std::string expected = written(frames, regular(40, 40), nullptr).bytes();
  std::atomic<int> others{0};
  const auto write_often = [&](std::uint32_t seed) {
    for (int round = 0; round < 40; ++round) {
      std::vector<std::vector<char>> used;
      for (int i = 0; i < 200; ++i) {
        seed = seed * 1664525u + 1013904223u;
        used.emplace_back((seed >> 8) % 900000, static_cast<char>(seed >> 3));
        if ((seed >> 20) % 2 == 1) used.erase(used.begin() + static_cast<std::ptrdiff_t>((seed >> 5) % used.size()));
      }
      used.clear();
      if (written(frames, regular(40, 40), nullptr).bytes() != expected) ++others;
    }
  };
  std::vector<std::thread> threads;
  for (std::uint32_t i = 1; i <= 6; ++i) threads.emplace_back(write_often, i);
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(others, 0) << "of 240";
}

TEST(ExportVideo, WritesTheSameBytesToTheScratchFolder) {
  class Folder final : public engine::Progress {
   public:
    std::string scratch_folder() override { return path; }
    std::string path = testing::TempDir() + "export_video_test";
  } progress;
  std::filesystem::create_directories(progress.path);
  const Audio sound = tone(1.0);
  engine::Progress nowhere;
  const engine::File in_memory = export_video(pictures(30), regular(30, 30), &sound, {}, nowhere);
  const engine::File on_disk = export_video(pictures(30), regular(30, 30), &sound, {}, progress);
  ASSERT_FALSE(on_disk.in_memory());
  EXPECT_EQ(on_disk.suffix(), ".mp4");
  std::ifstream file(on_disk.path(), std::ios::binary);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), in_memory.bytes());
  std::filesystem::remove_all(progress.path);
}

TEST(ExportVideo, WritesASinglePicture) {
  const Audio audio = tone(0.04);
  const Found found = read_back(written(pictures(1), regular(1, 25), &audio).bytes());
  EXPECT_EQ(found.times_s.size(), 1u);
  EXPECT_NEAR(found.video_s, 0.04, 1e-3);
}

TEST(ExportVideo, RejectsWhatDoesNotFitTogether) {
  EXPECT_THROW_TEXT(written({}, {}, nullptr), "there are no frames to export");
  EXPECT_THROW_TEXT(written(pictures(3), regular(4, 25), nullptr), "there are 3 frames, but the timeline has 4 times");
  const engine::Seq<Image> unequal({picture(0), picture(1, 32, 48)}, {"16", "17"});
  EXPECT_THROW_TEXT(written(unequal, regular(2, 25), nullptr), "frame 17 is 32 x 48 x 3, but frame 16 is 64 x 48 x 3");
  Image torn = picture(0);
  torn.pixels.pop_back();
  EXPECT_THROW_TEXT(written(engine::Seq<Image>({torn}), regular(1, 25), nullptr),
                    "frame 0 has 9215 bytes, expected 9216 for 64 x 48 x 3");
  const Audio odd{12345, std::vector<float>(12345)};
  EXPECT_THROW_TEXT(written(pictures(25), regular(25, 25), &odd),
                    "the sound has 12345 samples per second, which AAC cannot hold (16000, 44100 and 48000 are usual)");
}

}  // namespace
}  // namespace face::exports
