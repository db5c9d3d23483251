#pragma once

// The fixed parts of the HTML page of a chart: its style and its script.
namespace linewright::gantt {

inline constexpr const char* kPageStyle = R"css(
:root{color-scheme:light dark;--paper:#fff;--ink:#18212b;--muted:#5b6876;--line:#d5dce3;--card:#f6f8fa;--pick:#0b63ce}
@media (prefers-color-scheme:dark){:root{--paper:#12161b;--ink:#e9eef3;--muted:#98a5b3;--line:#36404a;--card:#1b2128;--pick:#6db3ff}}
*{box-sizing:border-box}
body{margin:0;padding:20px 24px 32px;background:var(--paper);color:var(--ink);
font:13px/1.45 system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans","Helvetica Neue",Arial,sans-serif}
h1{font-size:20px;font-weight:650;margin:0}
.facts{color:var(--muted);margin:2px 0 14px}
.bar-of-tools,.legend{display:flex;flex-wrap:wrap;gap:4px 6px;align-items:center;margin:0 0 8px}
button{font:inherit;color:inherit;background:none;border:1px solid transparent;border-radius:6px;padding:2px 8px;
display:inline-flex;align-items:center;gap:6px;cursor:pointer}
button:hover{background:var(--card);border-color:var(--line)}
button[aria-pressed=true]{background:var(--card);border-color:var(--pick)}
button:focus-visible,#chart:focus-visible{outline:2px solid var(--pick);outline-offset:1px}
.tools button{border-color:var(--line);min-width:30px;justify-content:center}
.sample{display:inline-flex;align-items:center;gap:6px;padding:2px 8px;color:var(--muted)}
.hint{color:var(--muted);margin:10px 0 0}
kbd{font:11px ui-monospace,monospace;border:1px solid var(--line);border-radius:4px;padding:0 4px}
#frame{width:100%;overflow-x:auto}
#chart{display:block}
#chart .plot{cursor:grab;touch-action:pan-y}
#chart .plot.pulled{cursor:grabbing}
#chart .picked{stroke:var(--pick);stroke-width:2.5;stroke-opacity:1}
#chart.some .bar,#chart.some .name{opacity:.16}
#chart.some .bar.chosen,#chart.some .name.chosen{opacity:1}
.brush{fill:var(--pick);fill-opacity:.18;stroke:var(--pick)}
#tip{position:fixed;z-index:2;max-width:380px;pointer-events:none;background:var(--paper);color:var(--ink);
border:1px solid var(--line);border-radius:8px;box-shadow:0 4px 18px rgba(0,0,0,.22);padding:7px 10px}
#tip b{display:block;overflow-wrap:anywhere}
#tip span{color:var(--muted)}
#tip i{font-style:normal;display:inline-block;max-width:100%;overflow-wrap:anywhere}
.unseen{position:absolute;width:1px;height:1px;overflow:hidden;clip-path:inset(50%)}
)css";

// Text reaches the page only as text nodes and attribute values; the script never builds markup.
inline constexpr const char* kPageScript = R"js(
"use strict";
(() => {
  const byId = (id) => document.getElementById(id);
  const chart = byId("chart"), frame = byId("frame"), tip = byId("tip"), said = byId("said");
  const plot = chart.querySelector("svg.plot"), ticks = plot.querySelector(".ticks");
  const last = Number(chart.dataset.last), secondsPerTick = Number(chart.dataset.tick);
  const gutter = Number(chart.dataset.gutter), right = Number(chart.dataset.right);
  const bottom = Number(ticks.dataset.bottom), top = Number(ticks.dataset.top);
  const axisHeight = 48, overhang = 6, thinnest = 1.6, shortestView = Math.min(last, 10);
  const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
  const pen = document.createElement("canvas").getContext("2d");
  pen.font = "10px " + getComputedStyle(document.body).fontFamily;
  const widths = new Map();
  const widthOf = (words) => {
    if (!widths.has(words)) widths.set(words, pen.measureText(words).width);
    return widths.get(words);
  };

  // Everything that has a place in time.
  const items = [...plot.querySelectorAll("[data-b]")].map((node) => {
    const title = node.querySelector("title");
    const item = {node, begin: Number(node.dataset.b), end: Number(node.dataset.e ?? node.dataset.b),
                  kind: node.tagName, text: title ? title.textContent : "", y: 0};
    if (title) title.remove();  // the page has its own tip
    if (node.transform.baseVal.numberOfItems) item.y = node.transform.baseVal.getItem(0).matrix.f;
    node.lwItem = item;
    return item;
  });
  const rows = [...plot.querySelectorAll(".row")]
    .map((row) => [...row.querySelectorAll("[data-b]")].map((node) => node.lwItem).filter((i) => i.text))
    .filter((row) => row.length)
    .sort((a, b) => a[0].node.getBoundingClientRect().top - b[0].node.getBoundingClientRect().top);

  let width = 0, from = 0, to = last, picked = null, waiting = false;
  const xOf = (tick) => (tick - from) / (to - from) * width;
  const tickAt = (x) => from + x / width * (to - from);

  function beginningOf(words, room) {
    if (room < 42) return "";
    let length = Math.min(words.length, Math.floor(room / 3));
    while (length > 0 && widthOf(words.slice(0, length) + "…") > room) --length;
    return length > 2 ? words.slice(0, length) + "…" : "";
  }

  function drawLabel(item) {
    const left = Math.max(0, xOf(item.begin)), end = Math.min(width, xOf(item.end)), room = end - left;
    const {l, s} = item.node.dataset;
    const words = widthOf(l) + 4 <= room ? l : s ? (widthOf(s) + 2 <= room ? s : "") : beginningOf(l, room - 4);
    item.node.textContent = words;
    if (words) item.node.setAttribute("x", (left + end) / 2);
  }

  // Decisions come in order of time; a number without room stays away.
  let free = -overhang;
  function drawNumber(item) {
    const x = xOf(item.begin), half = widthOf(item.node.textContent) / 2;
    if (x - half < free) return item.node.style.display = "none";
    item.node.setAttribute("x", x);
    free = x + half + 3;
  }

  function drawItem(item) {
    const hidden = item.end < from || item.begin > to;
    item.node.style.display = hidden ? "none" : "";
    if (hidden) return;
    if (item.kind === "text") return item.node.dataset.l === undefined ? drawNumber(item) : drawLabel(item);
    if (item.kind !== "rect") return item.node.setAttribute("transform", `translate(${xOf(item.begin)} ${item.y})`);
    const left = clamp(xOf(item.begin), -9, width + 9), end = clamp(xOf(item.end), -9, width + 9);
    item.node.setAttribute("x", left);
    item.node.setAttribute("width", Math.max(thinnest, end - left));
  }

  function make(name, attributes, words) {
    const node = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const key in attributes) node.setAttribute(key, attributes[key]);
    if (words !== undefined) node.textContent = words;
    return node;
  }

  function drawTicks() {
    let step = 1;
    for (let power = 1; width * step / (to - from) < 58; power *= 10) {
      step = [2, 5, 10].map((f) => f * power).find((s) => width * s / (to - from) >= 58) ?? 10 * power;
    }
    const done = plot.querySelector(".done"), end = done ? xOf(done.lwItem.begin) : Infinity;
    const nodes = [];
    for (let tick = Math.ceil(from / step) * step; tick <= to; tick += step) {
      const x = xOf(tick), near = x > end - 86 && x < end + 20;
      nodes.push(make("path", {class: "grid", d: `M${x} ${top}V${bottom}`}));
      const look = {class: "small mid muted", x};
      if (!near) nodes.push(make("text", {...look, y: 13}, tick));
      nodes.push(make("text", {...look, y: bottom + 14}, tick));
    }
    ticks.replaceChildren(...nodes);
  }

  function draw() {
    waiting = false;
    drawTicks();
    free = -overhang;
    items.forEach(drawItem);
    if (picked) showTip(picked);
  }
  function redraw() {
    if (!waiting) requestAnimationFrame(draw);
    waiting = true;
  }
  function show(begin, end) {
    const span = clamp(end - begin, shortestView, last);
    from = clamp(begin, 0, last - span);
    to = from + span;
    redraw();
  }
  const zoom = (factor, around) => show(around - (around - from) * factor, around + (to - around) * factor);
  const pan = (share) => show(from + share * (to - from), to + share * (to - from));
  function fit() {
    width = Math.max(300, frame.clientWidth - gutter - right);
    chart.setAttribute("width", gutter + width + right);
    plot.setAttribute("width", width + 2 * overhang);
    plot.setAttribute("viewBox", `${-overhang} 0 ${width + 2 * overhang} ${chart.getAttribute("height")}`);
    redraw();
  }

  // What the mouse or the keyboard points at.
  function fillTip(item) {
    const parts = item.text.split(" · "), head = document.createElement("b");
    const rest = document.createElement("span"), ticksLong = item.end - item.begin;
    head.textContent = parts.slice(0, 2).join(" · ");
    const length = ticksLong ? [`${ticksLong} tick${ticksLong === 1 ? "" : "s"} = ${+(ticksLong * secondsPerTick).toFixed(3)} s`] : [];
    for (const part of [...parts.slice(2), ...length]) {
      const word = document.createElement("i");
      word.textContent = part;
      rest.append(...(rest.childNodes.length ? [" · ", word] : [word]));
    }
    tip.replaceChildren(head, rest);
  }
  function placeTip(x, y) {
    tip.hidden = false;
    const box = tip.getBoundingClientRect();
    tip.style.left = clamp(x + 14, 4, innerWidth - box.width - 4) + "px";
    tip.style.top = (y + 18 + box.height < innerHeight ? y + 18 : Math.max(4, y - box.height - 12)) + "px";
  }
  function showTip(item) {
    const box = item.node.getBoundingClientRect();
    fillTip(item);
    placeTip(clamp(box.left, 0, innerWidth), box.bottom - 8);
  }
  function pick(item) {
    if (picked) picked.node.classList.remove("picked");
    picked = item;
    tip.hidden = true;
    if (!item) return;
    item.node.classList.add("picked");
    item.node.scrollIntoView?.({block: "nearest"});
    said.textContent = item.text;
    if (item.begin < from || item.end > to) {
      const middle = (item.begin + item.end) / 2, half = Math.max(to - from, item.end - item.begin) / 2;
      show(middle - half, middle + half);
    }
    showTip(item);
  }
  function pickBeside(rowStep, itemStep) {
    if (!rows.length) return;
    let row = picked ? rows.findIndex((r) => r.includes(picked)) : -1;
    if (row < 0) return pick(rows[0].find((i) => i.end > from) ?? rows[0][0]);
    if (itemStep) return pick(rows[row][clamp(rows[row].indexOf(picked) + itemStep, 0, rows[row].length - 1)]);
    row = clamp(row + rowStep, 0, rows.length - 1);
    const gap = (i) => Math.abs(i.begin + i.end - picked.begin - picked.end);
    pick(rows[row].reduce((a, b) => gap(b) < gap(a) ? b : a));
  }
  function highlight(task) {
    chart.classList.toggle("some", task !== null);
    for (const item of items) item.node.classList.toggle("chosen", item.node.dataset.t === task);
    for (const button of document.querySelectorAll("button[data-task]")) {
      button.setAttribute("aria-pressed", String(button.dataset.task === task));
    }
  }

  plot.addEventListener("pointermove", (event) => {
    const item = event.target.lwItem;
    if (pulling || !item || !item.text) { if (!picked) tip.hidden = true; return; }
    if (picked) pick(null);
    fillTip(item);
    placeTip(event.clientX, event.clientY);
  });
  plot.addEventListener("pointerleave", () => { if (!picked) tip.hidden = true; });
  plot.addEventListener("wheel", (event) => {
    event.preventDefault();
    const sideways = event.shiftKey ? event.deltaX || event.deltaY : event.deltaX;
    if (Math.abs(sideways) > Math.abs(event.shiftKey ? 0 : event.deltaY)) return pan(sideways / width);
    zoom(Math.exp(clamp(event.deltaY, -200, 200) * 0.002), tickAt(offset(event)));
  }, {passive: false});
  plot.addEventListener("dblclick", () => show(0, last));

  // Pulling the rows moves the view; pulling along the axis zooms to what was marked.
  let pulling = null;
  const offset = (event) => event.clientX - chart.getBoundingClientRect().left - gutter;
  plot.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    const marking = event.clientY - chart.getBoundingClientRect().top < axisHeight;
    pulling = {x: offset(event), from, to, brush: null};
    if (marking) plot.append(pulling.brush = make("rect", {class: "brush", y: 0, height: bottom}));
    plot.setPointerCapture(event.pointerId);
    plot.classList.add("pulled");
    pick(null);
  });
  plot.addEventListener("pointermove", (event) => {
    if (!pulling) return;
    const x = clamp(offset(event), 0, width);
    if (pulling.brush) {
      pulling.brush.setAttribute("x", Math.min(x, pulling.x));
      pulling.brush.setAttribute("width", Math.abs(x - pulling.x));
    } else {
      const shift = (pulling.x - offset(event)) / width * (pulling.to - pulling.from);
      show(pulling.from + shift, pulling.to + shift);
    }
  });
  const release = (event) => {
    if (!pulling) return;
    const {brush, x} = pulling, end = clamp(offset(event), 0, width);
    pulling = null;
    plot.classList.remove("pulled");
    if (!brush) return;
    brush.remove();
    if (Math.abs(end - x) > 4) show(tickAt(Math.min(x, end)), tickAt(Math.max(x, end)));
  };
  plot.addEventListener("pointerup", release);
  plot.addEventListener("pointercancel", release);

  const middle = () => picked ? clamp((picked.begin + picked.end) / 2, from, to) : (from + to) / 2;
  const keys = {
    "+": () => zoom(0.7, middle()), "=": () => zoom(0.7, middle()), "-": () => zoom(1 / 0.7, middle()),
    "0": () => show(0, last), "Home": () => show(0, to - from), "End": () => show(last - (to - from), last),
    "ArrowLeft": (event) => event.shiftKey ? pan(-0.2) : pickBeside(0, -1),
    "ArrowRight": (event) => event.shiftKey ? pan(0.2) : pickBeside(0, 1),
    "ArrowUp": () => pickBeside(-1, 0), "ArrowDown": () => pickBeside(1, 0),
    "Escape": () => { pick(null); highlight(null); },
  };
  chart.addEventListener("keydown", (event) => {
    const action = keys[event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action(event);
  });
  chart.addEventListener("blur", () => pick(null));
  byId("in").addEventListener("click", () => keys["+"]());
  byId("out").addEventListener("click", () => keys["-"]());
  byId("all").addEventListener("click", () => keys["0"]());
  for (const button of document.querySelectorAll("button[data-task]")) {
    button.addEventListener("click", () =>
      highlight(button.getAttribute("aria-pressed") === "true" ? null : button.dataset.task));
  }
  new ResizeObserver(fit).observe(frame);
  fit();
})();
)js";

}  // namespace linewright::gantt
