// SPDX-License-Identifier: Apache-2.0
// One small, valid value of every value type, for tests that call nodes without knowing them.
#pragma once
#include <map>
#include <memory>
#include <string>

namespace test {

// The sample of a value type ("mesh"); each variant differs from the others. Null where the type has none: then it
// gets one in samples.cpp. Frames are 64 x 48 pixels, meshes and rigs have one topology of 525 vertices, sequences that
// are made of samples have the four frames of the timeline's.
std::shared_ptr<const void> sample(const std::string& type, int variant);

// A file with these bytes below the test's own temporary folder, as the value of a "file" port.
std::shared_ptr<const void> sample_file(const std::string& name, const std::string& bytes);

// A folder there with these files, by relative path.
std::shared_ptr<const void> sample_folder(const std::string& name, const std::map<std::string, std::string>& files);

}  // namespace test
