// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>

#include "engine/port.h"
#include "tests/conformance/samples/area_samples.h"

namespace conformance {
namespace {

namespace fs = std::filesystem;

// A file or folder of a Debian package.
Maker installed(const std::string& path) {
  return [path](engine::Plugins&, int) -> Sample {
    if (!fs::exists(path)) return {};
    if (!fs::is_directory(path)) return held(engine::File::at(path));
    std::vector<engine::File::Entry> entries;
    for (const auto& entry : fs::directory_iterator(path))
      entries.push_back({entry.path().filename().string(), entry.path().string()});
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return held(engine::File::folder(path, entries));
  };
}

const std::string pocketsphinx = "/usr/share/pocketsphinx/model/en-us/";
const std::string one_installed = "Debian has one of it; tests/nodes/speech names what it takes";

const Registered speech({
    .inputs =
        {
            {"speech.read_phones.file", file_by("export.phones_json")},
            {"speech.align.acoustic_model", installed(pocketsphinx + "en-us")},
            {"speech.align.dictionary", installed(pocketsphinx + "cmudict-en-us.dict")},
            {"speech.say.dictionary", installed(pocketsphinx + "cmudict-en-us.dict")},
            {"speech.align.phone_model", installed(pocketsphinx + "en-us-phone.lm.bin")},
            {"speech.align.audio", made_by("speech.say", "audio")},
            {"speech.fit_phones.acoustic_model", installed(pocketsphinx + "en-us")},
            {"speech.fit_phones.audio", made_by("speech.say", "audio")},
            {"speech.fit_phones.phones", made_by("speech.say", "phones")},
        },
    .values = {{"speech.say.voice", {text("kal")}}},
    .shown_elsewhere =
        {
            {"speech.align.acoustic_model", one_installed},
            {"speech.align.dictionary", one_installed},
            {"speech.fit_phones.acoustic_model", one_installed},
            {"speech.say.dictionary", "it changes warnings alone; tests/nodes/speech compares them"},
        },
});

}  // namespace
}  // namespace conformance
