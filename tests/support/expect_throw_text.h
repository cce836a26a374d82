// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>

#include <exception>
#include <string>

// The statement throws an exception with exactly this text.
#define EXPECT_THROW_TEXT(statement, text)             \
  do {                                                 \
    std::string expect_throw_found = "nothing thrown"; \
    try {                                              \
      (void)(statement);                               \
    } catch (const std::exception& error) {            \
      expect_throw_found = error.what();               \
    }                                                  \
    EXPECT_EQ(expect_throw_found, text);               \
  } while (false)
