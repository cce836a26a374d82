// SPDX-License-Identifier: Apache-2.0
#include "engine/declare/node_info.h"

#include <charconv>

namespace engine {
namespace {

template <class List>
int find(const List& list, std::string_view name) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].name == name) return static_cast<int>(i);
  return -1;
}

NodeInfo node(Structural structural, const char* name, const char* doc) {
  NodeInfo info;
  info.structural = structural;
  info.name = name;
  info.doc = doc;
  return info;
}

InputInfo input(const char* name, const char* type, int depth, const char* doc) {
  InputInfo info;
  info.name = name;
  info.doc = doc;
  info.type = type;
  info.depth = depth;
  return info;
}

InputInfo alternatives(const char* name, int depth, const char* doc) {
  InputInfo info = input(name, "", depth, doc);
  info.variadic = true;
  return info;
}

OutputInfo output(const char* name, const char* type, int depth, const char* doc) {
  OutputInfo info;
  info.name = name;
  info.doc = doc;
  info.type = type;
  info.depth = depth;
  return info;
}

ParamInfo param(const char* name, ParamKind kind, bool list, ParamValue initial, const char* unit, double low,
                double high, const char* doc) {
  ParamInfo info;
  info.name = name;
  info.doc = doc;
  info.kind = kind;
  info.list = list;
  info.unit = unit;
  info.low = low;
  info.high = high;
  info.initial = std::move(initial);
  return info;
}

constexpr double most = 9007199254740991.0;  // the integers that JSON carries exactly

std::vector<NodeInfo> make_structural_nodes() {
  std::vector<NodeInfo> nodes;

  NodeInfo list = node(Structural::list_files, "files.list",
                       "The files of a folder as a sequence; an element's id is the file's stem.");
  list.inputs = {input("folder", "file", 0, "A folder")};
  list.params = {param("pattern", ParamKind::string, false, std::string("*"), "", 0, 0,
                       "File names to take: * and ? as in a shell")};
  list.outputs = {output("files", "file", 1, "The files, integers before names")};
  nodes.push_back(list);

  NodeInfo select = node(Structural::select, "seq.select", "The elements with the given ids, in the sequence's order.");
  select.inputs = {input("sequence", "", 1, "A sequence")};
  select.params = {param("ids", ParamKind::string, true, std::vector<std::string>{}, "", 0, 0,
                         "Ids, and ranges of integer ids such as 17-23")};
  select.outputs = {output("selected", "", 1, "The elements named")};
  nodes.push_back(select);

  NodeInfo slice = node(Structural::slice, "seq.slice", "A run of elements by position.");
  slice.inputs = {input("sequence", "", 1, "A sequence")};
  slice.params = {
      param("begin", ParamKind::integer, false, std::int64_t{0}, "1", 0, most, "Position of the first element taken"),
      param("end", ParamKind::integer, false, static_cast<std::int64_t>(most), "1", 0, most,
            "Position after the last element taken")};
  slice.outputs = {output("slice", "", 1, "The elements, with their ids")};
  nodes.push_back(slice);

  NodeInfo every = node(Structural::every, "seq.every", "Every n-th element.");
  every.inputs = {input("sequence", "", 1, "A sequence")};
  every.params = {
      param("step", ParamKind::integer, false, std::int64_t{2}, "1", 1, most, "Distance of the elements taken"),
      param("offset", ParamKind::integer, false, std::int64_t{0}, "1", 0, most, "Position of the first one")};
  every.outputs = {output("thinned", "", 1, "The elements, with their ids")};
  nodes.push_back(every);

  NodeInfo where = node(Structural::where, "seq.where", "The elements whose flag is true.");
  where.inputs = {input("sequence", "", 1, "A sequence"),
                  input("flags", "flag", 1, "A flag for every element, with the same ids")};
  where.outputs = {output("kept", "", 1, "The elements kept, with their ids")};
  nodes.push_back(where);

  NodeInfo pick = node(Structural::pick, "seq.pick", "One element, by an id that a node finds or a parameter gives.");
  pick.inputs = {input("sequence", "", 1, "A sequence"),
                 input("id", "text", 0, "Id of the element, as a node found it")};
  pick.inputs[1].optional = true;
  pick.params = {param("element", ParamKind::string, false, std::string(), "", 0, 0,
                       "Id of the element, where no node gives one; empty = the first")};
  pick.outputs = {output("picked", "", 0, "The element")};
  nodes.push_back(pick);

  NodeInfo flatten =
      node(Structural::flatten, "seq.flatten", "The elements of all inner sequences in one; ids join with a dot.");
  flatten.inputs = {input("sequences", "", 2, "A sequence of sequences")};
  flatten.outputs = {output("flat", "", 1, "All elements, in order")};
  nodes.push_back(flatten);

  NodeInfo merge =
      node(Structural::merge, "seq.merge", "The elements of several sequences in one, ordered by id; ids must differ.");
  merge.inputs = {alternatives("sequences", 1, "Sequences of one type")};
  merge.outputs = {output("merged", "", 1, "All elements, integers before names")};
  nodes.push_back(merge);

  NodeInfo ids = node(Structural::ids, "seq.ids", "The ids of a sequence, as texts.");
  ids.inputs = {input("sequence", "", 1, "A sequence")};
  ids.outputs = {output("ids", "text", 1, "Every element's id")};
  nodes.push_back(ids);

  NodeInfo first = node(Structural::first, "first", "The first of its inputs that is present.");
  first.inputs = {alternatives("alternatives", 0, "Values of one type, best first")};
  first.outputs = {output("chosen", "", 0, "The first present one")};
  nodes.push_back(first);

  return nodes;
}

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n')
      out += "\\n";
    else
      out += c;
  }
  return out + "\"";
}

std::string plain(bool value) { return value ? "true" : "false"; }
std::string plain(std::int64_t value) { return std::to_string(value); }
std::string plain(const std::string& value) { return quoted(value); }
std::string plain(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}
template <class T>
std::string plain(const std::vector<T>& values) {
  std::string out = "[";
  for (std::size_t i = 0; i < values.size(); ++i) out += (i == 0 ? "" : ", ") + plain(static_cast<T>(values[i]));
  return out + "]";
}

}  // namespace

int NodeInfo::find_input(std::string_view wanted) const { return find(inputs, wanted); }
int NodeInfo::find_param(std::string_view wanted) const { return find(params, wanted); }
int NodeInfo::find_output(std::string_view wanted) const { return find(outputs, wanted); }

const std::vector<NodeInfo>& structural_nodes() {
  static const std::vector<NodeInfo> nodes = make_structural_nodes();
  return nodes;
}

std::string to_text(const ParamValue& value) {
  return std::visit([](const auto& held) { return plain(held); }, value);
}

}  // namespace engine
