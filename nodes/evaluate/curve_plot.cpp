// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/curve_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/evaluate/animations.h"
#include "nodes/evaluate/draw_text.h"

namespace face::evaluate {
namespace {

constexpr int left_px = 64, right_px = 16, head_px = 26, gap_px = 12, axis_px = 26, phones_px = 46;
constexpr double text_px = 8;
constexpr std::array<Colour, 6> curve_colours = {
    {{255, 176, 64}, {96, 176, 255}, {130, 220, 130}, {240, 120, 140}, {190, 150, 250}, {220, 220, 120}}};

struct Curve {
  std::string name;
  std::vector<double> values;
};

struct Panel {
  std::string unit;
  std::vector<Curve> curves;
  double low = 0, high = 0;

  void set_range(const std::vector<bool>& seen) {
    for (const Curve& curve : curves)
      for (std::size_t i = 0; i < curve.values.size(); ++i)
        if (seen[i] && std::isfinite(curve.values[i])) {
          low = std::min(low, curve.values[i]);
          high = std::max(high, curve.values[i]);
        }
    if (high - low < 1e-9) high = low + 1;
    const double margin = 0.05 * (high - low);
    high += margin;
    if (low < 0) low -= margin;
  }
};

void add_panels(const Table& table, const char* name, std::size_t frames, std::vector<Panel>& panels) {
  check(table.rows.size() == frames, name, " has ", table.rows.size(), " rows, timeline has ", frames, " frames");
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    Curve curve{table.columns[c], {}};
    for (const TableRow& row : table.rows) {
      check(row.values.size() == table.columns.size(), name, ": row ", row.name, " has ", row.values.size(),
            " values, expected ", table.columns.size());
      curve.values.push_back(row.values[c]);
    }
    const std::size_t underline = curve.name.rfind('_');
    const std::string unit = underline == std::string::npos ? "" : curve.name.substr(underline + 1);
    auto panel = std::find_if(panels.begin(), panels.end(), [&](const Panel& p) { return p.unit == unit; });
    if (panel == panels.end()) panel = panels.insert(panels.end(), Panel{unit, {}});
    panel->curves.push_back(std::move(curve));
  }
}

class Plot {
 public:
  Plot(const Timeline& timeline, const CurvePlotOptions& options, int height_px)
      : times_(timeline.time_s),
        start_s_(options.start_s),
        end_s_(options.end_s > 0 ? options.end_s : std::max(timeline.duration_s, timeline.time_s.back())),
        width_px_(static_cast<int>(options.width_px)),
        canvas_(width_px_, height_px) {
    check(std::isfinite(end_s_) && end_s_ > start_s_, "the plot ends at ", end_s_, " s, expected more than its start, ",
          start_s_, " s");
  }

  std::vector<bool> seen() const {
    std::vector<bool> in;
    for (const double t : times_) in.push_back(t >= start_s_ && t <= end_s_);
    return in;
  }

  void draw_panel(const Panel& panel, int top, int height, const Phones* phones) {
    const int bottom = top + height;
    canvas_.fill(left_px, top, plot_px(), height, {32, 35, 40});
    const auto y_of = [&](double v) { return bottom - (v - panel.low) / (panel.high - panel.low) * height; };
    for (const double tick : ticks_between(panel.low, panel.high)) {
      canvas_.line({double(left_px), y_of(tick)}, {double(left_px + plot_px()), y_of(tick)},
                   tick == 0 ? pale_ink : grid_ink);
      canvas_.text(short_number(tick), {left_px - 6.0, y_of(tick) + 4}, text_px, pale_ink, Anchor::right);
    }
    if (phones)
      for (const Phone& phone : phones->phones)
        if (phone.start_s > start_s_ && phone.start_s < end_s_)
          canvas_.line({x_of(phone.start_s), double(top)}, {x_of(phone.start_s), double(bottom)}, grid_ink);
    for (std::size_t c = panel.curves.size(); c-- > 0;) draw_curve(panel.curves[c].values, colour_of(c), y_of);
    double x = left_px;
    for (std::size_t c = 0; c < panel.curves.size(); ++c) {
      canvas_.fill(static_cast<int>(x), top - 14, 18, 4, colour_of(c));
      x += 24 + 18 + canvas_.text(panel.curves[c].name, {x + 24, top - 8.0}, text_px + 1, ink);
    }
  }

  void draw_axis(int top) {
    for (const double tick : ticks_between(start_s_, end_s_)) {
      canvas_.line({x_of(tick), double(top)}, {x_of(tick), top + 4.0}, pale_ink);
      canvas_.text(short_number(tick) + " s", {x_of(tick), top + 17.0}, text_px, pale_ink, Anchor::middle);
    }
  }

