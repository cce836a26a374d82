// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/mp4_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <deque>
#include <vector>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/channel_layout.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include "nodes/base/check.h"

namespace face::exports {
namespace {

// Divides the common rates (24, 25, 30, 48, 50, 60 and 1000/1001 of them) without rest.
constexpr int ticks_per_s = 120000;

void require(int code, const char* what) {
  if (code >= 0) return;
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  fail("the video could not be written: ", what, " failed: ", text.data());
}

template <class T>
T* required(T* pointer, const char* what) {
  check(pointer != nullptr, "the video could not be written: ", what);
  return pointer;
}

// The file, as FFmpeg writes and seeks in it: bytes in memory, or on disk where a path is given (ten minutes without
// loss are gigabytes).
struct OpenFile {
  std::string bytes;
  std::int64_t position = 0;
  std::FILE* disk = nullptr;

  OpenFile() = default;
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() { close(); }

  void open(const std::string& path) {
    disk = std::fopen(path.c_str(), "wb");
    check(disk != nullptr, "the video could not be written: cannot open ", path);
  }
  bool close() {
    const bool good = disk == nullptr || std::fclose(disk) == 0;
    disk = nullptr;
    return good;
  }

  static int write(void* opaque, std::uint8_t* data, int size) {
    auto& file = *static_cast<OpenFile*>(opaque);
    const auto count = static_cast<std::size_t>(size);
    if (file.disk != nullptr) return std::fwrite(data, 1, count, file.disk) == count ? size : AVERROR(EIO);
    const auto end = static_cast<std::size_t>(file.position) + count;
    if (file.bytes.size() < end) file.bytes.resize(end);
    std::memcpy(file.bytes.data() + file.position, data, count);
    file.position += size;
    return size;
  }
  static std::int64_t seek(void* opaque, std::int64_t offset, int whence) {
    auto& file = *static_cast<OpenFile*>(opaque);
    if (file.disk != nullptr) {
      if (whence == AVSEEK_SIZE) return AVERROR(ENOSYS);
      return ::fseeko(file.disk, offset, whence) == 0 ? ::ftello(file.disk) : AVERROR(EIO);
    }
    const auto size = static_cast<std::int64_t>(file.bytes.size());
    if (whence == AVSEEK_SIZE) return size;
    file.position = whence == SEEK_CUR ? file.position + offset : whence == SEEK_END ? size + offset : offset;
    return file.position;
  }
};

}  // namespace

struct Mp4Writer::State {
  Settings settings;
  OpenFile file;
  AVFormatContext* format = nullptr;
  AVCodecContext* video = nullptr;
  AVCodecContext* audio = nullptr;
  SwsContext* convert = nullptr;
  AVFrame* picture = nullptr;
  AVFrame* sound = nullptr;
  AVPacket* packet = nullptr;
  std::deque<std::int64_t> durations;  // of the pictures that the encoder holds
  std::vector<float> pending;          // sound that does not fill a frame yet
  std::int64_t samples_sent = 0;
  std::vector<std::uint8_t> even;  // a picture grown to even size, and bytes beyond its end

  ~State() {
    sws_freeContext(convert);
    av_frame_free(&picture);
    av_frame_free(&sound);
    av_packet_free(&packet);
    avcodec_free_context(&video);
    avcodec_free_context(&audio);
    if (format != nullptr && format->pb != nullptr) {
      av_freep(&format->pb->buffer);
      avio_context_free(&format->pb);
    }
    avformat_free_context(format);
  }

  void open_format() {
    if (!settings.path.empty()) file.open(settings.path);
    require(avformat_alloc_output_context2(&format, nullptr, "mp4", nullptr), "opening the MP4 writer");
    constexpr int buffer_size = 1 << 16;
    auto* buffer = static_cast<unsigned char*>(av_malloc(buffer_size));
    format->pb = required(avio_alloc_context(buffer, buffer_size, 1, &file, nullptr, &OpenFile::write, &OpenFile::seek),
                          "out of memory");
    format->flags |= AVFMT_FLAG_BITEXACT | AVFMT_FLAG_CUSTOM_IO;
  }

