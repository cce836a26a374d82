// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/gltf_file.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/decode/glb.h"
#include "nodes/decode/gltf_compression.h"
#include "nodes/decode/input_file.h"

namespace face::decode {
namespace {

// Lets tinygltf read what the node was given, and nothing else.
tinygltf::FsCallbacks callbacks_for(const engine::File& file) {
  tinygltf::FsCallbacks callbacks{};
  callbacks.user_data = const_cast<engine::File*>(&file);
  callbacks.FileExists = [](const std::string& name, void* user) {
    return !static_cast<const engine::File*>(user)->find(name).empty();
  };
  callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string* error, const std::string& name,
                               void* user) {
    try {
      const std::string path = static_cast<const engine::File*>(user)->find(name);
      if (path.empty()) return false;
      const std::string bytes = read_bytes_at(path, name);
      out->assign(bytes.begin(), bytes.end());
      return true;
    } catch (const Error& failure) {
      if (error) *error += failure.what();
      return false;
    }
  };
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  return callbacks;
}

std::vector<const engine::File::Entry*> gltf_entries(const engine::File& folder) {
  std::vector<const engine::File::Entry*> found;
  for (const engine::File::Entry& entry : folder.entries())
    if (lower(entry.name).ends_with(".glb") || lower(entry.name).ends_with(".gltf")) found.push_back(&entry);
  return found;
}

}  // namespace

std::optional<engine::File> find_gltf(const engine::File& file) {
  if (!file.is_folder()) return file;
  const std::vector<const engine::File::Entry*> found = gltf_entries(file);
  if (found.size() != 1) return std::nullopt;
  return engine::File::at(found.front()->path);
}

engine::File gltf_main_file(const engine::File& file) {
  if (const std::optional<engine::File> found = find_gltf(file)) return *found;
  fail(title_of(file), ": is not a rig: found ", file.entries().size(), " files, of which ", gltf_entries(file).size(),
       " are GLB or glTF; expected an ICT-FaceKit folder (generic_neutral_mesh.obj or neutral.obj, and one OBJ file "
       "per shape) or one "
       "glTF file with its buffers");
}

tinygltf::Model load_gltf(const engine::File& given, const engine::File& main) {
  const std::string title = title_of(main);
  std::string bytes = read_bytes(main);
  check(!bytes.empty(), title, ": is empty (0 bytes), expected a GLB or glTF file");
  bool binary = bytes.starts_with("glTF");
  const std::size_t text = bytes.find_first_not_of(" \t\r\n");
  if (!binary && (text == std::string::npos || (bytes[text] != '{' && !bytes.starts_with("\xEF\xBB\xBF"))))
    fail(title,
         ": is not a rig: found neither \"glTF\" nor JSON at byte 0, expected an ICT-FaceKit folder, or a GLB or glTF "
         "file with morph targets");
  if (binary && bytes.size() >= 12) {
    std::uint32_t stated = 0;  // glTF 2.0, section 4.4.2: the file's length, little endian
    for (std::size_t i = 12; i-- > 8;) stated = stated << 8 | static_cast<std::uint8_t>(bytes[i]);
    if (stated > bytes.size())
      fail(title, ": is truncated: found ", bytes.size(), " bytes, its header promises ", stated);
  }
  if (mentions_compression(bytes)) {
    nlohmann::json document;
    std::string buffer;
    if (read_glb(given, document, buffer)) {
      bytes = glb_bytes(std::move(document), std::move(buffer));
      binary = true;
    }
  }
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(callbacks_for(given));
  // Pictures are kept as they are in the file; gltf_looks.h reads those that it needs.
  loader.SetImageLoader(
      [](tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* encoded,
         int size, void*) {
        image->image.assign(encoded, encoded + size);
        return true;
      },
      nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const auto size = static_cast<unsigned>(bytes.size());
  const bool read = binary ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                                         reinterpret_cast<const unsigned char*>(bytes.data()), size)
                           : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, "");
  std::replace(error.begin(), error.end(), '\n', ' ');
  while (!error.empty() && error.back() == ' ') error.pop_back();
  if (!read && !given.is_folder() && !binary && error.find("not found") != std::string::npos)
    fail(title, ": its buffers lie in files beside it: give the folder that holds them all, or export one .glb (",
         error, ")");
  if (!read) fail(title, ": cannot be read as glTF: ", error.empty() ? "it is damaged" : error);
  return model;
}

std::string gltf_target_name(const tinygltf::Model& model, const tinygltf::Mesh& mesh,
                             const tinygltf::Primitive& primitive, std::size_t index) {
  for (const tinygltf::Value* extras : {&mesh.extras, &primitive.extras}) {
    if (!extras->IsObject() || !extras->Has("targetNames")) continue;
    const tinygltf::Value& names = extras->Get("targetNames");
    if (names.IsArray() && index < names.ArrayLen() && names.Get(static_cast<int>(index)).IsString())
      return names.Get(static_cast<int>(index)).Get<std::string>();
  }
  if (index < primitive.targets.size())
    if (const auto position = primitive.targets[index].find("POSITION"); position != primitive.targets[index].end()) {
      const auto accessor = static_cast<std::size_t>(std::max(position->second, 0));
      if (accessor < model.accessors.size() && !model.accessors[accessor].name.empty())
        return model.accessors[accessor].name;
    }
  return message("target ", index, " (unnamed)");
}

}  // namespace face::decode
