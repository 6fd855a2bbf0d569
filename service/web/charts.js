"use strict";
// Charts of gyrod's pages: thin helpers around uPlot. No page needs more of uPlot than what is here.
const gyrodCharts = (() => {
  const live = new Set(); // charts on the page
  const page = { beforePrint() {} }; // what the page does before it is printed

  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const paint = (name) => () => colour(name);

  /// A number for people: 4 digits, powers of ten where there would be many zeros, a dash where there is none.
  function number(value, digits = 4) {
    if (value === null || value === undefined || Number.isNaN(value)) return "–";
    if (value === 0) return "0";
    if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
    const size = Math.abs(value);
    const text = size >= 1e-3 && size < 1e6 ? Number(value).toPrecision(digits) : Number(value).toExponential(digits - 1);
    const [mantissa, exponent] = (text.includes("e") && size >= 1e-3 && size < 1e6 ? String(Number(text)) : text).split("e");
    const minus = mantissa.replace("-", "−");
    if (exponent === undefined) return minus;
    const raised = String(Number(exponent)).replace(/./g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]));
    return `${minus}·10${raised}`;
  }

  const decade = (value) => {
    const power = Math.log10(value);
    return Math.abs(power - Math.round(power)) < 1e-9 ? number(value, 1) : "";
  };
  /// 1, 2 or 5 times a power of ten, the greatest that is not above the value.
  function round(value) {
    const power = 10 ** Math.floor(Math.log10(value));
    return [5, 2, 1].find((m) => m * power <= value * (1 + 1e-9)) * power;
  }

  /// Scale of a row: symmetric about 0 with one round mark on either side, whatever is zoomed.
  function symmetric(values) {
    const most = values.reduce((m, v) => Math.max(m, Math.abs(v ?? 0)), 0) || 1;
    const mark = round(most);
    return { range: [-1.1 * most, 1.1 * most], marks: [-mark, 0, mark] };
  }

  const tick = (value) => (value === 0 ? "0" : String(Number(value.toPrecision(6))).replace("-", "−"));

  function axis(spec, side) {
    const small = spec.small ?? false;
    return {
      show: spec.show ?? true,
      label: spec.label,
      labelSize: 20,
      labelFont: "12px system-ui, sans-serif",
      font: "11px system-ui, sans-serif",
      labelGap: 0,
      size: side === 3 ? 58 : 34,
      gap: 4,
      space: spec.log ? 24 : side === 3 ? (small ? 22 : 34) : 64,
      stroke: paint("--soft"),
      grid: { stroke: paint("--grid"), width: 1 },
      ticks: { stroke: paint("--line"), width: 1, size: 4 },
      values: (u, splits) => splits.map((v) => (v === null ? "" : spec.log ? decade(v) : tick(v))),
      ...(spec.whole ? { incrs: [1, 2, 5, 10] } : {}),
      ...(spec.marks ? { splits: () => spec.marks } : {}),
    };
  }

  function line(spec) {
    return {
      label: spec.label,
      scale: "y",
      stroke: spec.colour ? paint(spec.colour) : undefined,
      width: spec.width ?? 1.25,
      dash: spec.dash,
      show: spec.show ?? true,
      class: spec.unlisted ? "unlisted" : undefined,
      points: spec.points ? { show: true, size: 6, fill: paint(spec.colour), stroke: paint(spec.colour) } : { show: false },
      paths: spec.bars ? uPlot.paths.bars({ size: [0.6, 60] }) : undefined,
      fill: spec.bars ? paint(spec.colour) : undefined,
      value: (u, v) => number(v),
      spanGaps: false,
    };
  }

  /// Where both ends of a range are to be, moved by `shift` of its width and made `factor` as wide; log scales in decades.
  function moved(scale, shift, factor) {
    const log = scale.distr === 3;
    const [a, b] = log ? [Math.log10(scale.min), Math.log10(scale.max)] : [scale.min, scale.max];
    const middle = (a + b) / 2 + shift * (b - a);
    const half = ((b - a) / 2) * factor;
    const ends = [middle - half, middle + half];
    return log ? { min: 10 ** ends[0], max: 10 ** ends[1] } : { min: ends[0], max: ends[1] };
  }

  function zoom(charts, shift, factor) {
    for (const u of charts) {
      const first = u.data[0][0];
      const last = u.data[0][u.data[0].length - 1];
      const to = moved(u.scales.x, shift, factor);
      u.setScale("x", { min: Math.max(to.min, first), max: Math.min(to.max, last) });
    }
  }

  /// Gives a chart new data. One that shows all goes on to show all; one that is zoomed stays where it is.
  function refresh(u, data) {
    if (u.showsAll !== false) return u.setData(data, true);
    const { min, max } = u.scales.x;
    u.setData(data, false);
    u.setScale("x", { min, max });
  }

  function reset(charts) {
    for (const u of charts) u.setData(u.data, true);
  }

  const keys = {
    "+": (c) => zoom(c, 0, 0.5),
    "=": (c) => zoom(c, 0, 0.5),
    "-": (c) => zoom(c, 0, 2),
    ArrowLeft: (c) => zoom(c, -0.2, 1),
    ArrowRight: (c) => zoom(c, 0.2, 1),
    0: reset,
    Escape: reset,
  };

  /// Lets the plot be used by keyboard. `charts`: those that move together.
  function keyboard(element, charts) {
    element.tabIndex = 0;
    element.addEventListener("keydown", (event) => {
      const act = keys[event.key];
      if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      act(charts);
    });
  }

  /// The buttons of a figure, for those without mouse or keyboard.
  function tools(charts, title) {
    const bar = document.createElement("span");
    bar.className = "tools";
    const add = (text, label, act) => {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = text;
      button.setAttribute("aria-label", `${label}: ${title}`);
      button.addEventListener("click", () => act(charts));
      bar.append(button);
    };
    add("−", "Zoom out", (c) => zoom(c, 0, 2));
    add("+", "Zoom in", (c) => zoom(c, 0, 0.5));
    add("Reset", "Show all", reset);
    return bar;
  }

  function options(spec, width) {
    const marker = (u, i) => (spec.series[i - 1]?.colour ? `var(${spec.series[i - 1].colour})` : "");
    const log = (s) => (s.log ? { distr: 3, log: 10 } : {});
    const range = spec.y.range ? { range: spec.y.range } : {};
    const rangeOfAll = (min, max) => spec.x.range ?? (spec.x.log ? uPlot.rangeLog(min, max, 10, true) : [min, max]);
    const whole = (u, min, max) => {
      u.showsAll = min === null || (min === u.data[0][0] && max === u.data[0].at(-1));
      return !u.showsAll ? [min, max] : min === null ? (spec.x.range ?? [1, 10]) : rangeOfAll(min, max);
    };
    const fixed = spec.x.range || spec.live ? { range: whole } : {};
    return {
      width,
      height: spec.height,
      padding: spec.y.small ? [5, 22, 5, 0] : [8, 22, 0, 0],
      scales: { x: { time: false, ...log(spec.x), ...fixed }, y: { ...log(spec.y), ...range } },
      axes: [axis(spec.x, 2), axis(spec.y, 3)],
      series: [{ label: spec.x.label, value: (u, v) => number(v) }, ...spec.series.map(line)],
      bands: spec.bands?.map((b) => ({ series: b.series, fill: paint(b.colour) })),
      legend: { show: spec.legend ?? true, markers: { fill: marker, stroke: marker } },
      cursor: {
        y: false,
        drag: { x: true, y: false, setScale: true },
        points: { size: 5 },
        ...(spec.sync ? { sync: { key: spec.sync, scales: ["x", null] } } : {}),
      },
      hooks: {
        drawClear: spec.under ? [spec.under] : [],
        draw: spec.over ? [spec.over] : [],
        setSeries: [(u, index, what) => followBand(u, spec, index, what)],
      },
    };
  }

  /// A curve that is switched off in the legend takes its band with it.
  function followBand(u, spec, index, what) {
    if (index === null || what.show === undefined) return;
    for (const other of spec.series[index - 1]?.owns ?? []) {
      if (u.series[other].show !== what.show) u.setSeries(other, { show: what.show });
    }
  }

  /// Draws one chart into `host`, which it fills in width.
  /// spec: label (what a blind reader is told), height, live (its data will be refreshed), x and y {label, log, range, show, whole, small, marks}, series [{label, colour,
  /// width, dash, bars, points, unlisted, owns}], bands [{series, colour}], data [xs, ys...], sync, legend, under(u), over(u)
  function chart(host, spec) {
    const width = () => Math.max(host.clientWidth, 200);
    const u = new uPlot(options(spec, width()), spec.data, host);
    const canvas = host.querySelector("canvas");
    canvas.dataset.colours = spec.series.map((s) => s.colour).filter(Boolean).join(" ");
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", spec.label);
    for (const name of host.querySelectorAll(".u-legend th")) {
      name.tabIndex = 0;
      name.addEventListener("keydown", (event) => event.key === "Enter" && name.click());
    }
    u.fit = (to) => u.setSize({ width: to ?? width(), height: spec.height });
    const resized = new ResizeObserver(() => host.clientWidth > 0 && host.clientWidth !== u.width && !printing && u.fit());
    resized.observe(host);
    live.add(u);
    u.remove = () => {
      resized.disconnect();
      live.delete(u);
      u.destroy();
    };
    return u;
  }

  /// Helpers for under() and over(): places are in the canvas' own pixels.
  function verticalLine(u, x, name, text) {
    const at = Math.round(u.valToPos(x, "x", true));
    if (at < u.bbox.left || at > u.bbox.left + u.bbox.width) return;
    const { ctx } = u;
    ctx.save();
    ctx.strokeStyle = ctx.fillStyle = colour(name);
    ctx.setLineDash([6 * uPlot.pxRatio, 4 * uPlot.pxRatio]);
    ctx.lineWidth = 1.5 * uPlot.pxRatio;
    ctx.beginPath();
    ctx.moveTo(at, u.bbox.top);
    ctx.lineTo(at, u.bbox.top + u.bbox.height);
    ctx.stroke();
    const left = at < u.bbox.left + 0.75 * u.bbox.width; // there is room for the words on its right
    label(u, text, at + (left ? 5 : -5) * uPlot.pxRatio, u.bbox.top + 12 * uPlot.pxRatio, left ? "left" : "right");
    ctx.restore();
  }

  function horizontalLine(u, y, name, text) {
    const at = Math.round(u.valToPos(y, "y", true));
    if (at < u.bbox.top || at > u.bbox.top + u.bbox.height) return;
    const { ctx } = u;
    ctx.save();
    ctx.strokeStyle = ctx.fillStyle = colour(name);
    ctx.setLineDash([6 * uPlot.pxRatio, 4 * uPlot.pxRatio]);
    ctx.lineWidth = 1.5 * uPlot.pxRatio;
    ctx.beginPath();
    ctx.moveTo(u.bbox.left, at);
    ctx.lineTo(u.bbox.left + u.bbox.width, at);
    ctx.stroke();
    label(u, text, u.bbox.left + 6 * uPlot.pxRatio, at - 5 * uPlot.pxRatio);
    ctx.restore();
  }

  function stripe(u, from, to, alpha) {
    const top = u.valToPos(Math.min(to, u.scales.y.max), "y", true);
    const bottom = u.valToPos(Math.max(from, u.scales.y.min), "y", true);
    if (bottom <= top) return;
    const { ctx } = u;
    ctx.save();
    ctx.globalAlpha = alpha;
    ctx.fillStyle = colour("--accent");
    ctx.fillRect(u.bbox.left, top, u.bbox.width, bottom - top);
    ctx.restore();
  }

  /// Shades what lies between two places on the x axis, as far as it is in view.
  function shade(u, from, to, name) {
    const left = u.valToPos(Math.max(from, u.scales.x.min), "x", true);
    const right = u.valToPos(Math.min(to, u.scales.x.max), "x", true);
    if (!(right > left)) return;
    const { ctx } = u;
    ctx.save();
    ctx.fillStyle = colour(name);
    ctx.fillRect(left, u.bbox.top, right - left, u.bbox.height);
    ctx.restore();
  }

  /// A word at the right edge, at height y.
  function word(u, y, text) {
    const { ctx } = u;
    ctx.save();
    ctx.fillStyle = colour("--soft");
    label(u, text, u.bbox.left + u.bbox.width - 6 * uPlot.pxRatio, u.valToPos(y, "y", true) + 4 * uPlot.pxRatio, "right");
    ctx.restore();
  }

  function label(u, text, x, y, align = "left") {
    u.ctx.textAlign = align;
    u.ctx.textBaseline = "alphabetic";
    u.ctx.font = `${11 * uPlot.pxRatio}px system-ui, sans-serif`;
    u.ctx.fillText(text, x, y);
  }

  const redraw = () => live.forEach((u) => u.redraw(false, true));

  // Paper has its own width and is white, and none of it is known to a canvas: charts are drawn again for it.
  let printing = false;
  const kPaperWidth = 680; // px: A4 less margins at 96 px an inch
  function print(on) {
    printing = on;
    if (on) page.beforePrint();
    document.documentElement.classList.toggle("printing", on);
    for (const u of live) {
      const row = u.root.closest(".rows") !== null;
      u.fit(on ? kPaperWidth - (row ? 200 : 0) : undefined);
    }
    redraw();
  }
  window.addEventListener("beforeprint", () => print(true));
  window.addEventListener("afterprint", () => print(false));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);

  return { page, chart, refresh, tools, keyboard, number, colour, verticalLine, horizontalLine, shade, stripe, word, symmetric, tick };
})();
