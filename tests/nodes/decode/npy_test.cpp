// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/npy.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/expect_throw_text.h"

using face::Matrix;
using face::decode::npy;

namespace {

template <class T>
std::string numbers(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

// As numpy.save writes it.
std::string array(const std::string& type, const std::string& shape, const std::string& data, bool fortran = false,
                  char version = 1) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") +
                       ", 'shape': " + shape + ", }          \n";
  std::string bytes = std::string("\x93NUMPY", 6) + version + std::string(1, '\0');
  bytes += static_cast<char>(header.size());
  bytes += std::string(version == 1 ? 1 : 3, '\0');
  return bytes + header + data;
}

Matrix read(const std::string& bytes) { return npy(engine::File::from_bytes(bytes, ".npy")); }

void expect_matrix(const Matrix& found, std::size_t rows, std::size_t columns, const std::vector<double>& values) {
  EXPECT_EQ(found.rows, rows);
  EXPECT_EQ(found.columns, columns);
  EXPECT_EQ(found.values, values);
}

}  // namespace

TEST(Npy, ReadsEveryTypeOfNumber) {
  const std::vector<double> values = {0, 1, 2, 3, 4, 250};
  expect_matrix(read(array("<f8", "(2, 3)", numbers<double>({0, 1, 2, 3, 4, 250}))), 2, 3, values);
  expect_matrix(read(array("<f4", "(2, 3)", numbers<float>({0, 1, 2, 3, 4, 250}))), 2, 3, values);
  expect_matrix(read(array("<i8", "(2, 3)", numbers<std::int64_t>({0, 1, 2, 3, 4, 250}))), 2, 3, values);
  expect_matrix(read(array("<i4", "(2, 3)", numbers<std::int32_t>({0, 1, 2, 3, 4, 250}))), 2, 3, values);
  expect_matrix(read(array("<u4", "(2, 3)", numbers<std::uint32_t>({0, 1, 2, 3, 4, 250}))), 2, 3, values);
  expect_matrix(read(array("|u1", "(2, 3)", numbers<std::uint8_t>({0, 1, 2, 3, 4, 250}))), 2, 3, values);
  expect_matrix(read(array("|b1", "(1, 2)", numbers<std::uint8_t>({0, 1}))), 1, 2, {0, 1});
  expect_matrix(read(array("<i4", "(1, 2)", numbers<std::int32_t>({-5, -2147483647}))), 1, 2, {-5, -2147483647});
}

TEST(Npy, PutsFortranOrderRight) {
  expect_matrix(read(array("<f8", "(2, 3)", numbers<double>({1, 4, 2, 5, 3, 6}), true)), 2, 3, {1, 2, 3, 4, 5, 6});
  expect_matrix(read(array("|u1", "(2, 2, 2)", numbers<std::uint8_t>({0, 4, 2, 6, 1, 5, 3, 7}), true)), 2, 4,
                {0, 1, 2, 3, 4, 5, 6, 7});
}

TEST(Npy, MakesAMatrixOfAnyShape) {
  expect_matrix(read(array("|u1", "()", "\x07")), 1, 1, {7});
  expect_matrix(read(array("|u1", "(3,)", "\x01\x02\x03")), 3, 1, {1, 2, 3});
  expect_matrix(read(array("|u1", "(2, 1, 2)", "\x01\x02\x03\x04")), 2, 2, {1, 2, 3, 4});
  expect_matrix(read(array("<f8", "(0, 5)", "")), 0, 5, {});
}

TEST(Npy, ReadsTheLaterVersions) {
  expect_matrix(read(array("|u1", "(1, 2)", "\x01\x02", false, 2)), 1, 2, {1, 2});
  expect_matrix(read(array("|u1", "(1, 2)", "\x01\x02", false, 3)), 1, 2, {1, 2});
}

TEST(Npy, RejectsWhatIsNoArray) {
  EXPECT_THROW_TEXT(
      read("x,y\n1,2\n3,4\n"),
      "the data: found no NumPy array, expected it to start with \"\\x93NUMPY\" (as numpy.save writes it)");
  EXPECT_THROW_TEXT(read(array("|u1", "(1, 2)", "\x01\x02", false, 4)),
                    "the data byte 6: found version 4 of the NumPy format, expected 1, 2 or 3");
  EXPECT_THROW_TEXT(read(std::string("\x93NUMPY\x01\x00\xFF\x00{", 11)),
                    "the data byte 8: found a header of 255 bytes in a file of 11");
}

TEST(Npy, RejectsOtherTypesOfNumber) {
  EXPECT_THROW_TEXT(
      read(array(">f8", "(1,)", numbers<double>({1}))),
      "the data: found numbers of type '>f8', expected '<f8', '<f4', '<i8', '<i4', '<u4', '|u1' or '|b1' (little "
      "endian; numpy.save(file, array.astype('<f8')) makes one)");
  EXPECT_THROW_TEXT(read(array("<i8", "(1,)", numbers<std::int64_t>({(1ll << 60) + 1}))),
                    "the data: found 1.15292e+18 as number 0, expected at most 2^53 in size");
  std::string columns = array("<f8", "(1,)", numbers<double>({1}));
  columns.replace(columns.find("'<f8'"), 5, "[('x'");
  EXPECT_THROW_TEXT(read(columns),
                    "the data byte 20: found \"[('x', 'fortran_\", expected one type of number (this array has named "
                    "columns) in the header of a NumPy array");
}

TEST(Npy, RejectsAFileThatIsCutOffOrGoesOn) {
  EXPECT_THROW_TEXT(read(array("<f8", "(3, 2)", std::string(40, '\0'))),
                    "the data: found 40 bytes of numbers, expected 6 x 8 = 48");
  EXPECT_THROW_TEXT(read(array("<f4", "(3, 2)", std::string(25, '\0'))),
                    "the data: found 25 bytes of numbers, expected 6 x 4 = 24");
  EXPECT_THROW_TEXT(read(array("<f4", "(3, x)", "")),
                    "the data byte 64: found \"x), }          \n\", expected a length in the header of a NumPy array");
}
