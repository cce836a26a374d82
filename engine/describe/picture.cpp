// SPDX-License-Identifier: Apache-2.0
#include "engine/describe/picture.h"

#include <cstdio>
#include <filesystem>

#include "engine/describe/describe.h"
#include "engine/describe/layers.h"

namespace engine {
namespace {

struct Box {
  std::string kind;  // "file", "node", "output"
  std::string name, detail, tip, tone, link;
  std::vector<std::string> lines;
  bool pale = false;
};
struct Arrow {
  int from, to;
  std::string tip;
  bool sequence = false;
};
struct Drawing {
  std::vector<Box> boxes;
  std::vector<Arrow> arrows;
};

Drawing drawing_of(const Graph& graph, const std::map<std::string, BoxNote>& notes) {
  Drawing drawing;
  for (const GraphNode& node : graph.nodes) {
    Box box{"node", node.id, node.info->name, node.info->doc, "", "", {}, !node.needed};
    if (const auto note = notes.find(node.id); note != notes.end()) {
      box.lines = note->second.lines;
      box.tone = note->second.tone;
      box.link = note->second.link;
    }
    drawing.boxes.push_back(std::move(box));
  }
  std::map<std::string, int> files;
  const auto connect = [&](const Source& source, int to, const std::string& port) {
    if (source.kind == Source::Kind::none) return;
    if (source.kind == Source::Kind::file) {
      const auto [at, fresh] = files.emplace(source.path, static_cast<int>(drawing.boxes.size()));
      if (fresh)
        drawing.boxes.push_back(
            {"file", std::filesystem::path(source.path).filename().string(), "", source.shown_path, "", "", {}, true});
      if (to >= static_cast<int>(graph.nodes.size()) || graph.nodes[static_cast<std::size_t>(to)].needed)
        drawing.boxes[static_cast<std::size_t>(at->second)].pale = false;
      drawing.arrows.push_back({at->second, to, port, false});
      return;
    }
    const GraphNode& node = graph.nodes[static_cast<std::size_t>(source.node)];
    const auto output = static_cast<std::size_t>(source.output);
    std::string element;
    for (const std::string& id : source.element) element += (element.empty() ? "" : "/") + id;
    const int depth = node.output_depth[output] - static_cast<int>(source.element.size());
    drawing.arrows.push_back({source.node, to,
                              node.id + "." + node.info->outputs[output].name +
                                  (element.empty() ? "" : "[" + element + "]") + " \u2192 " + port + " (" +
                                  port_type(node.output_type[output], depth) + ")",
                              depth > 0});
  };
  for (std::size_t n = 0; n < graph.nodes.size(); ++n)
    for (std::size_t p = 0; p < graph.nodes[n].inputs.size(); ++p)
      for (const Source& source : graph.nodes[n].inputs[p])
        connect(source, static_cast<int>(n), graph.nodes[n].info->inputs[p].name);
  for (const GraphOutput& output : graph.outputs) {
    const int index = static_cast<int>(drawing.boxes.size());
    drawing.boxes.push_back({"output", output.name, "", "An output of the graph", "", "", {}, false});
    connect(output.source, index, output.name);
  }
  return drawing;
}

std::string fixed(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

// Cut so that it fits into a box: about 7 px a character at this size.
std::string fitted(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t end = most - 1;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "\u2026";
}

constexpr const char* style = R"(<style>
.fg text{font:12px system-ui,"Segoe UI",Helvetica,Arial,sans-serif;fill:#1d2733}
.fg .name{font-weight:600;font-size:13px}.fg .kind{fill:#5a6b7d}
.fg rect{fill:#fff;stroke:#8496a8}.fg .file rect{fill:#f3eedd;stroke:#b5a468}.fg .output rect{fill:#e2ecfa;stroke:#5a86c4}
.fg .run rect{fill:#fdf1dc;stroke:#d29a35}.fg .reused rect{fill:#e6f3e6;stroke:#6aa56a}.fg .failed rect{fill:#fbe0de;stroke:#c4453b}
.fg .pale{opacity:.4}.fg path{fill:none;stroke:#8496a8;stroke-width:1.3}.fg path.seq{stroke-width:2.6;stroke:#9fb0c1}.fg .head{fill:#8496a8;stroke:none}
</style>)";

}  // namespace

std::string escape_markup(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t')
      out += c;
  }
  return out;
}

std::string graph_svg(const Graph& graph, const std::map<std::string, BoxNote>& notes) {
  const Drawing drawing = drawing_of(graph, notes);
  constexpr double margin = 12, line_height = 16;
  const LayerSizes sizes;
  std::vector<LayerBox> boxes;
  for (const Box& box : drawing.boxes)
    boxes.push_back({14 + line_height * static_cast<double>(1 + !box.detail.empty() + box.lines.size())});
  std::vector<LayerEdge> edges;
  for (const Arrow& arrow : drawing.arrows) edges.push_back({arrow.from, arrow.to, {}});
  const LayerSize size = lay_out(boxes, edges, sizes);

  const std::string width = fixed(size.width + 2 * margin), height = fixed(size.height + 2 * margin);
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"fg\" role=\"img\" aria-label=\"Picture of the graph\" "
      "width=\"" +
      width + "\" height=\"" + height + "\" viewBox=\"0 0 " + width + " " + height + "\">\n" + style +
      "\n<defs><marker id=\"fg-head\" viewBox=\"0 0 8 8\" refX=\"8\" refY=\"4\" markerWidth=\"8\" "
      "markerHeight=\"8\" markerUnits=\"userSpaceOnUse\" orient=\"auto\"><path class=\"head\" d=\"M0 0L8 4L0 8z\"/>"
      "</marker></defs>\n<g transform=\"translate(" +
      fixed(margin) + " " + fixed(margin) + ")\">\n";
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Arrow& arrow = drawing.arrows[e];
    const LayerBox& from = boxes[static_cast<std::size_t>(arrow.from)];
    const LayerBox& to = boxes[static_cast<std::size_t>(arrow.to)];
    std::vector<std::pair<double, double>> points = {{from.x + sizes.box_width, from.y}};
    points.insert(points.end(), edges[e].bends.begin(), edges[e].bends.end());
    points.emplace_back(to.x, to.y);
    std::string path = "M" + fixed(points[0].first) + " " + fixed(points[0].second);
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double middle = (points[i - 1].first + points[i].first) / 2;
      path += "C" + fixed(middle) + " " + fixed(points[i - 1].second) + " " + fixed(middle) + " " +
              fixed(points[i].second) + " " + fixed(points[i].first) + " " + fixed(points[i].second);
    }
    const bool pale = drawing.boxes[static_cast<std::size_t>(arrow.to)].pale;
    svg += std::string("<path class=\"") + (arrow.sequence ? "seq" : "one") + (pale ? " pale" : "") + "\" d=\"" + path +
           "\" marker-end=\"url(#fg-head)\"><title>" + escape_markup(arrow.tip) + "</title></path>\n";
  }
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    const Box& box = drawing.boxes[b];
    const LayerBox& at = boxes[b];
    const double top = at.y - at.height / 2;
    svg += "<g class=\"" + box.kind + (box.tone.empty() ? "" : " " + box.tone) + (box.pale ? " pale" : "") +
           "\"><title>" + escape_markup(box.tip) + "</title>";
    if (!box.link.empty()) svg += "<a href=\"" + escape_markup(box.link) + "\">";
    svg += "<rect x=\"" + fixed(at.x) + "\" y=\"" + fixed(top) + "\" width=\"" + fixed(sizes.box_width) +
           "\" height=\"" + fixed(at.height) + "\" rx=\"" + (box.kind == "node" ? "4" : "14") + "\"/>";
    double line = top + 4;
    const auto write = [&](const std::string& text, const char* kind, std::size_t most) {
      line += line_height;
      svg += "<text class=\"" + std::string(kind) + "\" x=\"" + fixed(at.x + 10) + "\" y=\"" + fixed(line) + "\">" +
             escape_markup(fitted(text, most)) + "</text>";
    };
    write(box.name, "name", 23);
    if (!box.detail.empty()) write(box.detail, "kind", 27);
    for (const std::string& text : box.lines) write(text, "note", 29);
    svg += box.link.empty() ? "</g>\n" : "</a></g>\n";
  }
  return svg + "</g>\n</svg>\n";
}

std::string graph_dot(const Graph& graph) {
  const Drawing drawing = drawing_of(graph, {});
  const auto quoted = [](const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
      if (c == '"' || c == '\\') out += '\\';
      out += c;
    }
    return out + "\"";
  };
  std::string dot = "digraph facegraph {\n  rankdir=LR;\n  node [shape=box, fontname=\"Helvetica\"];\n";
  for (std::size_t b = 0; b < drawing.boxes.size(); ++b) {
    const Box& box = drawing.boxes[b];
    std::string label = quoted(box.name);
    if (!box.detail.empty()) label.insert(label.size() - 1, "\\n" + box.detail);
    dot += "  b" + std::to_string(b) + " [label=" + label +
           (box.kind == "file"     ? ", shape=note"
            : box.kind == "output" ? ", shape=folder"
                                   : "") +
           (box.pale ? ", style=dashed" : "") + "];\n";
  }
  for (const Arrow& arrow : drawing.arrows)
    dot += "  b" + std::to_string(arrow.from) + " -> b" + std::to_string(arrow.to) + " [tooltip=" + quoted(arrow.tip) +
           (arrow.sequence ? ", penwidth=2" : "") + "];\n";
  return dot + "}\n";
}

}  // namespace engine
