// SPDX-License-Identifier: Apache-2.0
// The page that annotate() fills with pictures. Its first script is free of the browser, so that it can be tried alone.
#include "nodes/track/annotate.h"

namespace face::track {

std::string_view annotate_page_head() {
  return R"html(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Facegraph: place points</title>
<style>
body { margin: 0; font: 14px system-ui, sans-serif; background: #1c1c1e; color: #e8e8e8; display: flex; height: 100vh; }
#left { flex: 1; display: flex; flex-direction: column; min-width: 0; }
#view { flex: 1; min-height: 0; display: block; cursor: crosshair; }
#bar { padding: 8px; display: flex; gap: 12px; align-items: center; }
#bar input { flex: 1; }
#side { width: 270px; padding: 10px; overflow: auto; background: #2a2a2d; }
li { list-style: none; padding: 2px 6px; border-radius: 4px; cursor: pointer; display: flex; justify-content: space-between; }
ul { margin: 6px 0; padding: 0; }
li.next { background: #3d5a80; } li.set span:first-child::before { content: "\25cf "; color: #6fdc6f; }
li.fixed span:first-child::before { content: "\25cf "; color: #ffb347; }
button { margin: 3px 3px 3px 0; padding: 5px 9px; background: #44464c; color: inherit; border: 1px solid #666; border-radius: 4px; }
small { color: #aaa; } kbd { background: #444; padding: 0 4px; border-radius: 3px; }
textarea { width: 100%; height: 90px; background: #1c1c1e; color: #ccc; border: 1px solid #555; box-sizing: border-box; }
</style></head><body>
<div id="left"><canvas id="view"></canvas>
<div id="bar"><b id="which"></b><input id="slider" type="range" min="0" value="0"><small id="where"></small></div></div>
<div id="side"><b id="task"></b><ul id="list"></ul>
<button id="save_points">Save points</button><button id="save_fixes">Save corrections</button>
<button id="undo">Undo</button>
<p><small>Click places the marked point, drag moves one. Wheel zooms, <kbd>Shift</kbd>+drag moves the picture.
<kbd>&larr;</kbd> <kbd>&rarr;</kbd> change the frame, <kbd>Del</kbd> takes the marked point back. On the first frame you place
points; on the others a point that you place or move is a correction.</small></p>
<textarea id="text" readonly></textarea></div>
<script id="logic">
"use strict";
// What is placed, without the browser: the data of the page in, JSON out.
function Model(data) {
  this.data = data;
  this.points = {};   // name -> [x, y] on the first frame
  this.fixes = JSON.parse(JSON.stringify(data.fixes || {}));   // frame -> name -> [x, y]
  this.past = [];
  const start = data.frames.length && data.frames[0].frame === 0 && data.frames[0].points;
  if (start) for (const p of data.points) if (start[p.name]) this.points[p.name] = start[p.name].slice(0, 2);
}
Model.prototype.remember = function () {
  this.past.push(JSON.stringify([this.points, this.fixes]));
  if (this.past.length > 500) this.past.shift();
};
Model.prototype.undo = function () {
  if (this.past.length) [this.points, this.fixes] = JSON.parse(this.past.pop());
};
// Pixels to the tenth, inside the image: its edge is half a pixel beyond the outermost centres.
Model.prototype.inside = function (xy) {
  const clamp = (v, size) => Math.round(Math.min(Math.max(v, -0.5), size - 0.5) * 10) / 10;
  return [clamp(xy[0], this.data.image_size[0]), clamp(xy[1], this.data.image_size[1])];
};
Model.prototype.place = function (frame, name, xy) {
  const at = this.inside(xy);
  if (frame === 0) this.points[name] = at;
  else (this.fixes[frame] = this.fixes[frame] || {})[name] = at;
};
Model.prototype.take_back = function (frame, name) {
  if (frame === 0) delete this.points[name];
  else if (this.fixes[frame]) {
    delete this.fixes[frame][name];
    if (!Object.keys(this.fixes[frame]).length) delete this.fixes[frame];
  }
};
// Where a point is on a frame, and by whom: {xy, by: "hand" | "fix" | "track" | "lost" | "start"}, or null.
Model.prototype.find = function (entry, name) {
  if (entry.frame === 0) return this.points[name] ? {xy: this.points[name], by: "hand"} : null;
  if (this.fixes[entry.frame] && this.fixes[entry.frame][name]) return {xy: this.fixes[entry.frame][name], by: "fix"};
  if (entry.points && entry.points[name])
    return {xy: entry.points[name].slice(0, 2), by: entry.points[name][2] ? "track" : "lost"};
  return this.points[name] ? {xy: this.points[name], by: "start"} : null;
};
// The first point that has no place yet; null when all have.
Model.prototype.next = function () {
  for (const p of this.data.points) if (!this.points[p.name]) return p.name;
  return null;
};
Model.prototype.nearest = function (entry, xy, radius) {
  let best = null, least = radius;
  for (const p of this.data.points) {
    const found = this.find(entry, p.name);
    if (!found) continue;
    const d = Math.hypot(found.xy[0] - xy[0], found.xy[1] - xy[1]);
    if (d <= least) { least = d; best = p.name; }
  }
  return best;
};
Model.prototype.points_json = function () {
  const points = {};
  for (const p of this.data.points) if (this.points[p.name]) points[p.name] = this.points[p.name];
  return JSON.stringify({frame: 0, image_size: this.data.image_size, points: points}, null, 1) + "\n";
};
Model.prototype.fixes_json = function () {
  const list = [];
  for (const frame of Object.keys(this.fixes).map(Number).sort((a, b) => a - b))
    for (const p of this.data.points)
      if (this.fixes[frame][p.name]) list.push({frame: frame, point: p.name, xy: this.fixes[frame][p.name]});
  return JSON.stringify(list, null, 1) + "\n";
};
</script>
<script id="data">
const DATA = )html";
}

std::string_view annotate_page_tail() {
  return R"html(;
</script>
<script>
"use strict";
const model = new Model(DATA), $ = id => document.getElementById(id), view = $("view"), pen = view.getContext("2d");
const pictures = DATA.frames.map(f => { const i = new Image(); i.onload = draw; i.src = f.picture; return i; });
let at = 0, marked = model.next() || DATA.points[0].name, zoom = 0, origin = [0, 0], held = null;
const COLOURS = {hand: "#6fdc6f", fix: "#ffb347", track: "#5bc0ff", lost: "#ff5b5b", start: "#999"};
$("slider").max = DATA.frames.length - 1;

// (0, 0) is the centre of the top left pixel.
const to_screen = xy => [(xy[0] + 0.5) * zoom + origin[0], (xy[1] + 0.5) * zoom + origin[1]];
const to_image = (x, y) => [(x - origin[0]) / zoom - 0.5, (y - origin[1]) / zoom - 0.5];
function fit() {
  view.width = view.clientWidth; view.height = view.clientHeight;
  zoom = Math.min(view.width / DATA.image_size[0], view.height / DATA.image_size[1]);
  origin = [(view.width - zoom * DATA.image_size[0]) / 2, (view.height - zoom * DATA.image_size[1]) / 2];
}
function draw() {
  const entry = DATA.frames[at];
  pen.fillStyle = "#111"; pen.fillRect(0, 0, view.width, view.height);
  pen.imageSmoothingEnabled = zoom < 6;
  if (pictures[at].complete) pen.drawImage(pictures[at], origin[0], origin[1], zoom * DATA.image_size[0], zoom * DATA.image_size[1]);
  for (const p of DATA.points) {
    const found = model.find(entry, p.name);
    if (!found) continue;
    const [x, y] = to_screen(found.xy);
    pen.strokeStyle = pen.fillStyle = COLOURS[found.by];
    pen.lineWidth = p.name === marked ? 2.5 : 1.2;
    pen.beginPath(); pen.arc(x, y, 6, 0, 7); pen.moveTo(x - 9, y); pen.lineTo(x + 9, y); pen.moveTo(x, y - 9); pen.lineTo(x, y + 9); pen.stroke();
    if (zoom > 2.2 || p.name === marked) pen.fillText(p.name, x + 9, y - 7);
  }
  $("which").textContent = "frame " + entry.frame;
  $("slider").value = at;
  const hint = DATA.points.find(p => p.name === marked);
  $("task").textContent = marked + ": " + hint.hint;
  $("list").innerHTML = "";
  for (const p of DATA.points) {
    const found = model.find(entry, p.name), item = document.createElement("li");
    item.className = (p.name === marked ? "next " : "") + (found && found.by === "hand" ? "set" : found && found.by === "fix" ? "fixed" : "");
    item.innerHTML = "<span></span><small></small>";
    item.firstChild.textContent = p.name;
    item.lastChild.textContent = found ? found.xy.map(v => v.toFixed(1)).join(", ") : "";
    item.onclick = () => { marked = p.name; draw(); };
    $("list").appendChild(item);
  }
  $("text").value = entry.frame === 0 ? model.points_json() : model.fixes_json();
}
function go(to) { at = Math.min(Math.max(to, 0), DATA.frames.length - 1); draw(); }
function save(name, text) {
  const a = document.createElement("a");
  a.href = URL.createObjectURL(new Blob([text], {type: "application/json"}));
  a.download = name; a.click();
  $("text").value = text;
}
const mouse = e => { const r = view.getBoundingClientRect(); return [e.clientX - r.left, e.clientY - r.top]; };
view.onmousedown = e => {
  const [x, y] = mouse(e), entry = DATA.frames[at];
  if (e.shiftKey || e.button === 1) { held = {pan: [x - origin[0], y - origin[1]]}; return; }
  if (e.button !== 0) return;
  model.remember();
  const near = model.nearest(entry, to_image(x, y), 9 / zoom);
  if (near) { marked = near; held = {name: near, moved: false}; draw(); return; }
  model.place(entry.frame, marked, to_image(x, y));
  held = {name: marked, moved: true, fresh: entry.frame === 0};
  draw();
};
window.onmousemove = e => {
  const [x, y] = mouse(e), xy = to_image(x, y);
  $("where").textContent = xy.map(v => v.toFixed(1)).join(", ");
  if (!held) return;
  if (held.pan) origin = [x - held.pan[0], y - held.pan[1]];
  else { model.place(DATA.frames[at].frame, held.name, xy); held.moved = true; }
  draw();
};
window.onmouseup = () => {
  if (held && held.name && !held.moved) model.past.pop();
  if (held && held.fresh) marked = model.next() || marked;
  held = null; draw();
};
view.onwheel = e => {
  e.preventDefault();
  const [x, y] = mouse(e), factor = Math.exp(-e.deltaY * 0.0015), to = Math.min(Math.max(zoom * factor, 0.2), 60);
  origin = [x - (x - origin[0]) * to / zoom, y - (y - origin[1]) * to / zoom];
  zoom = to; draw();
};
window.onkeydown = e => {
  if (e.key === "ArrowRight") go(at + 1);
  else if (e.key === "ArrowLeft") go(at - 1);
  else if (e.key === "Delete" || e.key === "Backspace") { model.remember(); model.take_back(DATA.frames[at].frame, marked); draw(); }
  else if (e.key === "z" && (e.ctrlKey || e.metaKey)) { model.undo(); draw(); }
  else return;
  e.preventDefault();
};
$("slider").oninput = () => go(+$("slider").value);
$("undo").onclick = () => { model.undo(); draw(); };
$("save_points").onclick = () => save("points.json", model.points_json());
$("save_fixes").onclick = () => save("corrections.json", model.fixes_json());
window.onresize = () => { fit(); draw(); };
fit(); draw();
</script></body></html>
)html";
}

}  // namespace face::track
