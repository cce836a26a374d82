// SPDX-License-Identifier: Apache-2.0
// Derives a value type's codec, size, layout fingerprint and JSON picture from its fields.
#pragma once
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/value/type_info.h"

namespace engine::codec {

// The name of a member, read off its pointer: name_of<&Mesh::points>() == "points".
template <auto Member>
constexpr std::string_view name_of() {
  constexpr std::string_view text = __PRETTY_FUNCTION__;
  constexpr std::size_t begin = text.find("Member = ");
  constexpr std::size_t end = text.find_first_of(";]", begin);
  constexpr std::size_t colons = text.substr(0, end).rfind("::");
  return text.substr(colons + 2, end - colons - 2);
}

template <class T>
struct is_vector : std::false_type {};
template <class T, class A>
struct is_vector<std::vector<T, A>> : std::true_type {};
template <class T>
struct is_array : std::false_type {};
template <class T, std::size_t N>
struct is_array<std::array<T, N>> : std::true_type {};

// Numbers, and arrays of numbers: memory and canonical bytes are the same.
template <class T>
constexpr bool is_plain() {
  if constexpr (is_array<T>::value)
    return is_plain<typename T::value_type>();
  else
    return std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;
}

template <class T>
struct member_of;
template <class S, class T>
struct member_of<T S::*> {
  using owner = S;
  using type = T;
};

inline void append_number(std::string& out, double value) {
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  char text[32];
  out.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}
inline void append_number(std::string& out, float value) {
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  char text[32];
  out.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}
void append_quoted(std::string& out, std::string_view text);

// A value of type T; Fields describe it (or its elements) where it is a struct.
template <class T, class... Fields>
struct Codec {
  static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::string> || is_vector<T>::value ||
                    is_array<T>::value || sizeof...(Fields) > 0,
                "this member is a struct: list its fields inside field<...>(field<...>(), ...)");

  static void encode(const T& value, ByteWriter& writer) {
    if constexpr (std::is_same_v<T, bool>) {
      writer.number(static_cast<std::uint8_t>(value));
    } else if constexpr (std::is_arithmetic_v<T>) {
      writer.number(value);
    } else if constexpr (std::is_enum_v<T>) {
      writer.number(static_cast<std::int64_t>(value));
    } else if constexpr (std::is_same_v<T, std::string>) {
      writer.text(value);
    } else if constexpr (is_vector<T>::value) {
      writer.count(value.size());
      if constexpr (is_plain<typename T::value_type>())
        writer.raw(value.data(), value.size() * sizeof(typename T::value_type));
      else
        for (const typename T::value_type& element : value)
          Codec<typename T::value_type, Fields...>::encode(element, writer);
    } else if constexpr (is_array<T>::value) {
      for (const auto& element : value) Codec<typename T::value_type, Fields...>::encode(element, writer);
    } else {
      (Fields::encode(value, writer), ...);
    }
  }

  static void decode(T& value, ByteReader& reader) {
    if constexpr (std::is_same_v<T, bool>) {
      value = reader.number<std::uint8_t>() != 0;
    } else if constexpr (std::is_arithmetic_v<T>) {
      value = reader.number<T>();
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(reader.number<std::int64_t>());
    } else if constexpr (std::is_same_v<T, std::string>) {
      value = reader.text();
    } else if constexpr (is_vector<T>::value) {
      using Element = typename T::value_type;
      if constexpr (is_plain<Element>()) {
        value.resize(reader.count(sizeof(Element)));
        reader.raw(value.data(), value.size() * sizeof(Element));
      } else {
        value.resize(reader.count());
        if constexpr (std::is_same_v<Element, bool>) {
          for (std::size_t i = 0; i < value.size(); ++i) value[i] = reader.number<std::uint8_t>() != 0;
        } else {
          for (Element& element : value) Codec<Element, Fields...>::decode(element, reader);
        }
      }
    } else if constexpr (is_array<T>::value) {
      for (auto& element : value) Codec<typename T::value_type, Fields...>::decode(element, reader);
    } else {
      (Fields::decode(value, reader), ...);
    }
  }

