// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "engine/value/type_info.h"

namespace engine {

// An immutable, shared value of a declared type. Types are compared by name, so that it holds across libraries.
class Value {
 public:
  Value() = default;
  Value(const TypeInfo& type, std::shared_ptr<const void> data) : type_(&type), data_(std::move(data)) {}
  template <class T>
  static Value of(T value) {
    return Value(type_of<T>(), std::make_shared<const T>(std::move(value)));
  }

  explicit operator bool() const { return data_ != nullptr; }
  const TypeInfo& type() const { return *type_; }
  const std::shared_ptr<const void>& data() const { return data_; }
  std::size_t size_bytes() const { return type_->size_bytes(data_.get()); }
  template <class T>
  const T& as() const {
    const std::string& wanted = type_of<T>().name;
    if (!data_ || type_->name != wanted)
      throw std::logic_error("expected a value of type " + wanted + ", found " + (data_ ? type_->name : "nothing"));
    return *static_cast<const T*>(data_.get());
  }

 private:
  const TypeInfo* type_ = nullptr;
  std::shared_ptr<const void> data_;
};

}  // namespace engine
