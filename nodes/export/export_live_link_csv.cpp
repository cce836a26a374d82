// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_live_link_csv.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "nodes/base/check.h"
#include "nodes/export/csv.h"
#include "nodes/export/timed_frames.h"
#include "nodes/types/arkit.h"

namespace face::exports {
namespace {

constexpr std::array<std::string_view, 9> angle_names = {"HeadYaw",     "HeadPitch",     "HeadRoll",
                                                         "LeftEyeYaw",  "LeftEyePitch",  "LeftEyeRoll",
                                                         "RightEyeYaw", "RightEyePitch", "RightEyeRoll"};

std::string header() {
  std::string line = "Timecode,BlendShapeCount";
  for (const std::string_view name : arkit_names) {
    line += ',';
    line += static_cast<char>(name[0] - 'a' + 'A');  // Live Link spells EyeBlinkLeft what ARKit spells eyeBlinkLeft
    line += name.substr(1);
  }
  for (const std::string_view name : angle_names) (line += ',') += name;
  return line + "\n";
}

void append_padded(std::string& out, std::int64_t value, std::size_t digits) {
  const std::string text = std::to_string(value);
  if (text.size() < digits) out.append(digits - text.size(), '0');
  out += text;
}

void append_timecode(std::string& out, double time_s, int rate_hz) {
  const std::int64_t thousandths = std::llround(time_s * rate_hz * 1000.0);
  const std::int64_t frame = thousandths / 1000, second = frame / rate_hz;
  append_padded(out, second / 3600, 2);
  out += ':';
  append_padded(out, second / 60 % 60, 2);
  out += ':';
  append_padded(out, second % 60, 2);
  out += ':';
  append_padded(out, frame % rate_hz, 2);
  out += '.';
  append_padded(out, thousandths % 1000, 3);
}

}  // namespace

engine::File export_live_link_csv(const engine::Seq<Weights>& frames, const Timeline& timeline,
                                  const ExportLiveLinkCsvOptions& options) {
  check_frames(frames.size(), timeline);
  check(options.timecode_rate_hz > 0, "timecode_rate_hz is ", options.timecode_rate_hz, ", expected more than 0");
  std::string text = header();
  std::size_t index = 0;
  for (const Weights& weights : frames) {
    append_timecode(text, timeline.time_s[index], options.timecode_rate_hz);
    text += ",61";
    for (std::size_t s = 0; s < arkit_count; ++s) {
      const float weight = s < weights.values.size() ? weights.values[s] : 0.0f;
      check(std::isfinite(weight), "weight ", arkit_names[s], " of frame ", frames.id(index),
            " is not a finite number");
      text += ',';
      append_fixed(text, weight, 6);
    }
    for (std::size_t i = 0; i < angle_names.size(); ++i) text += ",0.000000";
    text += '\n';
    ++index;
  }
  return engine::File::from_bytes(std::move(text), ".csv");
}

}  // namespace face::exports
