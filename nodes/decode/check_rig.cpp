// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/check_rig.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "nodes/base/check.h"
#include "nodes/decode/gltf_file.h"
#include "nodes/decode/gltf_rig.h"
#include "nodes/decode/ict_rig.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/rig_shapes.h"
#include "nodes/types/arkit.h"

namespace face::decode {
namespace {

// Words that riggers use for ARKit's.
const std::map<std::string, std::string>& synonyms() {
  static const std::map<std::string, std::string> words = {
      {"l", "left"},       {"r", "right"},      {"lft", "left"},       {"rgt", "right"},     {"rt", "right"},
      {"lf", "left"},      {"lip", "mouth"},    {"lips", "mouth"},     {"eyes", "eye"},      {"lid", "eye"},
      {"eyelid", "eye"},   {"brows", "brow"},   {"eyebrow", "brow"},   {"kiss", "pucker"},   {"opened", "open"},
      {"closed", "close"}, {"raise", "up"},     {"raised", "up"},      {"lowered", "down"},  {"lower", "lower"},
      {"puffed", "puff"},  {"cheeks", "cheek"}, {"sneering", "sneer"}, {"smiling", "smile"}, {"forwards", "forward"},
      {"bottom", "lower"}, {"top", "upper"},    {"sad", "frown"},      {"wink", "blink"},    {"outer", "outer"}};
  return words;
}

// "mouthSmile_L" -> mouth, smile, left
std::vector<std::string> words_of(std::string_view name) {
  while (!name.empty() && ((name.back() >= '0' && name.back() <= '9') || name.back() == '.')) name.remove_suffix(1);
  if (const std::size_t dot = name.find_last_of(".:|/"); dot != std::string_view::npos && dot + 2 < name.size())
    name.remove_prefix(dot + 1);
  std::vector<std::string> words(1);
  bool was_lower = false;
  for (const char c : name) {
    const bool upper = c >= 'A' && c <= 'Z', small = c >= 'a' && c <= 'z';
    if ((!upper && !small) || (upper && was_lower)) words.emplace_back();
    if (upper || small) words.back() += upper ? static_cast<char>(c - 'A' + 'a') : c;
    was_lower = small;
  }
  std::erase(words, "");
  for (std::string& word : words)
    if (const auto same = synonyms().find(word); same != synonyms().end()) word = same->second;
  return words;
}

// The words that both have, as a share of all that either has.
double likeness(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  const std::set<std::string> x(a.begin(), a.end()), y(b.begin(), b.end());
  std::set<std::string> all = x;
  all.insert(y.begin(), y.end());
  std::size_t shared = 0;
  for (const std::string& word : x) shared += y.count(word);
  return all.empty() ? 0 : static_cast<double>(shared) / static_cast<double>(all.size());
}

// What a file holds, before it is asked whether that can speak.
struct Contents {
  std::vector<std::string> names;  // of its shapes, each once, in its order
  std::size_t textures = 0;
  bool targets = false;    // its shapes are morph targets: they can be there and move nothing
  std::optional<Rig> rig;  // none where it cannot be read,
  std::string why_none;    // and why
};

void read_rig_into(Contents& contents, const std::function<Rig()>& read) {
  try {
    contents.rig = read();
  } catch (const Error& error) {
    contents.why_none = error.what();
  }
}

// Throws where not even names can be read.
Contents contents_of(const engine::File& file, const ShapeNames& given) {
  Contents contents;
  const auto add = [&](const std::string& name) {
    if (std::find(contents.names.begin(), contents.names.end(), name) == contents.names.end())
      contents.names.push_back(name);
  };
  if (file.is_folder() && is_obj_rig(file)) {
    const std::string neutral = obj_rig_neutral(file).name;
    for (const engine::File::Entry& entry : file.entries()) {
      const std::string leaf = entry.name.substr(entry.name.find_last_of('/') + 1);
      if (entry.name != neutral && leaf.ends_with(".obj") && !leaf.starts_with("identity"))
        add(leaf.substr(0, leaf.size() - 4));
    }
    read_rig_into(contents, [&] { return read_obj_rig(file, given, LengthUnit::automatic); });
    return contents;
  }
  const engine::File main = gltf_main_file(file);
  const tinygltf::Model model = load_gltf(file, main);
  contents.textures = model.images.size();
  contents.targets = true;
  for (const tinygltf::Mesh& mesh : model.meshes)
    for (const tinygltf::Primitive& primitive : mesh.primitives)
      for (std::size_t t = 0; t < primitive.targets.size(); ++t) add(gltf_target_name(model, mesh, primitive, t));
  read_rig_into(contents, [&] { return rig_of_gltf(model, title_of(main), given, LengthUnit::automatic); });
  return contents;
}

// Those of ARKit's shapes that a file has as empty targets.
std::vector<std::string> still_shapes(const Contents& contents, const std::set<std::string>& known) {
  std::vector<std::string> still;
  if (!contents.targets || !contents.rig) return still;
  for (std::size_t s = 0; s < arkit_count; ++s) {
    const Shape& shape = contents.rig->shapes[s];
    if (shape.vertices.empty() && known.contains(shape.name)) still.push_back(shape.name);
  }
  return still;
}

// Why the head cannot speak, without what was found in it; "" where it can.
std::string why_unfit(const std::string& title, const Contents& contents) {
  std::string why = contents.why_none;
  try {
    if (contents.rig) expect_speech(title, *contents.rig);
  } catch (const Error& error) {
    why = error.what();
  }
  return why.substr(0, why.find(". Found "));
}

// The shape that stands for jawOpen in sets of visemes (Oculus, VRM, VRoid); "" without one.
std::string opener_of(const std::vector<std::string>& names) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"viseme", "aa"}, {"mouth", "open"}, {"fcl", "mth", "a"}, {"mth", "a"}, {"a"}, {"aa"}})
    for (const std::string& name : names)
      if (words_of(name) == words) return name;
  return "";
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// What is wrong with how the head stands, by what its jaw does: a head that lies, or looks away, is shown so by every
// camera. "" where it stands.
std::string why_not_upright(const Rig& rig) {
  const Shape& jaw = rig.shapes[arkit_index("jawOpen")];
  Vec3f way = {0, 0, 0};
  double front = 0, middle = 0;
  for (std::size_t i = 0; i < jaw.vertices.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) way[c] += jaw.offsets_mm[i][c];
    front += static_cast<double>(rig.neutral.points_mm[jaw.vertices[i]][2]) / static_cast<double>(jaw.vertices.size());
  }
  for (const Vec3f& p : rig.neutral.points_mm)
    middle += static_cast<double>(p[2]) / static_cast<double>(rig.neutral.points_mm.size());
  const float length = std::hypot(way[0], way[1], way[2]);
  if (length > 0 && -way[1] < 0.5f * length)
    return "jawOpen does not move the jaw down: is y up in the file? Turn the head there, so that it stands and looks "
           "to +z";
  if (length > 0 && front < middle - 10)
    return "what jawOpen moves lies behind the middle of the head: does it look to -z? Turn it round in the file";
  return "";
}

