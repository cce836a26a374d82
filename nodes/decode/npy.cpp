// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/npy.h"

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/decode/input_file.h"

namespace face::decode {
namespace {

struct Header {
  std::string type;  // "<f8"
  bool fortran_order = false;
  std::vector<std::size_t> shape;
};

// Reads the header, a Python dictionary: {'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), }.
class HeaderReader {
 public:
  HeaderReader(std::string_view text, std::size_t start, const std::string& title)
      : text_(text), start_(start), title_(title) {}

  Header read() {
    Header header;
    bool has_type = false, has_order = false, has_shape = false;
    take('{');
    while (!next_is('}')) {
      const std::string key = quoted();
      take(':');
      if (key == "descr") {
        header.type = quoted();
        has_type = true;
      } else if (key == "fortran_order") {
        header.fortran_order = boolean();
        has_order = true;
      } else if (key == "shape") {
        header.shape = shape();
        has_shape = true;
      } else {
        fail_here("'descr', 'fortran_order' or 'shape'");
      }
      if (!next_is(',')) break;
      take(',');
    }
    take('}');
    if (!has_type || !has_order || !has_shape) fail_here("'descr', 'fortran_order' and 'shape'");
    return header;
  }

 private:
  [[noreturn]] void fail_here(const std::string& expected) const {
    fail(title_, " byte ", start_ + at_, ": found \"", text_.substr(at_, 16), "\", expected ", expected,
         " in the header of a NumPy array");
  }
  void skip() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
  }
  bool next_is(char c) {
    skip();
    return at_ < text_.size() && text_[at_] == c;
  }
  void take(char c) {
    if (!next_is(c)) fail_here(std::string(1, c));
    ++at_;
  }
  std::string quoted() {
    if (!next_is('\'') && !next_is('"')) {
      if (next_is('[')) fail_here("one type of number (this array has named columns)");
      fail_here("a quoted word");
    }
    const std::size_t end = text_.find(text_[at_], at_ + 1);
    if (end == std::string_view::npos) fail_here("a quoted word");
    const std::string word(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return word;
  }
  bool boolean() {
    skip();
    for (const auto& [word, value] : {std::pair{std::string_view("True"), true}, {"False", false}})
      if (text_.substr(at_).starts_with(word)) {
        at_ += word.size();
        return value;
      }
    fail_here("True or False");
  }
  std::vector<std::size_t> shape() {
    std::vector<std::size_t> sizes;
    take('(');
    while (!next_is(')')) {
      skip();
      std::size_t value = 0, digits = 0;
      for (; at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9' && digits < 15; ++at_, ++digits)
        value = value * 10 + static_cast<std::size_t>(text_[at_] - '0');
      if (digits == 0) fail_here("a length");
      sizes.push_back(value);
      if (!next_is(',')) break;
      take(',');
    }
    take(')');
    return sizes;
  }

  std::string_view text_;
  std::size_t start_, at_ = 0;
  const std::string& title_;
};

template <class T>
double number_at(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

struct Type {
  const char* name;
  std::size_t size;
  double (*read)(const char*);
};
constexpr Type types[] = {{"<f8", 8, &number_at<double>},        {"<f4", 4, &number_at<float>},
                          {"<i8", 8, &number_at<std::int64_t>},  {"<i4", 4, &number_at<std::int32_t>},
                          {"<u4", 4, &number_at<std::uint32_t>}, {"|u1", 1, &number_at<std::uint8_t>},
                          {"|b1", 1, &number_at<std::uint8_t>}};

}  // namespace

Matrix npy(const engine::File& file) {
  const std::string title = title_of(file), bytes = read_bytes(file);
  constexpr std::string_view magic("\x93NUMPY", 6);
  check(bytes.size() >= 10 && bytes.starts_with(magic), title, ": found no NumPy array, expected it to start with ",
        "\"\\x93NUMPY\" (as numpy.save writes it)");
  const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<std::uint8_t>(bytes[i])); };
  const std::size_t version = byte(6), prefix = version == 1 ? 10 : 12;
  check(version >= 1 && version <= 3 && bytes.size() >= prefix, title, " byte 6: found version ", version,
        " of the NumPy format, expected 1, 2 or 3");
  std::size_t length = byte(8) | byte(9) << 8;
  if (version > 1) length |= byte(10) << 16 | byte(11) << 24;
  check(length <= bytes.size() - prefix, title, " byte 8: found a header of ", length, " bytes in a file of ",
        bytes.size());
  const Header header = HeaderReader(std::string_view(bytes).substr(prefix, length), prefix, title).read();

  const Type* type = nullptr;
  for (const Type& known : types)
    if (header.type == known.name) type = &known;
  if (type == nullptr)
    fail(title, ": found numbers of type '", header.type,
         "', expected '<f8', '<f4', '<i8', '<i4', '<u4', '|u1' or '|b1' (little endian; numpy.save(file, "
         "array.astype('<f8')) makes one)");

  std::size_t count = 1;
  for (const std::size_t size : header.shape) {
    check(size == 0 || count <= std::numeric_limits<std::size_t>::max() / 16 / size, title, ": is too large");
    count *= size;
  }
  const std::size_t data = prefix + length;
  check(bytes.size() - data == count * type->size, title, ": found ", bytes.size() - data,
        " bytes of numbers, expected ", count, " x ", type->size, " = ", count * type->size);

  Matrix matrix;
  matrix.rows = header.shape.empty() ? 1 : header.shape[0];
  matrix.columns = 1;
  for (std::size_t i = 1; i < header.shape.size(); ++i) matrix.columns *= header.shape[i];
  matrix.values.resize(count);
  std::vector<std::size_t> index(header.shape.size());
  for (std::size_t i = 0; i < count; ++i) {
    // Where the i-th number of the file goes: in Fortran order the first index runs fastest.
    std::size_t place = i;
    if (header.fortran_order) {
      place = 0;
      for (std::size_t d = 0; d < index.size(); ++d) place = place * header.shape[d] + index[d];
      for (std::size_t d = 0; d < index.size() && ++index[d] == header.shape[d]; ++d) index[d] = 0;
    }
    matrix.values[place] = type->read(&bytes[data + i * type->size]);
  }
  if (header.type == "<i8")
    for (std::size_t i = 0; i < count; ++i) {
      constexpr double largest = 9007199254740992.0;  // 2^53: whole numbers up to here are doubles
      check(matrix.values[i] >= -largest && matrix.values[i] <= largest, title, ": found ", matrix.values[i],
            " as number ", i, ", expected at most 2^53 in size");
    }
  return matrix;
}

}  // namespace face::decode