  void draw_phones(const Phones& phones, int top) {
    std::string word;
    double word_start_s = 0;
    for (std::size_t i = 0; i <= phones.phones.size(); ++i) {
      const bool ends = i == phones.phones.size();
      if (ends || phones.phones[i].word != word) {
        const double until_s = ends ? phones.duration_s : phones.phones[i].start_s;
        if (!word.empty()) label(word, word_start_s, until_s, top + 38, ink);
        if (ends) break;
        word = phones.phones[i].word;
        word_start_s = phones.phones[i].start_s;
      }
      const Phone& phone = phones.phones[i];
      if (phone.end_s <= start_s_ || phone.start_s >= end_s_ || phone.label == "SIL") continue;
      const int x = static_cast<int>(std::lround(x_of(phone.start_s)));
      const int width = static_cast<int>(std::lround(x_of(phone.end_s))) - x;
      canvas_.fill(x, top, std::max(1, width - 1), 18, phone_colour(phone.label));
      label(phone.label, phone.start_s, phone.end_s, top + 13, ink);
    }
  }

  Image image() const { return canvas_.image(); }

 private:
  int plot_px() const { return width_px_ - left_px - right_px; }
  double x_of(double time_s) const {
    return left_px + std::clamp((time_s - start_s_) / (end_s_ - start_s_), 0.0, 1.0) * plot_px();
  }
  static Colour colour_of(std::size_t c) { return curve_colours[c % curve_colours.size()]; }
  // What must close, and what must be bitten, stands out.
  static Colour phone_colour(const std::string& label) {
    for (const char* lips : {"P", "B", "M", "P.c", "B.c"})
      if (label == lips) return {150, 60, 60};
    for (const char* teeth : {"F", "V"})
      if (label == teeth) return {120, 90, 30};
    return {52, 60, 76};
  }

  template <class YOf>
  void draw_curve(const std::vector<double>& values, const Colour& colour, const YOf& y_of) {
    for (std::size_t i = 1; i < values.size(); ++i) {
      if (times_[i - 1] < start_s_ || times_[i] > end_s_) continue;
      if (!std::isfinite(values[i - 1]) || !std::isfinite(values[i])) continue;
      canvas_.line({x_of(times_[i - 1]), y_of(values[i - 1])}, {x_of(times_[i]), y_of(values[i])}, colour, 2);
    }
  }

  void label(const std::string& text, double from_s, double to_s, int base_px, const Colour& colour) {
    const double room = x_of(to_s) - x_of(from_s);
    if (room < 0.9 * text_px * static_cast<double>(text.size())) return;
    canvas_.text(text, {(x_of(from_s) + x_of(to_s)) / 2, double(base_px)}, text_px, colour, Anchor::middle);
  }

  std::vector<double> times_;
  double start_s_, end_s_;
  int width_px_;
  Canvas canvas_;
};

}  // namespace

Image curve_plot(const Table& curves, const Table* more, const Timeline& timeline, const Phones* phones,
                 const CurvePlotOptions& options) {
  check(!timeline.time_s.empty(), "timeline has no frames to draw");
  check_times(timeline.time_s.size(), timeline, "timeline");
  if (phones)
    for (std::size_t i = 0; i < phones->phones.size(); ++i)
      check(std::isfinite(phones->phones[i].start_s) && std::isfinite(phones->phones[i].end_s), "phone ", i, " (",
            phones->phones[i].label, ") lasts from ", phones->phones[i].start_s, " to ", phones->phones[i].end_s,
            " s, expected finite times");
  std::vector<Panel> panels;
  add_panels(curves, "curves", timeline.time_s.size(), panels);
  std::vector<Panel> further;
  if (more) add_panels(*more, "more", timeline.time_s.size(), further);
  panels.insert(panels.end(), further.begin(), further.end());
  check(!panels.empty(), "curves has no columns to draw");
  const int panel_px = static_cast<int>(options.panel_px), count = static_cast<int>(panels.size());
  const int height_px = count * (head_px + panel_px + gap_px) + axis_px + (phones ? phones_px : 0);
  Plot plot(timeline, options, height_px);
  int top = 0;
  for (Panel& panel : panels) {
    panel.set_range(plot.seen());
    plot.draw_panel(panel, top + head_px, panel_px, phones);
    top += head_px + panel_px + gap_px;
  }
  plot.draw_axis(top - gap_px + 2);
  if (phones) plot.draw_phones(*phones, top + axis_px - 6);
  return plot.image();
}

}  // namespace face::evaluate