  AVCodecContext* open_codec(const AVCodec* codec, AVDictionary** options,
                             void (*set_up)(AVCodecContext&, const Settings&)) {
    AVCodecContext* context = required(avcodec_alloc_context3(codec), "out of memory");
    (context->codec_type == AVMEDIA_TYPE_VIDEO ? video : audio) = context;
    context->flags |= AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_GLOBAL_HEADER;
    context->thread_count = 1;
    context->log_level_offset = 64;  // statistics belong to nobody's terminal
    set_up(*context, settings);
    require(avcodec_open2(context, codec, options), "opening an encoder");
    AVStream* stream = required(avformat_new_stream(format, nullptr), "out of memory");
    stream->time_base = context->time_base;
    require(avcodec_parameters_from_context(stream->codecpar, context), "describing a stream");
    return context;
  }

  void open_video() {
    const AVCodec* codec = avcodec_find_encoder_by_name("libx264");
    check(codec != nullptr, "the video could not be written: this FFmpeg has no H.264 encoder (libx264)");
    AVDictionary* options = nullptr;
    av_dict_set(&options, "preset", "veryfast", 0);
    av_dict_set_int(&options, "crf", settings.quality, 0);
    // The same bytes from every processor, and every time: x264's AVX-512 routine of the macroblock tree reads memory
    // that nobody has written.
    av_dict_set(&options, "x264-params", "cpu-independent=1", 0);
    open_codec(codec, &options, [](AVCodecContext& context, const Settings& s) {
      context.width = (s.width_px + 1) / 2 * 2;
      context.height = (s.height_px + 1) / 2 * 2;
      context.pix_fmt = AV_PIX_FMT_YUV420P;
      context.time_base = {1, ticks_per_s};
      context.framerate = av_d2q(s.mean_rate_hz, 100000);
      context.gop_size = static_cast<int>(std::clamp(s.mean_rate_hz * 2, 1.0, 600.0));
      context.max_b_frames = 0;  // decoding order = display order: no shift at the start
      context.color_range = AVCOL_RANGE_MPEG;
      context.colorspace = AVCOL_SPC_BT709;
      context.color_primaries = AVCOL_PRI_BT709;
      context.color_trc = AVCOL_TRC_IEC61966_2_1;
    });
    av_dict_free(&options);
    picture = required(av_frame_alloc(), "out of memory");
    picture->width = video->width;
    picture->height = video->height;
    picture->format = video->pix_fmt;
    require(av_frame_get_buffer(picture, 0), "allocating a picture");
    const AVPixelFormat source = settings.channels == 1   ? AV_PIX_FMT_GRAY8
                                 : settings.channels == 4 ? AV_PIX_FMT_RGBA
                                                          : AV_PIX_FMT_RGB24;
    convert = required(
        sws_getContext(video->width, video->height, source, video->width, video->height, video->pix_fmt,
                       SWS_BICUBIC | SWS_ACCURATE_RND | SWS_BITEXACT | SWS_FULL_CHR_H_INP, nullptr, nullptr, nullptr),
        "its pictures cannot be converted to YUV");
    const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
    sws_setColorspaceDetails(convert, bt709, 1, bt709, 0, 0, 1 << 16, 1 << 16);
  }

  void open_audio() {
    const AVCodec* codec = avcodec_find_encoder(AV_CODEC_ID_AAC);
    check(codec != nullptr, "the video could not be written: this FFmpeg has no AAC encoder");
    bool supported = codec->supported_samplerates == nullptr;
    for (const int* rate = codec->supported_samplerates; rate != nullptr && *rate != 0; ++rate)
      supported = supported || *rate == settings.audio_rate_hz;
    check(supported, "the sound has ", settings.audio_rate_hz,
          " samples per second, which AAC cannot hold (16000, 44100 and ", "48000 are usual)");
    open_codec(codec, nullptr, [](AVCodecContext& context, const Settings& s) {
      context.sample_fmt = AV_SAMPLE_FMT_FLTP;
      context.sample_rate = s.audio_rate_hz;
      context.bit_rate = s.audio_kbit_per_s * 1000;
      context.time_base = {1, s.audio_rate_hz};
      av_channel_layout_default(&context.ch_layout, 1);
    });
    sound = required(av_frame_alloc(), "out of memory");
    sound->format = audio->sample_fmt;
    sound->sample_rate = audio->sample_rate;
    sound->nb_samples = audio->frame_size;
    require(av_channel_layout_copy(&sound->ch_layout, &audio->ch_layout), "allocating sound");
    require(av_frame_get_buffer(sound, 0), "allocating sound");
  }

