// SPDX-License-Identifier: Apache-2.0
// Ready-made morphable models as other programs save them: archives of eos, and NumPy's arrays in a ZIP.
#pragma once
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace test {

template <class T>
std::string raw(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

// By columns, as Eigen keeps it.
inline std::string eos_matrix(std::int32_t rows, std::int32_t columns, const std::vector<float>& values) {
  std::string bytes = raw(rows) + raw(columns);
  for (const float value : values) bytes += raw(value);
  return bytes;
}

inline std::string eos_triples(const std::vector<std::int32_t>& indices) {
  std::string bytes = raw(std::uint64_t{indices.size() / 3});
  for (const std::int32_t index : indices) bytes += raw(index);
  return bytes;
}

inline std::string eos_text(const std::string& text) { return raw(std::uint64_t{text.size()}) + text; }

// A triangle's four components: mean, basis (3V x K), eigenvalues, triangles.
inline std::string eos_pca(const std::vector<float>& mean, const std::vector<float>& basis,
                           const std::vector<float>& eigenvalues, const std::vector<std::int32_t>& triangles) {
  const auto rows = static_cast<std::int32_t>(mean.size()), columns = static_cast<std::int32_t>(eigenvalues.size());
  return eos_matrix(rows, 1, mean) + eos_matrix(columns == 0 ? 0 : rows, columns, basis) +
         eos_matrix(columns, 1, eigenvalues) + eos_triples(triangles);
}

inline std::string eos_blend_shapes(const std::vector<std::pair<std::string, std::vector<float>>>& shapes) {
  std::string bytes = raw(std::uint64_t{shapes.size()});
  for (const auto& [name, offsets] : shapes)
    bytes += eos_text(name) + eos_matrix(static_cast<std::int32_t>(offsets.size()), 1, offsets);
  return bytes;
}

// An array as numpy.save writes it.
inline std::string npy(const std::string& type, const std::string& shape, const std::string& data) {
  const std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }\n";
  return std::string("\x93NUMPY\x01\x00", 8) + raw(static_cast<std::uint16_t>(header.size())) + header + data;
}

inline std::string npy(const std::string& shape, const std::vector<double>& values) {
  std::string data;
  for (const double value : values) data += raw(value);
  return npy("<f8", shape, data);
}

// A ZIP archive; deflated where asked for.
inline std::string zip(const std::map<std::string, std::string>& files, bool deflated = false) {
  std::string bytes, list;
  for (const auto& [name, content] : files) {
    std::string packed = content;
    if (deflated) {
      packed.resize(content.size() + 64);
      z_stream stream{};
      deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 9, Z_DEFAULT_STRATEGY);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
      stream.avail_in = static_cast<uInt>(content.size());
      stream.next_out = reinterpret_cast<Bytef*>(packed.data());
      stream.avail_out = static_cast<uInt>(packed.size());
      deflate(&stream, Z_FINISH);
      packed.resize(stream.total_out);
      deflateEnd(&stream);
    }
    const auto u16 = [](std::size_t value) { return raw(static_cast<std::uint16_t>(value)); };
    const auto u32 = [](std::size_t value) { return raw(static_cast<std::uint32_t>(value)); };
    const std::string about = u16(20) + u16(0) + u16(deflated ? 8 : 0) + u16(0) + u16(0) +
                              u32(crc32_z(0, reinterpret_cast<const Bytef*>(content.data()), content.size())) +
                              u32(packed.size()) + u32(content.size()) + u16(name.size()) + u16(0);
    list += "PK\x01\x02" + u16(20) + about + u16(0) + u16(0) + u16(0) + u32(0) + u32(bytes.size()) + name;
    bytes += "PK\x03\x04" + about + name + packed;
  }
  const auto count = static_cast<std::uint16_t>(files.size());
  const auto start = static_cast<std::uint32_t>(bytes.size()), size = static_cast<std::uint32_t>(list.size());
  return bytes + list + "PK\x05\x06" + raw(std::uint32_t{0}) + raw(count) + raw(count) + raw(size) + raw(start) +
         raw(std::uint16_t{0});
}

// A quadrilateral 160 mm wide and 200 mm high in metres, like FLAME: two components of the person, one expression.
inline std::map<std::string, std::string> flame_arrays() {
  return {{"v_template.npy", npy("(4, 3)", {-0.08, -0.1, 0, 0.08, -0.1, 0, 0.08, 0.1, 0, -0.08, 0.1, 0})},
          {"f.npy", npy("<u4", "(2, 3)", raw(0u) + raw(1u) + raw(2u) + raw(0u) + raw(2u) + raw(3u))},
          {"shapedirs.npy", npy("(4, 3, 3)", {0.001, 0, 0,     0, 0.002, 0, 0, 0, 0.003,  //
                                              0.001, 0, 0,     0, 0.002, 0, 0, 0, 0.003,  //
                                              0.001, 0, 0,     0, 0.002, 0, 0, 0, 0.003,  //
                                              0,     0, 0.004, 0, 0,     0, 0, 0, 0})}};
}

}  // namespace test
