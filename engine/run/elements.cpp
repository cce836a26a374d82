// SPDX-License-Identifier: Apache-2.0
// Which elements are meant: ranges, windows, filters, and one that is picked.
#include <algorithm>
#include <stdexcept>

#include "engine/base/element_id.h"
#include "engine/run/session.h"

namespace engine::run {

std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> parts;
  std::size_t at = 0;
  while (at <= path.size()) {
    const std::size_t slash = std::min(path.find('/', at), path.size());
    parts.push_back(path.substr(at, slash - at));
    at = slash + 1;
  }
  return parts;
}

bool in_range(const std::string& id, const std::string& first, const std::string& last) {
  if (first == last) return id == first;
  return is_integer_id(id) && !id_before(id, first) && !id_before(last, id);
}

Span span_of(const Binding& binding, const InputInfo& port) {
  const std::size_t before = std::min(binding.index, static_cast<std::size_t>(port.before));
  return {binding.index - before,
          std::min(binding.tree->sequence->children.size(), binding.index + static_cast<std::size_t>(port.after) + 1)};
}

ElementFilter::ElementFilter(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    std::vector<std::string> parts = split_path(text);
    Override::Range range;
    const std::string leaf = parts.back();
    parts.pop_back();
    for (const std::string& part : parts) range.parents.push_back(canonical_id(part));
    const std::size_t dash = leaf.find('-');
    range.first = range.last = canonical_id(leaf);
    if (range.first.empty() && dash != std::string::npos) {
      range.first = canonical_id(leaf.substr(0, dash));
      range.last = canonical_id(leaf.substr(dash + 1));
    }
    if (range.first.empty() || range.last.empty())
      throw std::invalid_argument("'" + text + "' is no element: expected an id, a range such as 0-49, or parent/id");
    ranges_.push_back(std::move(range));
  }
}

bool ElementFilter::admits(const std::string& path) const {
  const std::vector<std::string> ids = split_path(path);
  for (const Override::Range& range : ranges_) {
    bool fits = true;
    for (std::size_t i = 0; i < ids.size() && fits; ++i) {
      if (i < range.parents.size())
        fits = ids[i] == range.parents[i];
      else if (i == range.parents.size())
        fits = in_range(ids[i], range.first, range.last);
    }
    if (fits) return true;
  }
  return false;
}

Pick::Pick(Session& session, Tree* from, std::vector<std::string> ids, Tree* to, std::string shown)
    : session_(session), from_(from), ids_(std::move(ids)), to_(to), shown_(std::move(shown)) {}

void Pick::update(Tree*) {
  while (!done_) {
    from_ = follow(from_);
    if (from_->state == Tree::State::failed) {
      done_ = true;
      session_.fail_tree(to_);
      return;
    }
    if (from_->state != Tree::State::sequence) return;
    const Tree::Sequence& held = *from_->sequence;
    while (seen_ < held.ids.size() && held.ids[seen_] != ids_.front()) ++seen_;
    if (seen_ == held.ids.size()) {
      if (!held.complete) return;
      done_ = true;
      if (from_->unknown) {
        to_->unknown = true;
      } else if (!from_->broken) {
        session_.note_failure(shown_ + ": there is no element '" + ids_.front() + "'; the sequence has " +
                              std::to_string(held.ids.size()) + " elements" +
                              (held.ids.empty() ? "" : ", '" + held.ids.front() + "' to '" + held.ids.back() + "'"));
        ++session_.counts_.failed;
      }
      session_.fail_tree(to_);
      return;
    }
    Tree* child = held.children[seen_];
    ids_.erase(ids_.begin());
    seen_ = 0;
    if (ids_.empty()) {
      done_ = true;
      session_.set_forward(to_, child);
      return;
    }
    from_ = child;
    session_.watch_growth(child, this);
    return;
  }
}

}  // namespace engine::run
