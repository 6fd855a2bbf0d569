"use strict";
// Builds the page of an evaluation from the data that stand in it: evaluation.json, word for word.
(() => {
  const { element, single, table } = gyrodParts;
  const { kSchemeColours } = reportFigures;
  const { number, tick } = gyrodCharts;
  const evaluation = JSON.parse(document.getElementById("data").textContent);
  const byId = (id) => document.getElementById(id);
  const kColours = { ...kSchemeColours, joint: "--accent", realtime: "--realtime", improved: "--paper", "bias removed": "--raw", Butterworth: "--noise", "Savitzky-Golay": "--mixed", "zero-phase Butterworth": "--signal" };
  const isTuned = (name) => name.startsWith("Butterworth");
  const isTunedAside = (name) => isTuned(name) && name !== "Butterworth"; // for another lag than the configuration's
  const colourOf = (name) => kColours[isTunedAside(name) ? "Butterworth" : name] ?? "--accent";
  const lineOf = (name) => ({ label: name, colour: colourOf(name), width: 1.6, ...(isTunedAside(name) ? { dash: [2, 3] } : {}) });
  const kDrawn = new Set(["raw", "Butterworth", "Savitzky-Golay", "zero-phase Butterworth"]);
  const kStarred = new Set(["filter", "bound"]);

  const rowName = (row) => `${row.axis} axis${evaluation.rows.some((r) => r.noise_scale !== 1) ? `, noise × ${tick(row.noise_scale)}` : ""}`;
  const star = (estimator) => (kStarred.has(estimator.kind) ? `${estimator.name} *` : estimator.name);
  const nameCell = (estimator) => ({ text: star(estimator), colour: kDrawn.has(estimator.name) || estimator.kind === "method" ? colourOf(estimator.name) : undefined });
  const last = (estimator) => estimator.lags.at(-1);
  /// A value to the place of the second digit of its error.
  function withError(value, error) {
    if (value === null || !(error > 0)) return number(value);
    const places = Math.min(12, Math.max(0, 1 - Math.floor(Math.log10(error))));
    const text = (Number(value.toFixed(places)) || 0).toFixed(places); // no "-0"
    return `${text.replace("-", "−")} ± ${error.toFixed(places)}`;
  }
  const ofKind = (row, kind) => row.estimators.filter((e) => e.kind === kind);

  function card(parent, title) {
    const made = element("section", undefined, "card");
    made.append(element("h2", title));
    parent.append(made);
    return made;
  }

  function head() {
    const { record } = evaluation;
    byId("version").textContent = evaluation.made_by;
    byId("facts").textContent =
      `${record.samples.toLocaleString("en")} samples, ${number(record.sample_rate_hz)} Hz, truth ${record.truth_columns}…` +
      `${record.noise === null ? "" : `, noise of ${record.noise}`}, judged: samples ${evaluation.judged_from_sample} to ${evaluation.judged_to_sample}`;
    summary(byId("summary"));
    run(byId("run"));
    for (const caution of evaluation.cautions) byId("summary").append(element("p", caution, "absent"));
    const files = [["evaluation.json", "all numbers of this page"], ["evaluation.csv", "errors: a row an axis, noise, estimator and lag"], ["guards.csv", "guards"]];
    if (evaluation.rows.some((row) => row.turns.length > 0)) files.push(["turns.csv", "turns"]);
    table(byId("files"), "All numbers of this page", ["file", "holds"], files.map((cells) => ({ cells })), [0, 1]);
  }

  /// So that it can be run again.
  function run(parent) {
    const { record, configuration: how } = evaluation;
    const mapped = (axes) => Object.entries(axes).map(([axis, of]) => `${axis} from ${of}`).join(", ");
    const rows = [
      ["recording", record.name],
      ["truth", record.truth_axes === null ? "the recorded rates themselves" : `${record.truth_columns}…: ${mapped(record.truth_axes)}`],
      ["noise", record.noise === null ? "the recording's own" : `${record.noise}: ${mapped(record.noise_axes)}, from sample ${record.noise_start_sample} on; ${record.noise_spare_samples} samples are not added`],
      ["methods", how.methods.join(", ")],
      ["window, hop, lag", `${how.window_samples}, ${how.hop_samples}, ${how.lag_samples} samples`],
      ["window, hop of joint and realtime", `${how.joint_window_samples}, ${how.joint_hop_samples} samples`],
      ["max_signal_hz", how.max_signal_hz === 0 ? "0: all is signal" : `${tick(how.max_signal_hz)}`],
      ["turns", how.turn_repeats === null ? "none" : `${how.turn_repeats} runs each`],
      ...(record.calibration === null ? [] : [["calibration", record.calibration]]),
      ...evaluation.rows.map((row) => [`noise model, ${rowName(row)}`, row.noise_model + (row.noise_known_from_sample > 0 ? `, from sample ${row.noise_known_from_sample} on` : "")]),
    ];
    table(parent, "What was run", ["what", "is"], rows.map((cells) => ({ cells })), [0, 1], [1]);
  }

  /// With at most so much lag. All lags that methods have by the configuration are among those that were judged.
  const atMost = (estimator, lag) => estimator.lags.find((l) => l.lag_bound_samples === lag);

  /// Each method at the lag that it has in the daemon, beside filters that may be as late.
  function summary(parent) {
    const rows = evaluation.rows.flatMap((row) =>
      ofKind(row, "method").map((method) => {
        const own = atMost(method, evaluation.own_lag_samples);
        const at = (estimator) => atMost(estimator, own.lag_samples);
        const raw = row.estimators.find((e) => e.name === "raw");
        const [filter] = ofKind(row, "filter").sort((a, b) => at(a).rmse_dps - at(b).rmse_dps);
        const failed = row.guards.filter((g) => g.name === method.name && g.verdict === "fail").length;
        return {
          strong: own.rmse_dps < at(filter).rmse_dps,
          cells: [rowName(row), { text: method.name, colour: colourOf(method.name) }, `${own.lag_samples}`, own.rmse_dps, at(raw).rmse_dps, at(filter).rmse_dps, at(ofKind(row, "bound")[0]).rmse_dps, `${failed}`, filter.name],
        };
      }));
    table(parent, "RMSE in deg/s, each method at its own lag, filters with at most that lag", ["row", "method", "lag, samples", "its RMSE", "raw", "best filter *", "zero-phase *", "guards failed", "that filter"], rows, [0, 1]);
    parent.append(element("p", "* tuned on the truth, which no user can do. Bold: a method that is not tuned and still better than each of the causal filters that are.", "note"));
  }

  function errorsCard(parent, row) {
    const made = card(parent, "Errors");
    const lags = row.estimators[0].lags.map((l) => l.lag_bound_samples);
    const drawn = row.estimators.filter((e) => e.kind === "method" || kDrawn.has(e.name));
    const worst = Math.max(...drawn.filter((e) => e.name !== "raw").map((e) => e.lags[0].rmse_dps));
    const far = (e) => e.name === "raw" && last(e).rmse_dps > 1.5 * worst;
    if (lags.length > 1) {
      single(made, `RMSE by lag, ${rowName(row)}`, `* tuned on the truth. The other filters stand in the table.${drawn.some(far) ? " Raw is far above and hidden: click its name." : ""}`, {
        x: { label: "lag, samples", whole: true },
        y: { label: "RMSE, deg/s" },
        series: drawn.map((e) => ({ label: star(e), colour: colourOf(e.name), show: !far(e), width: e.kind === "method" ? 2.2 : 1.4, points: e.kind === "method" || e.kind === "filter" })),
        data: [lags, ...drawn.map((e) => e.lags.map((l) => l.rmse_dps))],
      });
    }
    table(made, `RMSE in deg/s by lag, ${rowName(row)}`, ["estimator", "tuned to, at the largest lag", ...lags.map((l) => `lag ${l}`), "its own lag"],
      row.estimators.map((e) => ({ strong: e.kind === "method", cells: [nameCell(e), last(e).tuning || "–", ...e.lags.map((l) => l.rmse_dps), e.kind === "bound" ? "–" : String(last(e).lag_samples)] })), [0, 1]);
    table(made, `More of the errors, at the largest lag, ${rowName(row)}`,
      ["estimator", "bias, deg/s", "RMSE less bias, deg/s", "angle in 10 s, deg", "spread", "angle in 60 s, deg", "spread", "scale factor", "correlation peak, samples", "normalised error", "less bias"],
      row.estimators.map((e) => {
        const l = last(e);
        return { strong: e.kind === "method", cells: [nameCell(e), withError(l.bias_dps, l.bias_standard_error_dps), l.rmse_without_bias_dps, l.angle_10s_rms_deg, l.angle_10s_std_deg, l.angle_60s_rms_deg, l.angle_60s_std_deg, withError(l.scale_factor, l.scale_factor_standard_error), withError(l.peak_lag_samples, l.peak_lag_standard_error_samples), l.normalised_error, l.normalised_error_without_bias] };
      }));
    const { samples, lost_truth_samples: lost } = last(row.estimators[0]);
    made.append(element("p", `${samples.toLocaleString("en")} samples judged${lost > 0 ? `, ${lost.toLocaleString("en")} have no truth` : ""}. Noise ${number(row.noise_std_dps)} deg/s, motion ${number(row.truth_std_dps)} deg/s (standard deviations).`, "note"));
    histogram(made, row);
  }

  function histogram(parent, row) {
    const { bin_centres_dps: centres, of } = row.histograms;
    single(parent, `Errors, how often, ${rowName(row)}`, `Methods at a lag of ${evaluation.own_lag_samples} samples, realtime at 0. What lies outside counts in the first and last bin.`, {
      x: { label: "error, deg/s" },
      y: { label: "share of the samples" },
      series: of.map((h) => lineOf(h.name)),
      data: [centres, ...of.map((h) => h.shares)],
    });
  }

  const kGuards = {
    "mean-preserved": ["mean preserved, standard errors", "≤"],
    "slow-turn-gain": ["gain at 0.1 Hz", "1 ±"],
    "swing-gain": ["gain at 1 Hz", "1 ±"],
    "scale-factor": ["scale factor of slow motion", "1 ±"],
    "seam-roughness": ["roughness at seams", "≤"],
    "seam-outliers": ["outliers at seams", "≤"],
    "seam-worst-step": ["worst step at seams", "≤"],
    delay: ["delay, samples", "±"],
    "vibration-gain": ["gain of vibration", "1 ±"],
  };

  function verdictCell(guard) {
    if (guard.verdict === "not applicable") return { text: guard.value === null ? `– ${guard.reason}` : `(${withError(guard.value, guard.standard_error)}) ${guard.reason}`, className: "soft" };
    const late = guard.group_delay_samples;
    const delay = late !== null && Math.abs(late) >= 0.05 ? `, ${number(Math.abs(late), 2)} samples ${late > 0 ? "late" : "early"}` : "";
    return { text: `${number(guard.value)} ${guard.verdict === "pass" ? "✓" : "✗ fails"}${delay}`, className: guard.verdict === "pass" ? "class-signal" : "class-noise" };
  }

  // Where it depends on what they made of the record, that of each who has a value, in the order of the columns.
  function limitsOf(guards) {
    const known = guards.filter((g) => g.value !== null);
    const limits = (known.length > 0 ? known : guards).map((g) => tick(Number(g.limit.toPrecision(3))));
    return new Set(limits).size === 1 ? limits[0] : limits.join("; ");
  }

  function guardsCard(parent, row) {
    const made = card(parent, "Guards");
    const names = [...new Set(row.guards.map((g) => g.name))];
    const find = (name, guard) => row.guards.find((g) => g.name === name && g.guard === guard);
    table(made, `What an estimate must not do, at a lag of ${evaluation.own_lag_samples} samples, realtime at 0, ${rowName(row)}`, ["guard", ...names.map((n) => (isTuned(n) ? `${n} *` : n)), "limit"],
      Object.entries(kGuards).map(([guard, [label, sign]]) => ({ cells: [label, ...names.map((n) => verdictCell(find(n, guard))), `${sign} ${limitsOf(names.map((n) => find(n, guard)))}`] })), [...Array(names.length + 2).keys()]);
  }

  function turnsCard(parent, row) {
    if (row.turns.length === 0) return;
    const made = card(parent, "Turns after 60 s straight");
    for (const turn of [...new Set(row.turns.map((t) => t.turn))]) {
      const runs = row.turns.filter((t) => t.turn === turn);
      const step = 1 / evaluation.record.sample_rate_hz;
      single(made, `${turn}, ${rowName(row)}`, "What the turn changes in the answer, mean over the runs.", {
        height: 240,
        x: { label: "time since the turn's start, s" },
        y: { label: "rate, deg/s" },
        series: [{ label: "truth", colour: "--truth", width: 1.2, dash: [5, 4] }, ...runs.map((t) => lineOf(t.name))],
        data: [runs[0].trace_dps.map((_, i) => runs[0].trace_start_s + i * step), runs[0].trace_truth_dps, ...runs.map((t) => t.trace_dps)],
      });
    }
    table(made, `Turns in numbers, ${rowName(row)}`, ["turn", "estimator", "half, ms later than the truth", "its standard error, ms", "95 %, ms after the start", "overshoot, %", "peak error, deg/s"],
      row.turns.map((t) => ({ strong: !isTuned(t.name), cells: [t.turn, { text: t.name, colour: colourOf(t.name) }, t.half_delay_s === null ? "never" : 1e3 * t.half_delay_s, t.half_delay_error_s === null ? "" : 1e3 * t.half_delay_error_s, t.time_95_s === null ? "never" : 1e3 * t.time_95_s, 100 * t.overshoot, t.peak_error_dps] })), [0, 1]);
  }

  function fillPanel(panel, row) {
    for (const build of [errorsCard, guardsCard, turnsCard]) build(panel, row);
  }

  head();
  gyrodTabs.make(evaluation.rows.map((row, i) => ({ id: i, title: rowName(row), build: (panel) => fillPanel(panel, row) })));
})();
