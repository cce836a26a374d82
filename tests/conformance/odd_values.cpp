// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/odd_values.h"

#include <cctype>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include "engine/port.h"
#include "tests/support/samples.h"

namespace conformance {
namespace {

// A layout such as 24/8[12/4[4/4f]] as a tree. A list and an array of fixed length look the same in it (both have
// brackets): one of 24 bytes may be either, and which it is shows when the bytes are read.
struct Layout {
  char kind = 'i';  // f real, i integer, s text, [ list or array, { struct
  std::size_t size = 0;
  std::vector<Layout> inner;
  bool list = false;
};

class LayoutReader {
 public:
  explicit LayoutReader(const std::string& text) : text_(text) {}
  Layout read() {
    Layout layout;
    layout.size = number();
    expect('/');
    number();
    layout.kind = text_.at(at_++);
    if (layout.kind == '[') {
      layout.inner.push_back(read());
      expect(']');
      layout.list = layout.size == sizeof(std::vector<int>);
    } else if (layout.kind == '{') {
      while (text_.at(at_) != '}') {
        at_ = text_.find(':', at_) + 1;
        layout.inner.push_back(read());
        expect(';');
      }
      ++at_;
    }
    return layout;
  }

 private:
  std::size_t number() {
    std::size_t value = 0;
    while (std::isdigit(static_cast<unsigned char>(text_.at(at_))))
      value = 10 * value + static_cast<std::size_t>(text_[at_++] - '0');
    return value;
  }
  void expect(char c) {
    if (text_.at(at_++) != c) throw std::logic_error("layout " + text_ + ": expected " + c);
  }
  const std::string& text_;
  std::size_t at_ = 0;
};

template <class T>
void real(engine::ByteReader& reader, engine::ByteWriter* writer, Oddity oddity) {
  T value = reader.number<T>();
  if (oddity == Oddity::not_a_number) value = std::numeric_limits<T>::quiet_NaN();
  if (oddity == Oddity::infinite) value = std::numeric_limits<T>::infinity();
  if (writer) writer->number(value);
}

// Copies a value from reader to writer (null: skips it), made odd on the way.
void copy(const Layout& layout, engine::ByteReader& reader, engine::ByteWriter* writer, Oddity oddity) {
  if (layout.kind == 'f') {
    layout.size == 4 ? real<float>(reader, writer, oddity) : real<double>(reader, writer, oddity);
  } else if (layout.kind == 'i') {
    std::uint8_t bytes[8];
    reader.raw(bytes, layout.size);
    if (writer) writer->raw(bytes, layout.size);
  } else if (layout.kind == 's') {
    const std::string text = reader.text();
    if (writer) writer->text(text);
  } else if (layout.kind == '{') {
    for (const Layout& field : layout.inner) copy(field, reader, writer, oddity);
  } else if (layout.list) {
    const std::size_t count = reader.count();
    const std::size_t kept = oddity == Oddity::empty         ? 0
                             : oddity == Oddity::one_element ? std::min<std::size_t>(count, 1)
                                                             : count;
    if (writer) writer->count(kept);
    for (std::size_t i = 0; i < count; ++i) copy(layout.inner[0], reader, i < kept ? writer : nullptr, oddity);
  } else {
    for (std::size_t i = 0; i < layout.size / layout.inner[0].size; ++i) copy(layout.inner[0], reader, writer, oddity);
  }
}

void find_lists(Layout& layout, std::vector<Layout*>& lists) {
  if (layout.list) lists.push_back(&layout);
  for (Layout& inner : layout.inner) find_lists(inner, lists);
}

std::optional<engine::Bytes> transcode(const Layout& layout, const engine::Bytes& bytes, Oddity oddity) {
  engine::Bytes changed;
  engine::ByteWriter writer(changed);
  engine::ByteReader reader(bytes);
  try {
    copy(layout, reader, &writer, oddity);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
  if (reader.left() != 0) return std::nullopt;
  return changed;
}

// The bytes fit the layout in one way: lists first, then with arrays of 24 bytes among them.
std::optional<engine::Bytes> make_odd(const std::string& text, const engine::Bytes& bytes, Oddity oddity) {
  Layout layout = LayoutReader(text).read();
  std::vector<Layout*> lists;
  find_lists(layout, lists);
  for (std::uint64_t arrays = 0; arrays < std::uint64_t{1} << std::min<std::size_t>(lists.size(), 12); ++arrays) {
    for (std::size_t i = 0; i < lists.size() && i < 12; ++i) lists[i]->list = (arrays >> i & 1) == 0;
    if (auto changed = transcode(layout, bytes, oddity)) return changed;
  }
  return std::nullopt;
}

AnyValue odd_file(const engine::File& file, Oddity oddity) {
  if (oddity == Oddity::not_a_number || oddity == Oddity::infinite) return nullptr;
  const bool empty = oddity == Oddity::empty;
  if (file.is_folder()) {
    std::vector<engine::File::Entry> entries = file.entries();
    entries.resize(empty ? 0 : 1);
    return std::make_shared<const engine::File>(engine::File::folder(file.path(), entries));
  }
  return test::sample_file((empty ? "empty" : "one_byte") + file.suffix(), empty ? "" : "0");
}

}  // namespace

std::string name_of(Oddity oddity) {
  switch (oddity) {
    case Oddity::empty:
      return "empty";
    case Oddity::one_element:
      return "one element";
    case Oddity::not_a_number:
      return "not a number";
    case Oddity::infinite:
      return "infinite";
  }
  return {};
}

AnyValue odd_value(const engine::TypeInfo& type, const AnyValue& value, Oddity oddity) {
  if (type.name == "file") return odd_file(*static_cast<const engine::File*>(value.get()), oddity);
  if (type.name == "text") {
    if (oddity == Oddity::empty) return std::make_shared<const std::string>();
    return oddity == Oddity::one_element ? std::make_shared<const std::string>("a") : nullptr;
  }
  engine::Bytes bytes;
  engine::ByteWriter writer(bytes);
  type.encode(value.get(), writer);
  const auto changed = make_odd(type.layout, bytes, oddity);
  if (!changed) throw std::logic_error("the bytes of type " + type.name + " do not follow its layout " + type.layout);
  if (*changed == bytes) return nullptr;
  engine::ByteReader reader(*changed);
  return type.decode(reader);
}

}  // namespace conformance