  // Memory beside sizeof(T).
  static std::size_t extra_bytes(const T& value) {
    if constexpr (std::is_same_v<T, std::string>) {
      return value.capacity();
    } else if constexpr (is_vector<T>::value) {
      using Element = typename T::value_type;
      std::size_t total = value.capacity() * sizeof(Element);
      if constexpr (!is_plain<Element>() && !std::is_same_v<Element, bool>)
        for (const Element& element : value) total += Codec<Element, Fields...>::extra_bytes(element);
      return total;
    } else if constexpr (std::is_class_v<T> && !is_array<T>::value) {
      return (std::size_t{0} + ... + Fields::extra_bytes(value));
    } else {
      return 0;
    }
  }

  static std::string layout() {
    std::string text = std::to_string(sizeof(T)) + "/" + std::to_string(alignof(T));
    if constexpr (std::is_floating_point_v<T>)
      text += "f";
    else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
      text += "i";
    else if constexpr (std::is_same_v<T, std::string>)
      text += "s";
    else if constexpr (is_vector<T>::value || is_array<T>::value)
      text += "[" + Codec<typename T::value_type, Fields...>::layout() + "]";
    else
      text += "{" + ((std::string(Fields::name()) + ":" + Fields::layout() + ";") + ... + std::string()) + "}";
    return text;
  }

  static void show(const T& value, std::string& out) {
    if constexpr (std::is_same_v<T, bool>) {
      out += value ? "true" : "false";
    } else if constexpr (std::is_floating_point_v<T>) {
      append_number(out, value);
    } else if constexpr (std::is_arithmetic_v<T>) {
      out += std::to_string(value);
    } else if constexpr (std::is_enum_v<T>) {
      out += std::to_string(static_cast<std::int64_t>(value));
    } else if constexpr (std::is_same_v<T, std::string>) {
      append_quoted(out, value);
    } else if constexpr (is_vector<T>::value || is_array<T>::value) {
      out += "[";
      bool first = true;
      for (const auto& element : value) {
        if (!first) out += ", ";
        first = false;
        Codec<typename T::value_type, Fields...>::show(element, out);
      }
      out += "]";
    } else {
      bool first = true;
      out += "{";
      ((out += first ? "" : ", ", first = false, append_quoted(out, Fields::name()), out += ": ",
        Fields::show(value, out)),
       ...);
      out += "}";
    }
  }
};

// One member of a struct. Fields describe the member (or its elements) where that is a struct itself.
template <auto Member, class... Fields>
struct Field {
  using Owner = typename member_of<decltype(Member)>::owner;
  using Type = typename member_of<decltype(Member)>::type;
  using TypeCodec = Codec<Type, Fields...>;
  static constexpr std::string_view name() { return name_of<Member>(); }
  static void encode(const Owner& owner, ByteWriter& writer) { TypeCodec::encode(owner.*Member, writer); }
  static void decode(Owner& owner, ByteReader& reader) { TypeCodec::decode(owner.*Member, reader); }
  static std::size_t extra_bytes(const Owner& owner) { return TypeCodec::extra_bytes(owner.*Member); }
  static std::string layout() { return TypeCodec::layout(); }
  static void show(const Owner& owner, std::string& out) { TypeCodec::show(owner.*Member, out); }
};

// Fills in the functions of a TypeInfo.
template <class T, class... Fields>
void derive(TypeInfo& info) {
  using TypeCodec = Codec<T, Fields...>;
  info.layout = TypeCodec::layout();
  info.size_bytes = [](const void* value) { return sizeof(T) + TypeCodec::extra_bytes(*static_cast<const T*>(value)); };
  info.encode = [](const void* value, ByteWriter& writer) { TypeCodec::encode(*static_cast<const T*>(value), writer); };
  info.decode = [](ByteReader& reader) -> std::shared_ptr<const void> {
    auto value = std::make_shared<T>();
    TypeCodec::decode(*value, reader);
    if (reader.left() != 0) throw std::runtime_error("the bytes of a value go on after its end");
    return value;
  };
  info.show = [](const void* value) {
    std::string out;
    TypeCodec::show(*static_cast<const T*>(value), out);
    return out;
  };
}

}  // namespace engine::codec