  // frame null: the end.
  void encode(AVCodecContext* codec, const AVFrame* frame) {
    require(avcodec_send_frame(codec, frame), "encoding");
    const int index = codec == video ? 0 : 1;
    for (;;) {
      const int code = avcodec_receive_packet(codec, packet);
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
      require(code, "encoding");
      packet->stream_index = index;
      if (codec == video && !durations.empty()) {
        packet->duration = durations.front();
        durations.pop_front();
      }
      av_packet_rescale_ts(packet, codec->time_base, format->streams[index]->time_base);
      require(av_interleaved_write_frame(format, packet), "writing");
    }
  }

  void send_sound(const float* samples, int count) {
    require(av_frame_make_writable(sound), "allocating sound");
    sound->nb_samples = count;
    std::copy(samples, samples + count, reinterpret_cast<float*>(sound->data[0]));
    sound->pts = samples_sent;
    samples_sent += count;
    encode(audio, sound);
  }

  // A copy of the picture, its last column and row repeated up to an even size.
  const std::uint8_t* grown(const Image& image) {
    constexpr std::size_t beyond = 64;  // swscale reads whole vectors, past the end of the last row
    const int width = picture->width, height = picture->height;
    const auto channels = static_cast<std::size_t>(image.channels);
    even.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels + beyond);
    if (width == image.width && height == image.height) {
      std::copy(image.pixels.begin(), image.pixels.end(), even.begin());
      return even.data();
    }
    std::uint8_t* out = even.data();
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x, out += channels) {
        const auto row = static_cast<std::size_t>(std::min(y, image.height - 1));
        const auto column = static_cast<std::size_t>(std::min(x, image.width - 1));
        std::memcpy(out, &image.pixels[(row * static_cast<std::size_t>(image.width) + column) * channels], channels);
      }
    return even.data();
  }
};

Mp4Writer::Mp4Writer(const Settings& settings) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.settings = settings;
  s.packet = required(av_packet_alloc(), "out of memory");
  s.open_format();
  s.open_video();
  if (settings.audio_rate_hz > 0) s.open_audio();
  require(avformat_write_header(s.format, nullptr), "writing the header");
}

Mp4Writer::~Mp4Writer() = default;

void Mp4Writer::add_picture(const Image& image, double start_s, double end_s) {
  State& s = *state_;
  require(av_frame_make_writable(s.picture), "allocating a picture");
  const std::uint8_t* rows[1] = {s.grown(image)};
  const int stride[1] = {s.picture->width * image.channels};
  sws_scale(s.convert, rows, stride, 0, s.picture->height, s.picture->data, s.picture->linesize);
  s.picture->pts = std::llround(start_s * ticks_per_s);
  s.durations.push_back(std::llround(end_s * ticks_per_s) - s.picture->pts);
  s.encode(s.video, s.picture);
}

void Mp4Writer::add_sound(const float* samples, std::int64_t count) {
  State& s = *state_;
  s.pending.insert(s.pending.end(), samples, samples + count);
  const auto size = static_cast<std::size_t>(s.audio->frame_size);
  std::size_t used = 0;
  for (; s.pending.size() - used >= size; used += size) s.send_sound(s.pending.data() + used, s.audio->frame_size);
  s.pending.erase(s.pending.begin(), s.pending.begin() + static_cast<std::ptrdiff_t>(used));
}

std::string Mp4Writer::finish() {
  State& s = *state_;
  s.encode(s.video, nullptr);
  if (s.audio != nullptr) {
    if (!s.pending.empty()) s.send_sound(s.pending.data(), static_cast<int>(s.pending.size()));
    s.encode(s.audio, nullptr);
  }
  require(av_write_trailer(s.format), "writing the index");
  avio_flush(s.format->pb);
  require(s.format->pb->error, "writing");
  check(s.file.close(), "the video could not be written: closing ", s.settings.path, " failed");
  return std::move(s.file.bytes);
}

}  // namespace face::exports
