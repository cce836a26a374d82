// SPDX-License-Identifier: Apache-2.0
// What an algorithm may include of the engine: sequences, windows, priors, files and progress. Standard library only,
// and nothing to link: every class here can be made by hand in a test.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace engine {

// Where a sequence's elements come from. The engine loads them lazily; a test gives a vector.
template <class T>
class SeqSource {
 public:
  virtual ~SeqSource() = default;
  virtual std::size_t size() const = 0;
  virtual std::string id(std::size_t index) const = 0;
  virtual std::shared_ptr<const T> load(std::size_t index) const = 0;
};

// An ordered sequence whose elements have stable ids. Elements are loaded when they are read and dropped afterwards, so
// a loop over 18,000 images holds one. Random access works, but a sequence that is decoded in order is cheap in order
// only.
template <class T>
class Seq {
 public:
  Seq() : Seq(std::vector<T>{}) {}
  Seq(std::vector<T> values) : source_(std::make_shared<Held>(std::move(values), std::vector<std::string>{})) {}
  Seq(std::vector<T> values, std::vector<std::string> ids)
      : source_(std::make_shared<Held>(std::move(values), std::move(ids))) {}
  explicit Seq(std::shared_ptr<const SeqSource<T>> source) : source_(std::move(source)) {}

  std::size_t size() const { return source_->size(); }
  bool empty() const { return size() == 0; }
  std::string id(std::size_t index) const { return source_->id(index); }
  // The element stays alive as long as the pointer.
  std::shared_ptr<const T> at(std::size_t index) const {
    if (index >= size())
      throw std::out_of_range("element " + std::to_string(index) + " of a sequence of " + std::to_string(size()));
    return source_->load(index);
  }

  class iterator {
   public:
    iterator(const Seq* seq, std::size_t index) : seq_(seq), index_(index) {}
    const T& operator*() const {
      if (!held_) held_ = seq_->at(index_);
      return *held_;
    }
    iterator& operator++() {
      held_.reset();
      ++index_;
      return *this;
    }
    bool operator!=(const iterator& other) const { return index_ != other.index_; }

   private:
    const Seq* seq_;
    std::size_t index_;
    mutable std::shared_ptr<const T> held_;
  };
  iterator begin() const { return {this, 0}; }
  iterator end() const { return {this, size()}; }

 private:
  struct Held final : SeqSource<T>, std::enable_shared_from_this<Held> {
    Held(std::vector<T> v, std::vector<std::string> i) : values(std::move(v)), ids(std::move(i)) {}
    std::size_t size() const override { return values.size(); }
    std::string id(std::size_t index) const override { return ids.empty() ? std::to_string(index) : ids.at(index); }
    std::shared_ptr<const T> load(std::size_t index) const override {
      if constexpr (std::is_same_v<T, bool>)
        return std::make_shared<const bool>(values[index]);
      else
        return std::shared_ptr<const T>(this->shared_from_this(), &values[index]);
    }
    std::vector<T> values;
    std::vector<std::string> ids;
  };
  std::shared_ptr<const SeqSource<T>> source_;
};

// Takes a node's output sequence element by element, so that it is never held as a whole.
template <class T>
class SeqWriter {
 public:
  using Sink = std::function<void(std::string id, T value)>;
  explicit SeqWriter(Sink sink) : sink_(std::move(sink)) {}

  // Appends an element whose id is its position.
  void push(T value) { push(std::to_string(count_), std::move(value)); }
  void push(std::string id, T value) {
    ++count_;
    sink_(std::move(id), std::move(value));
  }
  std::size_t count() const { return count_; }

 private:
  Sink sink_;
  std::size_t count_ = 0;
};

// An element with its neighbours. At the ends of the sequence the window is shorter.
template <class T>
class Window {
 public:
  Window(std::vector<std::shared_ptr<const T>> values, std::size_t centre)
      : values_(std::move(values)), centre_(centre) {}
  std::size_t size() const { return values_.size(); }
  std::size_t centre_index() const { return centre_; }
  const T& operator[](std::size_t index) const { return *values_.at(index); }
  const T& centre() const { return *values_[centre_]; }

 private:
  std::vector<std::shared_ptr<const T>> values_;
  std::size_t centre_;
};

// The node's own result at the preceding element; empty at the first.
template <class R>
class Prior {
 public:
  Prior() = default;
  explicit Prior(std::shared_ptr<const R> result) : result_(std::move(result)) {}
  explicit operator bool() const { return result_ != nullptr; }
  const R& operator*() const { return *result_; }
  const R* operator->() const { return result_.get(); }

 private:
  std::shared_ptr<const R> result_;
};

// A file or a folder that a node was given or has made. What counts is its content and its suffix, never its path.
class File {
 public:
  struct Entry {
    std::string name;  // relative path with '/', of a file below the folder
    std::string path;
  };
  File() = default;

  // A file on disk that somebody else keeps. `title` is what messages call it (default: the path).
  static File at(std::string path) { return File(std::move(path), nullptr, false); }
  // A folder: its files, sorted by name.
  static File folder(std::string path, std::vector<Entry> entries) {
    File file(std::move(path), nullptr, true);
    file.entries_ = std::make_shared<const std::vector<Entry>>(std::move(entries));
    return file;
  }
  // A file that a node made in memory; the suffix starts with a dot (".glb").
  static File from_bytes(std::string bytes, std::string suffix) {
    File file({}, std::make_shared<const std::string>(std::move(bytes)), false);
    file.suffix_ = std::move(suffix);
    return file;
  }

  bool is_folder() const { return folder_; }
  bool in_memory() const { return bytes_ != nullptr; }
  const std::string& bytes() const { return *bytes_; }
  // Where to open it. Empty for a file that lives in memory only: algorithms get their inputs on disk.
  const std::string& path() const { return path_; }
  // What messages call it.
  std::string name() const {
    const std::size_t slash = path_.find_last_of('/');
    return slash == std::string::npos ? path_ : path_.substr(slash + 1);
  }
  // With the dot, as the file spells it: ".wav".
  std::string suffix() const {
    if (!suffix_.empty() || folder_) return suffix_;
    const std::string leaf = name();
    const std::size_t dot = leaf.find_last_of('.');
    return dot == std::string::npos || dot == 0 ? std::string() : leaf.substr(dot);
  }
  const std::vector<Entry>& entries() const {
    static const std::vector<Entry> none;
    return entries_ ? *entries_ : none;
  }
  // The path of a folder's file, or empty where it has none of that name.
  std::string find(std::string_view entry_name) const {
    for (const Entry& entry : entries())
      if (entry.name == entry_name) return entry.path;
    return {};
  }

 private:
  File(std::string path, std::shared_ptr<const std::string> bytes, bool folder)
      : path_(std::move(path)), bytes_(std::move(bytes)), folder_(folder) {}
  std::string path_;
  std::string suffix_;
  std::shared_ptr<const std::string> bytes_;
  std::shared_ptr<const std::vector<Entry>> entries_;
  bool folder_ = false;
};

// Lets a long computation report, be stopped, warn, and use a folder for temporary files. It reveals nothing that could
// change a result. The default one does nothing, for tests.
class Progress {
 public:
  virtual ~Progress() = default;
  // fraction in [0, 1].
  virtual void report(double /*fraction*/) {}
  virtual bool stop_requested() const { return false; }
  // Shown to the user with the node's name and kept with the result.
  virtual void warn(const std::string& /*text*/) {}
  // An empty folder that is removed afterwards. A File::at() below it that the node returns is taken over by the store.
  virtual std::string scratch_folder() { return {}; }
};

}  // namespace engine