// Across, upwards and from front to back, mm.
Vec3f extent_of(const Rig& rig) {
  const std::vector<Vec3f>& points = rig.neutral.points_mm;
  Vec3f low = points.empty() ? Vec3f{} : points[0], high = low;
  for (const Vec3f& p : points)
    for (std::size_t c = 0; c < 3; ++c) low[c] = std::min(low[c], p[c]), high[c] = std::max(high[c], p[c]);
  return {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
}

// Closures and contacts are judged in mm.
std::string why_too_small(const Rig& rig) {
  constexpr float least_mm = 60;  // a narrow child's face alone
  const float wide_mm = extent_of(rig)[0];
  if (wide_mm >= least_mm) return "";
  return message("it is ", std::lround(wide_mm), " mm wide, expected at least ", std::lround(least_mm),
                 ": scale it in the file, or set decode.rig's unit");
}

std::string about(const Rig& rig) {
  const Vec3f extent = extent_of(rig);
  std::string text = message(rig.neutral.points_mm.size(), " vertices, ", rig.neutral.polygon_count(), " polygons; ",
                             std::lround(extent[0]), " mm wide, ", std::lround(extent[1]), " mm high, ",
                             std::lround(extent[2]), " mm deep: where that is wrong, set decode.rig's unit\n");
  text += rig.inner_lips.empty() ? "the lips were not found: jawOpen does not part them; closures cannot be judged\n"
                                 : message("lips: ", rig.inner_lips.size(), " pairs of vertices that meet\n");
  text += rig.upper_teeth.empty()
              ? "no upper teeth were found: name a mesh or a material \"teeth\" where there are some\n"
              : "upper teeth were found\n";
  if (rig.landmarks68.size() != 68)
    text += "its 68 landmarks are not known: for points of a video they are found by its shapes, to a few mm\n";
  return text;
}

}  // namespace

