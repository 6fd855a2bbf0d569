"use strict";
// Builds the report from the data that stand in the page: report.json, word for word.
(() => {
  const { element, absent, table } = gyrodParts;
  const { kSchemeColours } = reportFigures;
  const { number, tick } = gyrodCharts;
  const report = JSON.parse(document.getElementById("data").textContent);
  const byId = (id) => document.getElementById(id);

  const schemeCell = (scheme) => ({ text: scheme, colour: kSchemeColours[scheme] });
  const section = (parent, title) => {
    const made = element("section", undefined, "card");
    made.append(element("h2", title));
    parent.append(made);
    return made;
  };

  function head() {
    const { record } = report;
    byId("version").textContent = report.made_by;
    byId("facts").textContent =
      `${record.samples.toLocaleString("en")} samples, ${number(record.sample_rate_hz)} Hz` +
      `${record.rate_given ? " (given)" : ""}, ${number(record.duration_s)} s, ${record.still ? "still" : "moving"}`;
    const rows = report.summary_rows;
    if (rows.length > 0) {
      const taus = rows[0].allan_change.map((c) => `Allan deviation at ${tick(c.tau_s)} s`);
      const change = (ratio) => (ratio === null ? "–" : ratio > 0.995 && ratio < 1.005 ? "no change" : `${Math.round(100 * Math.abs(ratio - 1))} % ${ratio < 1 ? "less" : "more"}`);
      table(byId("summary"), "Raw to improved", ["axis", "standard deviation, deg/s", "change", "dropped, Hz", "filtered, Hz", "kept, Hz", ...taus],
        rows.map((r) => ({ cells: [r.axis, `${number(r.std_raw_dps)} → ${number(r.std_improved_dps)}`, change(r.std_ratio), r.dropped_hz, r.filtered_hz, r.kept_hz, ...r.allan_change.map((c) => change(c.ratio))] })));
    }
    const list = element("ul");
    for (const sentence of report.summary) list.append(element("li", sentence));
    byId("summary").append(list);
    for (const caution of report.cautions) byId("summary").append(element("p", caution, "absent"));
    byId("trace-definition").textContent = report.traces;
    table(byId("files"), "All numbers of this page", ["file", "holds"], report.files.map((f) => ({ cells: [f.name, f.holds] })), [0, 1], [1]);
  }

  function recordSection(parent, name, axis) {
    const made = section(parent, "The record");
    reportFigures.record(made, name, axis);
    const { record } = report;
    const r = axis.record;
    table(made, `The record in numbers, ${name} axis`, ["mean, deg/s", "standard deviation, deg/s", "least, deg/s", "most, deg/s", "rows read", "broken", "refused", "missing", "bridged", "long gaps", "left out"],
      [{ cells: [r.mean_dps, r.std_dps, r.least_dps, r.most_dps, ...[record.rows, record.broken_rows, record.refused, record.missing, record.bridged, record.gaps, record.left_out].map(String)] }], []);
  }

  function decompositionSection(parent, name, axis) {
    const made = section(parent, "Decomposition and screening");
    const d = axis.decomposition;
    if (d.absent) return absent(made, "Figs 4 to 7", d.absent);
    made.append(element("p", d.words));
    reportFigures.imfs(made, name, d);
    reportFigures.pcc(made, name, d);
    reportFigures.acfs(made, name, d);
    reportFigures.acfVariance(made, name, d);
    table(made, `The IMFs in numbers, ${name} axis`,
      ["IMF", "taken for", "mean period, s", "standard deviation, deg/s", "PCC", "correlation", "variance of ACF", "c = var(ACF)·N/period"],
      d.imfs.map((m) => ({ cells: [String(m.imf), { text: m.class, className: `class-${m.class}` }, m.mean_period_s, m.std_dps, m.pcc, m.correlation, m.acf_variance, m.acf_concentration] })),
      [0, 1, 5]);
  }

  const terms = (values, errors, letter) =>
    values.map((v, i) => `${letter}${"₁₂₃₄₅₆₇₈₉"[i] ?? i + 1} = ${number(v, 5)}${errors[i] ? ` ± ${number(errors[i], 2)}` : ""}`).join(", ");

  function modelSection(parent, name, axis) {
    const made = section(parent, "Models");
    const m = axis.models;
    if (m.absent) return absent(made, "Table 4", m.absent);
    table(made, `Table 4 · Models of the mixed IMFs and of the record, ${name} axis`,
      ["series", "model", "coefficients", "noise σ, deg/s", "ACF and PACF say", "Ljung-Box Q (degrees)", "p", "lags outside", "residuals"],
      m.rows.map((r) => ({
        cells: [r.series, r.model, [terms(r.ar, r.ar_error, "a"), terms(r.ma, r.ma_error, "b")].filter(Boolean).join(", ") || "–", r.noise_std_dps, r.evidence,
          `${number(r.ljung_box_q)} (${r.degrees_of_freedom})`, r.p_value < 1e-4 ? "< 0.0001" : r.p_value, `${r.lags_outside} of ${r.lags}`, r.verdict],
      })), [0, 1, 2, 4, 8], [2, 4, 8]);
    made.append(element("p", m.words, "note"));
  }

  function beforeAfterSection(parent, name, axis) {
    const made = section(parent, "Before and after");
    reportFigures.beforeAfter(made, name, axis);
    const t = axis.table5;
    const paper = t.paper !== undefined;
    const heads = ["scheme", "mean, deg/s", "mean absolute deviation, deg/s", "standard deviation, deg/s", "SNR, dB"];
    if (paper) heads.push("paper: “mean”, deg/s", "paper: std, deg/s", "paper: SNR, dB");
    const rows = t.rows.map((r) => {
      const theirs = t.paper?.[r.scheme];
      const cells = [schemeCell(r.scheme), r.mean_dps, r.mean_absolute_deviation_dps, r.std_dps, r.snr_db];
      if (paper) cells.push(theirs?.mean_absolute_deviation_dps, theirs?.std_dps, theirs?.snr_db);
      return { cells, strong: r.scheme === "improved" };
    });
    table(made, `Table 5 · Comparison of the schemes, ${name} axis`, heads, rows);
    made.append(element("p", t.words, "note"));
    if (t.snr_absent) absent(made, "SNR", t.snr_absent);
  }

  const kTerms = [["q_deg", "Q, deg"], ["n_deg_per_sqrt_h", "N, deg/√h"], ["b_dph", "B, deg/h"], ["k_dph_per_sqrt_h", "K, deg/h^1.5"], ["r_dph_per_h", "R, deg/h²"]];
  function coefficient(c) {
    if (!c.observable) return { text: "not observable", className: "soft" };
    return `${number(c.value)} ± ${number(c.standard_error, 2)}`;
  }

  function allanSection(parent, name, axis) {
    const made = section(parent, "Allan deviation");
    const a = axis.allan;
    if (a.absent) return absent(made, "Fig. 10 and Table 6", a.absent);
    reportFigures.allan(made, name, a);
    if (a.caution) made.append(element("p", a.caution, "absent"));
    const heads = ["scheme", ...kTerms.map(([, label]) => label)];
    const rows = a.table6.map((r) => ({ cells: [schemeCell(r.scheme), ...kTerms.map(([key]) => coefficient(r.least_squares[key]))], strong: r.scheme === "improved" }));
    for (const [scheme, theirs] of Object.entries(a.paper ?? {})) rows.push({ cells: [`paper: ${scheme}`, ...kTerms.map(([key]) => theirs[key])] });
    table(made, `Table 6 · Noise coefficients, weighted non-negative least squares, ${name} axis`, heads, rows);
    for (const [key, label] of [["slope", "slope method"], ["polynomial", "the literature's polynomial fit, for comparison only"]]) {
      table(made, `Table 6 by ${label}, ${name} axis`, heads, a.table6.map((r) => ({ cells: [schemeCell(r.scheme), ...kTerms.map(([k]) => coefficient(r[key][k]))] })));
    }
    table(made, `Allan deviation at chosen cluster times, deg/s, ${name} axis`, ["scheme", ...a.chosen_tau_s.map((tau) => `τ = ${tick(tau)} s`)],
      a.chosen.map((r) => ({ cells: [schemeCell(r.scheme), ...r.deviation_dps], strong: r.scheme === "improved" })));
    if (a.words) made.append(element("p", a.words, "note"));
  }

  function navigationTable(parent, title, n, group, parts, unit) {
    const theirs = n.paper?.[group];
    const heads = ["error", "scheme", `mean, ${unit}`, `std, ${unit}`, `RMSE, ${unit}`, `largest, ${unit}`];
    if (theirs) heads.push(`paper: mean, ${unit}`, `paper: std, ${unit}`);
    const rows = parts.flatMap(([key, label]) =>
      n.runs.map((run) => {
        const ours = run[group][key];
        const paper = theirs?.[run.scheme]?.[key];
        const cells = [label, schemeCell(run.scheme), ours.mean, ours.std, ours.rmse, ours.max];
        if (theirs) cells.push(paper?.mean, paper?.std);
        return { cells, strong: run.scheme === "improved" };
      }));
    table(parent, title, heads, rows, [0, 1]);
  }

  function navigationSection() {
    const made = byId("navigation");
    const n = report.navigation;
    if (n.absent) return absent(made, "Figs 11 to 13 and Tables 7 to 9", n.absent);
    const list = element("ul");
    for (const sentence of n.words) list.append(element("li", sentence));
    made.append(list);
    const groups = [
      ["attitude", "Fig. 11 · Attitude error", "Table 7 · Attitude error", [["roll_deg", "roll"], ["pitch_deg", "pitch"], ["heading_deg", "heading"]], "deg"],
      ["velocity", "Fig. 12 · Velocity error", "Table 8 · Velocity error", [["north_mps", "north"], ["east_mps", "east"]], "m/s"],
      ["position", "Fig. 13 · Position error", "Table 9 · Position error", [["east_m", "east (longitude)"], ["north_m", "north (latitude)"]], "m"],
    ];
    for (const [group, figure, title, parts, unit] of groups) {
      if (n[`${group}_absent`]) {
        absent(made, `${figure.split(" ·")[0]} and ${title.split(" ·")[0]}`, n[`${group}_absent`]);
        continue;
      }
      reportFigures.errors(made, figure, n.figure_words, n.runs, n.figure_start, parts, unit);
      navigationTable(made, title, n, group, parts, unit);
    }
  }

  function fillPanel(panel, name) {
    for (const build of [recordSection, decompositionSection, modelSection, beforeAfterSection, allanSection]) build(panel, name, report.axes[name]);
  }

  head();
  gyrodTabs.make(Object.keys(report.axes).map((name) => ({ id: name, title: `${name} axis`, build: (panel) => fillPanel(panel, name) })));
  navigationSection();
})();
