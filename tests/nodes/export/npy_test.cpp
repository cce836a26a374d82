// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/npy.h"

#include <gtest/gtest.h>

#include "nodes/decode/npy.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using exports::npy;
using exports::NpyNumbers;
using exports::NpyShape;

namespace {

const Matrix sample{2, 6, {0, -1, 2, 3.5, 4, 5, 6, 7, 8, 9, 1e300, 11}};

std::string header_of(const engine::File& file) { return file.bytes().substr(10, file.bytes().find('\n') - 10); }

}  // namespace

TEST(Npy, IsReadBackBitForBit) {
  const engine::File file = npy(sample);
  EXPECT_EQ(file.suffix(), ".npy");
  const Matrix back = decode::npy(file);
  EXPECT_EQ(back.rows, 2u);
  EXPECT_EQ(back.columns, 6u);
  EXPECT_EQ(back.values, sample.values);
}

TEST(Npy, StartsItsNumbersAtAMultipleOf64Bytes) {
  for (std::size_t columns = 1; columns < 2000; columns *= 7) {
    const engine::File file = npy({1, columns, std::vector<double>(columns, 1.0)});
    EXPECT_EQ((file.bytes().size() - 8 * columns) % 64, 0u);
    EXPECT_EQ(decode::npy(file).columns, columns);
  }
}

TEST(Npy, WritesListsIntegersAndPoints) {
  EXPECT_TRUE(header_of(npy(sample)).starts_with("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 6), }"));
  EXPECT_TRUE(header_of(npy({3, 1, {1, 2, 3}}, {NpyNumbers::integer, NpyShape::vector}))
                  .starts_with("{'descr': '<i8', 'fortran_order': False, 'shape': (3,), }"));
  EXPECT_TRUE(header_of(npy(sample, {NpyNumbers::real, NpyShape::points}))
                  .starts_with("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2, 3), }"));
  EXPECT_TRUE(header_of(npy({1, 6, {1, 2, 3, 4, 5, 6}}, {NpyNumbers::real, NpyShape::points}))
                  .starts_with("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }"));
  EXPECT_EQ(decode::npy(npy({2, 1, {-3, 9007199254740992.0}}, {NpyNumbers::integer, NpyShape::matrix})).values,
            (std::vector<double>{-3, 9007199254740992.0}));
}

TEST(Npy, RejectsWhatDoesNotFit) {
  EXPECT_THROW_TEXT(npy(sample, {NpyNumbers::integer, NpyShape::matrix}),
                    "row 0 column 3 of the matrix is 3.5, expected a whole number");
  EXPECT_THROW_TEXT(npy(sample, {NpyNumbers::real, NpyShape::vector}),
                    "the matrix has 2 rows and 6 columns, expected one row or one column for a list");
  EXPECT_THROW_TEXT(npy({1, 4, {1, 2, 3, 4}}, {NpyNumbers::real, NpyShape::points}),
                    "the matrix has 4 columns, expected x, y, z of every point");
  EXPECT_THROW_TEXT(npy({2, 4, {1}}), "the matrix holds 1 numbers, expected 2 x 4");
}
