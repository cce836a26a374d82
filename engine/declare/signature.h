// SPDX-License-Identifier: Apache-2.0
// Reads the meaning of a node off the signature of its function.
#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <tuple>
#include <type_traits>

#include "engine/declare/call.h"

namespace engine::declare::detail {

template <class F>
struct signature;
template <class R, class... A>
struct signature<R (*)(A...)> {
  using result = R;
  using arguments = std::tuple<A...>;
};

enum class Role { value, optional, sequence, optional_sequence, window, prior, writer, progress };

// The value type inside any number of Seq, and how many there are.
template <class T>
struct nested {
  using type = T;
  static constexpr int depth = 0;
};
template <class T>
struct nested<Seq<T>> {
  using type = typename nested<T>::type;
  static constexpr int depth = nested<T>::depth + 1;
};

template <class A>
struct argument {
  using type = std::remove_cv_t<A>;
  static constexpr Role role = Role::value;
  static_assert(!std::is_reference_v<A>, "a node may not modify its inputs: take them by const reference");
};
template <class T>
struct argument<const T&> {
  using type = T;
  static constexpr Role role = Role::value;
};
template <class T>
struct argument<const T*> {
  using type = T;
  static constexpr Role role = Role::optional;
};
template <class T>
struct argument<const Seq<T>&> {
  using type = Seq<T>;
  static constexpr Role role = Role::sequence;
};
template <class T>
struct argument<const Seq<T>*> {
  using type = Seq<T>;
  static constexpr Role role = Role::optional_sequence;
};
template <class T>
struct argument<const Window<T>&> {
  using type = T;
  static constexpr Role role = Role::window;
};
template <class R>
struct argument<const Prior<R>&> {
  using type = R;
  static constexpr Role role = Role::prior;
};
template <class T>
struct argument<SeqWriter<T>&> {
  using type = T;
  static constexpr Role role = Role::writer;
};
template <>
struct argument<Progress&> {
  using type = Progress;
  static constexpr Role role = Role::progress;
};

constexpr bool is_input(Role role) { return role != Role::prior && role != Role::writer && role != Role::progress; }

// A typed view of a sequence that the engine loads.
template <class T>
class TypedSource final : public SeqSource<T> {
 public:
  explicit TypedSource(std::shared_ptr<const SequenceAccess> access) : access_(std::move(access)) {}
  std::size_t size() const override { return access_->size(); }
  std::string id(std::size_t index) const override { return access_->id(index); }
  std::shared_ptr<const T> load(std::size_t index) const override {
    if constexpr (nested<T>::depth > 0) {
      using Inner = TypedSource<typename nested<Seq<T>>::type>;
      static_assert(nested<T>::depth == 1, "sequences nest two deep in a port");
      return std::make_shared<const T>(std::make_shared<const Inner>(access_->inner(index)));
    } else {
      return std::static_pointer_cast<const T>(access_->load(index));
    }
  }

 private:
  std::shared_ptr<const SequenceAccess> access_;
};

template <class S>
S open_sequence(std::shared_ptr<const SequenceAccess> access);
template <class T>
Seq<T> open_sequence_of(std::shared_ptr<const SequenceAccess> access) {
  return Seq<T>(
      std::static_pointer_cast<const SeqSource<T>>(std::make_shared<const TypedSource<T>>(std::move(access))));
}
template <class S>
struct sequence_opener;
template <class T>
struct sequence_opener<Seq<T>> {
  static Seq<T> open(std::shared_ptr<const SequenceAccess> access) { return open_sequence_of<T>(std::move(access)); }
};

}  // namespace engine::declare::detail
