"use strict";
// The figures of the report. Each function draws one into `parent`; `axis` is report.axes.x, .y or .z.
const reportFigures = (() => {
  const { chart, number, verticalLine, horizontalLine, stripe, word, symmetric } = gyrodCharts;
  const { element, frame, single } = gyrodParts;
  const kSchemeColours = { raw: "--raw", direct: "--direct", emd: "--emd", "acf-emd": "--acf-emd", improved: "--improved" };

  /// x values of a trace with even steps.
  const grid = (trace, values, start = 0) => values.map((_, i) => start + i * trace.step_s);

  /// One row a series under one another, all with the same time axis. rows: [{name, detail, className, xs, ys, colour}]
  function stack(parent, title, note, rows, x, unit, sync) {
    const { plot, finish } = frame(parent, title, note, "stack");
    plot.classList.add("rows");
    const charts = rows.map((row, i) => {
      const last = i === rows.length - 1;
      const name = element("div", undefined, "row-name");
      name.append(element("b", row.name), element("span", row.detail, row.className));
      const host = element("div");
      plot.append(name, host);
      return chart(host, {
        height: last ? 100 : 62,
        label: `${title}: ${row.name}, ${row.detail}`,
        x: { ...x, show: last, label: last ? x.label : "" },
        y: { label: "", small: true, ...(row.scale ?? {}) },
        series: [{ label: `${row.name}, ${unit}`, colour: row.colour, width: 1 }],
        data: [row.xs, row.ys],
        legend: false,
        sync,
      });
    });
    finish(charts);
  }

  function record(parent, name, axis) {
    const { trace } = axis.record;
    single(parent, `Fig. 3 · The record, ${name} axis`, undefined, {
      x: { label: "time, s" },
      y: { label: "rate, deg/s" },
      series: [{ label: "raw, deg/s", colour: "--raw", width: 1 }],
      data: [grid(trace, trace.values_dps), trace.values_dps],
    });
  }

  const imfDetail = (imf) => `${imf.class}, period ${number(imf.mean_period_s, 3)} s`;

  function imfs(parent, name, decomposition) {
    const rows = decomposition.imfs.map((imf) => ({
      name: `IMF ${imf.imf}`,
      detail: imfDetail(imf),
      className: `class-${imf.class}`,
      colour: `--${imf.class}`,
      xs: grid(imf.trace, imf.trace.values_dps),
      ys: imf.trace.values_dps,
      scale: symmetric(imf.trace.values_dps),
    }));
    const { trace } = decomposition.residue;
    rows.push({ name: "Residue", detail: "signal", className: "class-signal", colour: "--signal", xs: grid(trace, trace.values_dps), ys: trace.values_dps });
    const note = "Each row has its own scale, in deg/s. Colours and words: noise is dropped, mixed is filtered, signal is kept.";
    stack(parent, `Fig. 4 · Intrinsic mode functions, ${name} axis`, note, rows, { label: "time, s" }, "deg/s", `imfs-${name}`);
  }

  function acfs(parent, name, decomposition) {
    const rows = decomposition.imfs.map((imf) => ({
      name: `IMF ${imf.imf}`,
      detail: `${imf.class}, variance ${number(imf.acf_variance, 3)}`,
      className: `class-${imf.class}`,
      colour: `--${imf.class}`,
      xs: grid(imf.acf, imf.acf.values),
      ys: imf.acf.values,
      scale: { range: [-1.1, 1.1], marks: [-1, 0, 1] },
    }));
    const note = "Normalised: 1 at lag 0. Noise collapses at once, signal decays slowly and with structure.";
    stack(parent, `Fig. 6 · Autocorrelation of the IMFs, ${name} axis`, note, rows, { label: "lag, s" }, "ACF", `acf-${name}`);
  }

  function pcc(parent, name, decomposition) {
    const { imfs: all, j } = decomposition;
    const kBands = [[0, 0.2, "very weak"], [0.2, 0.4, "weak"], [0.4, 0.7, "moderate"], [0.7, 0.9, "strong"], [0.9, 1, "very strong"]];
    single(parent, `Fig. 5 · Correlation of each IMF with the record, ${name} axis`, `Shaded: very weak below 0.2, weak, moderate, strong, very strong from 0.9. Taken for noise: ${j > 0 ? `IMF 1 to ${j}, the last that is not very weak or, if less, k` : "none, as k = 0 or none is more than very weak"}.`, {
      x: { label: "IMF", whole: true, range: [0.4, all.length + 0.6] },
      y: { label: "|PCC|", range: [0, 1] },
      series: [{ label: "|PCC|", colour: "--accent", bars: true }],
      data: [all.map((imf) => imf.imf), all.map((imf) => Math.abs(imf.pcc))],
      under: (u) => kBands.forEach(([from, to], i) => stripe(u, from, to, 0.03 + 0.035 * i)),
      over: (u) => {
        if (u.width > 600) kBands.forEach(([from, to, text]) => word(u, (from + to) / 2, text));
        verticalLine(u, j + 0.5, "--noise", `j = ${j}`);
      },
    });
  }

  function acfVariance(parent, name, decomposition) {
    const { imfs: all, k, acf_variance_threshold: threshold } = decomposition;
    single(parent, `Fig. 7 · Variance of the autocorrelation, ${name} axis`, `Above ${threshold} an IMF is taken for signal: ${k < all.length ? `from IMF ${k + 1} on` : "none"}.`, {
      x: { label: "IMF", whole: true, range: [0.4, all.length + 0.6] },
      y: { label: "variance of the ACF", log: true },
      series: [{ label: "variance", colour: "--accent", points: true }],
      data: [all.map((imf) => imf.imf), all.map((imf) => imf.acf_variance || null)],
      over: (u) => {
        horizontalLine(u, threshold, "--signal", `threshold ${threshold}`);
        verticalLine(u, k + 0.5, "--mixed", `k = ${k}`);
      },
    });
  }

  function beforeAfter(parent, name, axis) {
    const { whole, detail } = axis.before_after;
    single(parent, `Figs 8, 9 · Before and after, ${name} axis`, undefined, {
      x: { label: "time, s" },
      y: { label: "rate, deg/s" },
      series: ["raw", "improved"].map((s) => ({ label: s, colour: kSchemeColours[s], width: s === "raw" ? 1 : 1.6 })),
      data: [grid(whole, whole.raw_dps), whole.raw_dps, whole.improved_dps],
    });
    const schemes = Object.keys(kSchemeColours);
    const times = grid(detail, detail.raw_dps, detail.start_s);
    const note = "Every sample, from the stretch in which the slow part moves most. Click a name below the plot to hide or show it.";
    single(parent, `Figs 8, 9 · ${gyrodCharts.tick(times.length * detail.step_s)} s of it with all schemes, ${name} axis`, note, {
      x: { label: "time, s" },
      y: { label: "rate, deg/s" },
      series: schemes.map((s) => ({ label: s, colour: kSchemeColours[s], width: s === "raw" ? 1 : 1.6 })),
      data: [times, ...schemes.map((s) => detail[`${s.replace("-", "_")}_dps`])],
    });
  }

  /// Curves one beside the other; the first and the last of them with their bands.
  function allan(parent, name, allanData) {
    const { curves } = allanData;
    const banded = curves.filter((c) => c.scheme === "raw" || c.scheme === "improved");
    const positive = (values) => values.map((v) => (v > 0 ? v : null));
    const series = curves.map((c) => ({ label: c.scheme, colour: kSchemeColours[c.scheme], width: c.scheme === "raw" ? 1.4 : 1.8 }));
    const data = [curves[0].tau_s, ...curves.map((c) => positive(c.deviation_dps))];
    const bands = [];
    for (const c of banded) {
      const at = data.length;
      series[curves.indexOf(c)].owns = [at, at + 1];
      series.push({ label: "upper", unlisted: true }, { label: "lower", unlisted: true });
      data.push(positive(c.upper_dps), positive(c.lower_dps));
      bands.push({ series: [at, at + 1], colour: c.scheme === "raw" ? "--band-raw" : "--band" });
    }
    single(parent, `Fig. 10 · Allan deviation, ${name} axis`, "Shaded: 68 % confidence of raw and improved.", {
      height: 380,
      x: { label: "cluster time τ, s", log: true },
      y: { label: "σ(τ), deg/s", log: true },
      series,
      bands,
      data,
    });
  }

  /// Errors over time of all runs from one start. parts: [[key, label]]
  function errors(parent, title, note, runs, start, parts, unit) {
    for (const [key, label] of parts) {
      const shown = runs.filter((run) => run.series[start]);
      const times = shown[0].series[start].time_s;
      single(parent, `${title}, ${label}`, note, {
        height: 220,
        x: { label: "time since start, s" },
        y: { label: `${label}, ${unit}` },
        series: shown.map((run) => ({ label: run.scheme, colour: kSchemeColours[run.scheme] ?? "--truth", width: run.scheme === "raw" ? 1.2 : 1.6 })),
        data: [times, ...shown.map((run) => run.series[start][key])],
      });
    }
  }

  return { kSchemeColours, record, imfs, acfs, pcc, acfVariance, beforeAfter, allan, errors };
})();
