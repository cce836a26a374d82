// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/base/digest.h"
#include "engine/value/value.h"

namespace engine::run {

struct Task;
struct Tree;

// Something that waits for trees to grow or to settle.
class Watcher {
 public:
  virtual ~Watcher() = default;
  virtual void update(Tree* changed) = 0;
};

// What a port of a graph is worth in this run: a value, or a sequence of trees; it starts out pending. A tree is
// *settled* when its identity is known (a sequence: complete and all its children settled) or when it has failed. All
// members belong to the session's lock.
struct Tree {
  enum class State : std::uint8_t { pending, leaf, sequence, failed };
  State state = State::pending;
  bool settled = false;
  bool broken = false;      // a sequence with a failed child, or one that will never be complete
  bool unknown = false;     // planning: its identity is not known before something has run
  bool cheap = false;       // neither hashed nor stored
  bool source = false;      // a file of the user's: its value is always at hand
  Tree* forward = nullptr;  // this tree turned out to be another one
  Digest identity;          // of a sequence: made when first asked for
  bool has_identity = false;

  // leaf
  Task* producer = nullptr;
  std::uint32_t output = 0;
  std::uint32_t ordinal = 0;  // position in a streamed output
  std::uint32_t uses = 0;     // tasks that read it as a value and are not done
  std::uint32_t pins = 0;     // readers waiting for it or about to use it
  Value value;
  std::size_t bytes = 0;        // accounted while value is held
  std::vector<Task*> requests;  // tasks that wait for the value
  Tree* container = nullptr;    // the sequence in which it was made

  // sequence
  struct Sequence {
    std::vector<std::string> ids;
    std::vector<Tree*> children;
    std::unordered_map<std::string, std::size_t> positions;  // as far as index() has brought them
    std::size_t unsettled = 0;
    std::size_t gathers = 0;  // tasks that read it as a whole and are not done
    bool complete = false;
    bool cut_off = false;  // its producer failed: what would have followed is lost

    // Brings `positions` up to date.
    void index() {
      for (std::size_t i = positions.size(); i < ids.size(); ++i) positions.emplace(ids[i], i);
    }
  };
  std::unique_ptr<Sequence> sequence;

  std::vector<Watcher*> on_grow;  // sequence: told of every new child and of completion
  std::vector<Watcher*> on_settle;
  std::vector<Tree*> containers;  // sequences that count this tree among their unsettled children
};

inline Tree* follow(Tree* tree) {
  while (tree->forward) tree = tree->forward;
  return tree;
}

}  // namespace engine::run
