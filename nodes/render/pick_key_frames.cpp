// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/pick_key_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <string_view>

namespace face::render {
namespace {

bool is_silence(const std::string& label) { return label.empty() || label == "SIL" || label == "SP" || label == "PAU"; }

// How much a phone shows, before its length and its repetitions count.
double interest_of(const std::string& label) {
  constexpr std::array<std::string_view, 7> contacts = {"P", "B", "M", "P.c", "B.c", "F", "V"};
  constexpr std::string_view vowel_letters = "AEIOU";
  if (is_silence(label)) return -10;
  if (std::find(contacts.begin(), contacts.end(), label) != contacts.end()) return 1.2;
  if (vowel_letters.find(label[0]) != std::string_view::npos) return 1.0;
  if (label == "W" || label == "SH" || label == "CH" || label == "JH" || label == "TH" || label == "DH" || label == "L")
    return 0.8;
  if (label.size() > 2 && label.ends_with(".r")) return -0.5;
  return 0.3;
}

std::size_t nearest_frame(const Timeline& timeline, double time_s) {
  const auto after = std::lower_bound(timeline.time_s.begin(), timeline.time_s.end(), time_s);
  if (after == timeline.time_s.begin()) return 0;
  const auto index = static_cast<std::size_t>(after - timeline.time_s.begin());
  if (after == timeline.time_s.end()) return index - 1;
  return *after - time_s < time_s - *(after - 1) ? index : index - 1;
}

}  // namespace

std::vector<KeyFrame> pick_key_frames(const Phones& phones, const Timeline& timeline, std::size_t count) {
  if (timeline.time_s.empty()) return {};
  std::vector<bool> taken(phones.phones.size(), false);
  std::map<std::string, int> times_picked;
  std::map<std::size_t, std::size_t> phone_of_frame;
  const bool any_sound =
      std::any_of(phones.phones.begin(), phones.phones.end(), [](const Phone& p) { return !is_silence(p.label); });
  for (;;) {
    std::size_t best = phones.phones.size();
    double best_interest = -1e9;
    for (std::size_t i = 0; i < phones.phones.size(); ++i) {
      const Phone& phone = phones.phones[i];
      if (taken[i] || (any_sound && is_silence(phone.label))) continue;
      const auto seen = times_picked.find(phone.label);
      const double interest = interest_of(phone.label) + 4 * std::min(0.25, phone.end_s - phone.start_s) -
                              0.6 * (seen == times_picked.end() ? 0 : seen->second);
      if (interest > best_interest) {
        best_interest = interest;
        best = i;
      }
    }
    if (best == phones.phones.size() || phone_of_frame.size() >= count) break;
    taken[best] = true;
    const Phone& phone = phones.phones[best];
    const std::size_t frame = nearest_frame(timeline, 0.5 * (phone.start_s + phone.end_s));
    if (phone_of_frame.try_emplace(frame, best).second) ++times_picked[phone.label];
  }
  std::vector<KeyFrame> result;
  for (const auto& [frame, phone] : phone_of_frame) result.push_back({frame, phone});
  return result;
}

}  // namespace face::render