std::string guess_arkit(std::string_view name, const std::vector<std::string>& candidates) {
  constexpr double enough = 0.5;  // half of all words
  const std::vector<std::string> words = words_of(name);
  // What has one of ARKit's names at its end, such as "Wolf_Head_jawOpen", is that shape.
  std::string best;
  std::size_t most = 0;
  for (const std::string& candidate : candidates) {
    const std::vector<std::string> end = words_of(candidate);
    if (end.size() <= most || words.size() < end.size() || !std::equal(end.rbegin(), end.rend(), words.rbegin()))
      continue;
    best = candidate;
    most = end.size();
  }
  if (most > 0) return best;
  double best_likeness = 0;
  bool twice = false;
  for (const std::string& candidate : candidates) {
    const double here = likeness(words, words_of(candidate));
    if (here > best_likeness) {
      best = candidate;
      best_likeness = here;
      twice = false;
    } else if (here == best_likeness) {
      twice = true;
    }
  }
  return best_likeness >= enough && !twice ? best : std::string();
}

CheckRigResult check_rig(const engine::File& file, const engine::File* names) {
  CheckRigResult result;
  const std::string title = title_of(file);
  nlohmann::ordered_json proposed = nlohmann::ordered_json::object();
  const auto finish = [&] {
    result.names = engine::File::from_bytes(proposed.dump(2) + "\n", ".json");
    return result;
  };
  ShapeNames given;
  Contents contents;
  try {
    if (names) given = read_shape_names(*names);
    contents = contents_of(file, given);
  } catch (const Error& error) {
    result.text = std::string(error.what()) + "\n";
    return finish();
  }
  std::set<std::string> known;
  std::vector<std::string> strange;
  for (const std::string& name : contents.names) {
    const std::string arkit = given.in_rig(name);
    if (arkit_index(arkit) < arkit_count)
      known.insert(arkit);
    else
      strange.push_back(name);
  }
  std::vector<std::string> lacking;
  for (const std::string_view name : arkit_names)
    if (!known.contains(std::string(name))) lacking.emplace_back(name);
  result.text = message(title, ": ", contents.names.size(), " shapes; ", known.size(), " of ARKit's ", arkit_count,
                        " are there\n");
  if (!lacking.empty() && !contents.names.empty()) result.text += "lacks " + listed(lacking) + "\n";
  const std::vector<std::string> still = still_shapes(contents, known);
  if (!still.empty()) result.text += "there, but move nothing: " + listed(still) + "\n";
  for (const auto& [name, arkit] : given.to_arkit) proposed[name] = arkit;
  std::size_t guesses = 0, blanks = 0;
  std::vector<std::string> left = lacking;
  left.insert(left.end(), still.begin(), still.end());
  const std::string opener = opener_of(strange);
  for (const std::string& name : strange) {
    const bool opens = name == opener && std::find(left.begin(), left.end(), "jawOpen") != left.end();
    const std::string guess = opens ? "jawOpen" : guess_arkit(name, left);
    proposed[name] = guess;
    if (!guess.empty()) {
      std::erase(left, guess);
      result.text += message("names.json proposes ", guess, " for \"", name, "\"\n");
    }
    ++(guess.empty() ? blanks : guesses);
  }
  if (std::any_of(strange.begin(), strange.end(), [](const std::string& name) { return name.ends_with("(unnamed)"); }))
    result.text +=
        "shapes without names were written without extras.targetNames: export it anew with names, or fill in which is "
        "which\n";
  if (!strange.empty())
    result.text += message(strange.size(), strange.size() == 1 ? " name is" : " names are",
                           " none of ARKit's: names.json proposes ", guesses, " and leaves ", blanks,
                           " empty (those stay shapes of the rig's own); look it over, fill it in, and give it with "
                           "--set names=names.json\n");
  if (const std::string unfit = why_unfit(title, contents); !unfit.empty()) {
    result.text += "as it is it cannot be used: " + unfit + "\n";
    return finish();
  }
  result.text += about(*contents.rig);
  if (contents.textures > 0)
    result.text +=
        contents.rig->neutral.colors_srgb.empty()
            ? "its textures stay in a GLB that is made of it; pictures and films cannot show them (PNG, JPEG "
              "and WebP can be read)\n"
            : "its textures stay in a GLB that is made of it; pictures and films show their colours at the "
              "vertices\n";
  std::string why = why_not_upright(*contents.rig);
  if (why.empty()) why = why_too_small(*contents.rig);
  result.sound = why.empty();
  result.text += result.sound ? "it can be used as it is\n" : "as it is it cannot be used: " + why + "\n";
  return finish();
}

}  // namespace face::decode
