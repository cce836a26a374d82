// SPDX-License-Identifier: Apache-2.0
// A JSON document that knows where everything in it was written. Comments are allowed; duplicate keys are found.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/problem.h"

namespace engine {

// A text that values were read from. Values point to it: it outlives them.
struct SourceFile {
  std::string shown;         // what messages call it
  std::string folder;        // absolute; relative paths in the text are relative to it
  std::string shown_folder;  // the same as messages show it; empty = the working directory
};

struct JsonMember;

struct JsonValue {
  enum class Kind { null, boolean, integer, real, string, array, object };
  Kind kind = Kind::null;
  bool boolean = false;
  std::int64_t integer = 0;
  double real = 0;                  // of integers too
  std::string text;                 // a string's value; a number as it was written
  std::vector<JsonValue> items;     // of an array
  std::vector<JsonMember> members;  // of an object, in the order written
  const SourceFile* source = nullptr;
  int line = 0, column = 0;  // from 1; columns count characters, not bytes
  std::string pointer;       // JSON pointer

  bool is(Kind wanted) const { return kind == wanted; }
  const JsonMember* find(std::string_view key) const;
  Place place() const;
};

struct JsonMember {
  std::string key;
  const SourceFile* source = nullptr;
  int line = 0, column = 0;  // of the key
  JsonValue value;

  Place place() const;
};

// Reads a document. Returns false where it is no JSON; what is wrong goes to problems (duplicate keys too, which leave
// a readable document that holds the first of them).
bool parse_json(std::string_view text, const SourceFile& source, JsonValue& document, std::vector<Problem>& problems);

// Applies a merge patch (RFC 7386). Every value keeps the place where it was written. A null that removes nothing is a
// problem: it is a misspelt name.
void merge_patch(JsonValue& target, const JsonValue& patch, std::vector<Problem>& problems);

// What a message says was found: the string "x", the number 3, a list, an object, true, null.
std::string found(const JsonValue& value);

// "text" in quotes, shortened where it is long; control characters are escaped.
std::string quoted_text(std::string_view text);

}  // namespace engine
