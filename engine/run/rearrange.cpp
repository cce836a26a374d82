// SPDX-License-Identifier: Apache-2.0
// The engine's own nodes: they make no values, only other orders of them.
#include <algorithm>
#include <cctype>
#include <set>

#include "engine/base/element_id.h"
#include "engine/run/session.h"

namespace engine::run {
namespace {

// * and ? as in a shell, on a whole name.
bool matches(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = std::string_view::npos, retry = 0;
  while (n < name.size()) {
    if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      retry = n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++retry;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

// The identity of the value that a node would have made of the same text.
Digest identity_of_text(const Value& text) {
  Bytes bytes;
  ByteWriter writer(bytes);
  text.type().encode(text.data().get(), writer);
  return digest_of(bytes);
}

const Digest& identity_of_true() {
  static const Digest digest = digest_of(Bytes{1});
  return digest;
}

}  // namespace

Rearrangement::Rearrangement(Session& session, int node, Bindings inputs, std::vector<Tree*> outputs)
    : session_(session), node_(node), output_(outputs.at(0)) {
  for (const auto& port : inputs) {
    inputs_.emplace_back();
    for (const Binding& binding : port)
      if (binding.tree) inputs_.back().push_back(binding.tree);
  }
}

void Rearrangement::start() {
  const Structural kind = session_.node(node_).info->structural;
  for (auto& port : inputs_)
    for (Tree* tree : port) {
      const bool is_id = kind == Structural::pick && &port != &inputs_.front();
      if (kind != Structural::list_files && kind != Structural::merge && kind != Structural::where && !is_id)
        session_.watch_growth(tree, this);
      else if (!session_.watch_settling(tree, this))
        update(tree);
    }
}

void Rearrangement::fail(const std::string& why) {
  done_ = true;
  session_.note_failure(session_.node(node_).id + ": " + why);
  ++session_.counts_.failed;
  session_.fail_tree(output_);
}

void Rearrangement::update(Tree*) {
  if (done_) return;
  for (auto& port : inputs_)
    for (Tree*& tree : port) {
      tree = follow(tree);
      if (tree->state == Tree::State::pending) return;
      if (tree->state == Tree::State::failed) {
        done_ = true;
        return session_.fail_tree(output_);
      }
    }
  switch (session_.node(node_).info->structural) {
    case Structural::list_files:
      return list_files();
    case Structural::flatten:
      return flatten();
    case Structural::merge:
      return merge();
    case Structural::pick:
      return pick();
    default:
      return pass_through();
  }
}

void Rearrangement::list_files() {
  const GraphNode& graph_node = session_.node(node_);
  done_ = true;
  Tree* folder = inputs_[0][0];
  if (!folder->source) return fail("its input 'folder' is made by a node, expected a folder of yours");
  const File held = folder->value.as<File>();
  if (!held.is_folder()) return fail("its input 'folder' is the file " + held.path() + ", expected a folder");
  const std::string pattern = std::get<std::string>(graph_node.params[0]);
  struct Entry {
    std::string id;
    const File::Entry* file;
  };
  std::vector<Entry> entries;
  for (const File::Entry& file : held.entries()) {
    if (file.name.find('/') != std::string::npos || !matches(pattern, file.name)) continue;
    const std::size_t dot = file.name.find_last_of('.');
    const std::string id = canonical_id(dot == 0 ? file.name : file.name.substr(0, dot));
    if (id.empty())
      return fail("file " + file.name +
                  " gives no id: expected letters, digits, '_', '-' and '.', and not digits-digits");
    entries.push_back({id, &file});
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return id_before(a.id, b.id); });
  for (std::size_t i = 1; i < entries.size(); ++i)
    if (entries[i].id == entries[i - 1].id)
      return fail("files " + entries[i - 1].file->name + " and " + entries[i].file->name + " give one id, '" +
                  entries[i].id + "': choose one by 'pattern'");
  for (const Entry& entry : entries) {
    Source source;
    source.kind = Source::Kind::file;
    source.path = entry.file->path;
    session_.add_child(output_, entry.id, session_.source_tree(source));
  }
  session_.complete(output_);
}

bool Rearrangement::keeps(std::size_t index, const std::string& id) {
  const GraphNode& graph_node = session_.node(node_);
  const auto number = [&](std::size_t param) {
    return static_cast<std::size_t>(std::get<std::int64_t>(graph_node.params[param]));
  };
  switch (graph_node.info->structural) {
    case Structural::slice:
      return index >= number(0) && index < number(1);
    case Structural::every:
      return index >= number(1) && (index - number(1)) % number(0) == 0;
    case Structural::select:
      if (!chosen_) chosen_.emplace(std::get<std::vector<std::string>>(graph_node.params[0]));
      return chosen_->admits(id);
    case Structural::where:
      return follow(inputs_[1][0]->sequence->children.at(index))->identity == identity_of_true();
    default:
      return true;
  }
}

void Rearrangement::pass_through() {
  const GraphNode& graph_node = session_.node(node_);
  Tree* from = inputs_[0][0];
  const Tree::Sequence& held = *from->sequence;
  if (graph_node.info->structural == Structural::where) {
    const Tree* flags = inputs_[1][0];
    if (!from->settled || !flags->settled) return;
    if (flags->broken || (!flags->sequence->children.empty() && follow(flags->sequence->children[0])->cheap)) {
      if (!flags->broken) return fail("its flags come from a cheap node, whose values are not kept");
      done_ = true;
      return session_.fail_tree(output_);
    }
    if (held.ids != flags->sequence->ids) {
      const auto odd =
          std::mismatch(held.ids.begin(), held.ids.end(), flags->sequence->ids.begin(), flags->sequence->ids.end());
      return fail("inputs 'sequence' and 'flags' have different ids: the first odd one is '" +
                  (odd.first != held.ids.end() ? *odd.first : *odd.second) + "'");
    }
  }
  for (; next_ < held.children.size(); ++next_) {
    if (!keeps(next_, held.ids[next_])) continue;
    Tree* child = held.children[next_];
    if (graph_node.info->structural == Structural::ids) {
      child = session_.new_tree();
      child->state = Tree::State::leaf;
      child->source = true;
      child->value = Value::of(held.ids[next_]);
      child->identity = identity_of_text(child->value);
      child->has_identity = true;
      child->settled = true;
    }
    session_.add_child(output_, held.ids[next_], child);
  }
  if (!held.complete) return;
  done_ = true;
  if (from->broken) output_->broken = true;
  if (from->sequence->cut_off) output_->sequence->cut_off = true;
  if (from->unknown) output_->unknown = true;
  session_.complete(output_);
}

// An id that a node found is known by its identity, as flags are: its value need not be at hand.
void Rearrangement::pick() {
  Tree* from = inputs_[0][0];
  Tree* found = inputs_[1].empty() ? nullptr : inputs_[1][0];
  if (found && !found->settled) return;
  if (found && found->cheap) return fail("its id comes from a cheap node, whose values are not kept");
  if (found && (found->unknown || found->state == Tree::State::failed)) {
    done_ = true;
    return session_.set_forward(output_, found);  // a plan knows as little of the element as of its id
  }
  const Tree::Sequence& held = *from->sequence;
  const std::string& given = std::get<std::string>(session_.node(node_).params[0]);
  const auto is_meant = [&](const std::string& id) {
    if (found) return identity_of_text(Value::of(id)) == found->identity;
    return given.empty() || id == canonical_id(given);
  };
  while (next_ < held.ids.size() && !is_meant(held.ids[next_])) ++next_;
  if (next_ < held.ids.size()) {
    done_ = true;
    return session_.set_forward(output_, held.children[next_]);
  }
  if (!held.complete) return;
  if (from->unknown || from->broken) {
    done_ = true;
    output_->unknown = from->unknown;
    return session_.fail_tree(output_);
  }
  if (held.ids.empty()) return fail("its sequence has no elements, expected at least 1");
  fail((found ? "its input 'id' names no element" : "there is no element '" + given + "'") + "; the sequence has " +
       std::to_string(held.ids.size()) + " elements, '" + held.ids.front() + "' to '" + held.ids.back() + "'");
}

void Rearrangement::flatten() {
  Tree* from = inputs_[0][0];
  const Tree::Sequence& outer = *from->sequence;
  while (next_ < outer.children.size()) {
    Tree* inner = follow(outer.children[next_]);
    if (inner->state == Tree::State::pending) {
      if (watched_ != inner) inner->on_grow.push_back(this);
      watched_ = inner;
      return;
    }
    if (inner->state == Tree::State::sequence) {
      for (; inner_ < inner->sequence->children.size(); ++inner_)
        session_.add_child(output_, outer.ids[next_] + "." + inner->sequence->ids[inner_],
                           inner->sequence->children[inner_]);
      if (!inner->sequence->complete) {
        if (watched_ != inner) inner->on_grow.push_back(this);
        watched_ = inner;
        return;
      }
    } else {
      output_->broken = output_->sequence->cut_off = true;
    }
    ++next_;
    inner_ = 0;
  }
  if (!outer.complete) return;
  done_ = true;
  if (from->broken) output_->broken = true;
  if (from->sequence->cut_off) output_->sequence->cut_off = true;
  if (from->unknown) output_->unknown = true;
  session_.complete(output_);
}

void Rearrangement::merge() {
  struct Element {
    std::string id;
    Tree* tree;
  };
  std::vector<Element> elements;
  bool broken = false, unknown = false;
  for (Tree* tree : inputs_[0]) {
    if (!tree->settled) return;
    broken |= tree->broken;
    if (tree->sequence->cut_off) output_->sequence->cut_off = true;
    unknown |= tree->unknown;
    for (std::size_t i = 0; i < tree->sequence->ids.size(); ++i)
      elements.push_back({tree->sequence->ids[i], tree->sequence->children[i]});
  }
  done_ = true;
  std::stable_sort(elements.begin(), elements.end(),
                   [](const Element& a, const Element& b) { return id_before(a.id, b.id); });
  for (std::size_t i = 1; i < elements.size(); ++i)
    if (elements[i].id == elements[i - 1].id)
      return fail("two of its sequences have an element '" + elements[i].id + "'");
  for (const Element& element : elements) session_.add_child(output_, element.id, element.tree);
  output_->broken |= broken;
  output_->unknown |= unknown;
  session_.complete(output_);
}

}  // namespace engine::run
