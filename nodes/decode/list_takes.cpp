// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/list_takes.h"

#include <algorithm>
#include <exception>
#include <set>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/read_audio.h"
#include "nodes/decode/read_text.h"

namespace face::decode {
namespace {

bool digits_only(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// What the engine takes as an id: letters, digits, '_', '-' and '.', no '.' in front, not digits-digits, and no zeros
// before a number. A letter of several bytes (UTF-8) becomes one '_'.
std::string id_of(const std::string& name) {
  std::string id;
  for (const char c : name) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' ||
                       (c == '.' && !id.empty());
    const bool goes_on = (static_cast<unsigned char>(c) & 0xC0) == 0x80;
    if (!goes_on) id += plain ? c : '_';
  }
  if (id.empty()) return "_";
  const std::size_t dash = id.find('-');
  if (dash != std::string::npos && digits_only(id.substr(0, dash)) && digits_only(id.substr(dash + 1))) id[dash] = '_';
  if (digits_only(id)) id.erase(0, std::min(id.find_first_not_of('0'), id.size() - 1));
  return id;
}

// Numbers first, by value; then names: the engine's order.
bool before(const std::string& a, const std::string& b) {
  const bool number_a = digits_only(a), number_b = digits_only(b);
  if (number_a != number_b) return number_a;
  if (number_a && a.size() != b.size()) return a.size() < b.size();
  return a < b;
}

struct Take {
  std::string id, name;
};

std::vector<Take> takes_of(const engine::File& folder) {
  std::set<std::string> names;
  for (const engine::File::Entry& entry : folder.entries())
    for (const std::string kind : {"depth/", "cloud/", "pattern/"}) {
      if (!entry.name.starts_with(kind)) continue;
      const std::size_t end = entry.name.find('/', kind.size());
      if (end != std::string::npos) names.insert(entry.name.substr(kind.size(), end - kind.size()));
    }
  check(!names.empty(), title_of(folder), ": has no files like depth/TAKE/17.png or cloud/TAKE/17.ply among its ",
        folder.entries().size());
  // Names that are ids keep them.
  std::vector<Take> takes;
  std::set<std::string> used;
  for (const bool clean : {true, false})
    for (const std::string& name : names) {
      const std::string id = id_of(name);
      if ((id == name) != clean) continue;
      std::string free = id;
      for (int n = 2; !used.insert(free).second; ++n) free = id + "_" + std::to_string(n);
      takes.push_back({free, name});
    }
  std::sort(takes.begin(), takes.end(), [](const Take& a, const Take& b) { return before(a.id, b.id); });
  return takes;
}

enum class Kind { sound, text };

// The files beside the takes, one per take: of texts those that end in .txt, of sounds all others, .wav before them.
class Partners {
 public:
  Partners(const engine::File* folder, Kind kind, const std::vector<Take>& takes, std::vector<std::string>& troubles)
      : folder_(folder), suffix_(kind == Kind::text ? ".txt" : ".wav"), troubles_(troubles) {
    for (const Take& take : takes) names_.insert(take.name);
    if (!folder) return;
    check(folder->is_folder(), title_of(*folder), ": is a file, expected a folder with a file for every take");
    for (const engine::File::Entry& entry : folder->entries()) {
      if (entry.name.find('/') != std::string::npos || entry.name.starts_with('.')) continue;
      const std::size_t dot = entry.name.find_last_of('.');
      const std::string suffix = dot == std::string::npos ? std::string() : lower(entry.name.substr(dot));
      if ((suffix == ".txt") == (kind == Kind::text))
        files_.push_back({&entry, entry.name.substr(0, dot), suffix == suffix_, false});
    }
    std::stable_sort(files_.begin(), files_.end(), [](const File& a, const File& b) { return a.usual && !b.usual; });
  }

  // Where a take has its file: by its name, or one that would have its id. Empty, and why, where it has none.
  std::string find(const Take& take, std::string& missing) {
    if (!folder_) return {};
    std::string path;
    for (File& file : files_) {
      if (file.used) continue;
      if (file.stem != take.name && (names_.contains(file.stem) || id_of(file.stem) != id_of(take.name))) continue;
      file.used = true;
      if (path.empty())
        path = file.entry->path;
      else
        troubles_.push_back(message("take ", take.name, ": ", title_of(*folder_), " has a second file for it, ",
                                    file.entry->name, "; left out"));
    }
    if (path.empty())
      missing +=
          message(missing.empty() ? "" : " and ", "has no file ", take.name, suffix_, " in ", title_of(*folder_));
    return path;
  }

  void name_the_rest() const {
    for (const File& file : files_)
      if (!file.used)
        troubles_.push_back(message(title_of(*folder_), "/", file.entry->name, " belongs to no take; left out"));
  }

 private:
  struct File {
    const engine::File::Entry* entry;
    std::string stem;
    bool usual, used;
  };
  const engine::File* folder_;
  std::string suffix_;
  std::vector<std::string>& troubles_;
  std::set<std::string> names_;
  std::vector<File> files_;
};

// What is wrong with a take's sound and text, which would stop the run where they are read; empty where nothing is.
std::string trouble_with(const std::string& sound, const std::string& text) {
  try {
    if (!sound.empty()) read_audio(engine::File::at(sound));
    if (!text.empty()) read_text(engine::File::at(text));
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

engine::File content_of(const std::string& path) {
  const engine::File file = engine::File::at(path);
  return engine::File::from_bytes(read_bytes(file), file.suffix());
}

}  // namespace

ListTakesResult list_takes(const engine::File& folder, const engine::File* sound, const engine::File* texts,
                           engine::SeqWriter<std::string>& takes, engine::SeqWriter<engine::File>& sounds,
                           engine::SeqWriter<engine::File>& scripts, engine::Progress& progress) {
  check(folder.is_folder(), title_of(folder), ": is a file, expected the folder of a recorded stream");
  std::vector<std::string> troubles;
  const std::vector<Take> found = takes_of(folder);
  Partners all_sounds(sound, Kind::sound, found, troubles), all_texts(texts, Kind::text, found, troubles);
  std::string first_trouble;
  std::size_t kept = 0;
  for (const Take& take : found) {
    std::string missing;
    const std::string its_sound = all_sounds.find(take, missing), its_text = all_texts.find(take, missing);
    std::string trouble = missing.empty() ? trouble_with(its_sound, its_text) : "it " + missing;
    if (!trouble.empty()) {
      troubles.push_back(message("take ", take.name, ": ", trouble, "; left out"));
      if (first_trouble.empty()) first_trouble = message("take ", take.name, ": ", trouble);
      continue;
    }
    if (take.id != take.name && !digits_only(take.name))
      troubles.push_back(message("take ", take.name, ": it is called ", take.id, " in what is written"));
    takes.push(take.id, take.name);
    // By content: a File on disk that a node returns becomes the store's.
    if (sound) sounds.push(take.id, content_of(its_sound));
    if (texts) scripts.push(take.id, content_of(its_text));
    ++kept;
  }
  all_sounds.name_the_rest();
  all_texts.name_the_rest();
  check(kept > 0, title_of(folder), ": none of its ", found.size(), " takes is left; ", first_trouble);
  ListTakesResult result;
  for (const std::string& trouble : troubles) {
    progress.warn(trouble);
    result.report += trouble + "\n";
  }
  return result;
}

}  // namespace face::decode
