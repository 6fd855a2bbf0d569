"use strict";
// The three plots of a sensor. Each maker draws into `parent` and returns {update(...), remove()}; they are made anew when axis, unit or
// span change.
const gyrodPlots = (() => {
  const { element, frame } = gyrodParts;
  const { chart, refresh, shade, verticalLine, horizontalLine, number } = gyrodCharts;
  const units = gyrodUnits;

  /// A figure whose plot waits, with words, until there is something to draw.
  function figure(parent, title, note, spec) {
    const made = frame(parent, title, undefined);
    const words = element("p", note, "note");
    const waiting = element("p", undefined, "waiting");
    made.figure.append(words);
    made.plot.append(waiting);
    let u = null;
    function say(text) {
      if (waiting.textContent !== text) waiting.textContent = text;
      waiting.hidden = text === "";
      if (u) u.root.hidden = text !== "";
    }
    function draw(data) {
      say("");
      if (u) return refresh(u, data);
      u = chart(made.plot, { label: title, live: true, height: 260, ...spec, data });
      made.finish([u]);
    }
    function note_(text) {
      if (words.textContent !== text) words.textContent = text;
    }
    return { draw, say, note: note_, caption: made.caption, remove: () => u?.remove() };
  }

  const pair = (name, colour, width, at) => [
    { label: name, colour, width, owns: [at + 1] },
    { label: `${name}, least`, colour, width, unlisted: true },
  ];

  /// Raw and denoised rate over the last `span_s` seconds. update(history)
  function rate(parent, axis, span_s) {
    let shown = { rest: [], gaps: [] };
    let paused = false;
    const unit = units.unit("rate");
    const made = figure(parent, `Rate, ${axis} axis`, "", {
      x: { label: "time, s; 0 is the newest sample", range: [-span_s, 0] },
      y: { label: `rate, ${unit}` },
      series: [...pair(`raw, ${unit}`, "--raw", 1, 1), ...pair(`denoised, ${unit}`, "--accent", 1.8, 3)],
      bands: [{ series: [1, 2], colour: "--band-raw" }, { series: [3, 4], colour: "--band" }],
      under: (u) => {
        for (const [from, to] of shown.rest) shade(u, from, to, "--rest");
        for (const [from, to] of shown.gaps) shade(u, from, to, "--gap");
      },
    });
    const pause = element("button", "Pause");
    pause.type = "button";
    pause.setAttribute("aria-pressed", "false");
    pause.addEventListener("click", () => {
      paused = !paused;
      pause.setAttribute("aria-pressed", String(paused));
      pause.textContent = paused ? "Go on" : "Pause";
    });
    const tools = element("span", undefined, "tools");
    tools.append(pause);
    made.caption.append(tools);
    made.say("waiting for samples …");

    function update(history) {
      if (paused) return;
      const { data, rest, gaps, any } = history.columns(axis, units.convert("rate", 1));
      if (!any) return made.say("No samples in this time.");
      shown = { rest, gaps };
      made.draw(data);
      const watched = history.watched();
      const young = units.known(watched) && watched < span_s ? ` Samples are kept while somebody looks at the sensor: ${Math.floor(watched)} s of ${span_s} s so far.` : "";
      made.note(`Least and most of each moment, so that spikes show. Shaded green: at rest; red: samples missing.${young}`);
    }
    return { update, remove: made.remove };
  }

  /// Amplitude spectral density before and after. update(spectrum, report)
  function spectrum(parent, axis, index) {
    let floor = null;
    let tone = null;
    const unit = units.unit("density");
    const made = figure(parent, `Spectrum, ${axis} axis`, "", {
      x: { label: "frequency, Hz", log: true },
      y: { label: `amplitude density, ${unit}`, log: true },
      series: [{ label: "raw", colour: "--raw", width: 1 }, { label: "denoised", colour: "--accent", width: 1.8 }],
      over: (u) => {
        if (floor) horizontalLine(u, floor, "--noise", `noise floor ${number(floor, 3)} ${unit}`);
        if (tone) verticalLine(u, tone.frequency_hz, "--mixed", `tone ${number(tone.frequency_hz, 3)} Hz`);
      },
    });
    made.say("waiting for samples …");

    function update(data, report) {
      const own = data?.axes?.[index];
      if (!own || data.frequency_hz.length === 0) {
        const needs = units.known(data?.needs_s) ? `: ${units.plain(data.needs_s)} s of samples are needed` : "";
        return made.say(`The spectrum is not observable yet${needs}.`);
      }
      floor = units.convert("density", own.noise_floor);
      tone = report?.axes?.[index]?.tone ?? null;
      const kept = data.frequency_hz.map((f, i) => i).filter((i) => data.frequency_hz[i] > 0);
      const scaled = (values) => kept.map((i) => (values?.[i] > 0 ? units.convert("density", values[i]) : null));
      made.draw([kept.map((i) => data.frequency_hz[i]), scaled(own.raw), scaled(own.denoised)]);
      const toneText = tone ? ` Tone: ${units.text("rate", tone.amplitude_radps)} at ${units.plain(tone.frequency_hz)} Hz.` : "";
      const floorText = floor ? ` Noise floor: ${number(floor, 3)} ${unit}.` : " Noise floor: not known yet.";
      made.note(`Welch's estimate from ${units.count(data.samples_used)} samples.${floorText}${toneText}`);
    }
    return { update, remove: made.remove };
  }

  /// Bias instability shows as a flat part of the curve at this many times B (IEEE Std 952).
  const kFlat = Math.sqrt((2 * Math.LN2) / Math.PI);

  /// Allan deviation of the rest seen so far. update(allan)
  function allan(parent, axis, index) {
    let own = null;
    const unit = units.unit("rate");
    const made = figure(parent, `Allan deviation at rest, ${axis} axis`, "", {
      x: { label: "cluster time τ, s", log: true },
      y: { label: `σ(τ), ${unit}`, log: true },
      series: [
        { label: "σ(τ)", colour: "--accent", width: 1.8, points: true },
        { label: "N / √τ", colour: "--noise", width: 1.2, dash: [6, 4] },
      ],
      over: (u) => {
        const flat = units.convert("rate", own?.bias_instability_radps);
        if (flat !== null) horizontalLine(u, kFlat * flat, "--mixed", `0.664 B, B = ${units.text("instability", own.bias_instability_radps)}`);
      },
    });
    made.say("waiting for the first report …");

    /// needs_s is what the first unknown of N and B needs at the least.
    const seen = (allanData) => {
      if (!units.known(own.needs_s)) return "";
      const rest_s = allanData.at_rest_s ?? 0;
      if (rest_s < own.needs_s) return `, ${units.plain(rest_s)} s of at least ${units.plain(own.needs_s)} s at rest`;
      return `: ${units.plain(rest_s)} s at rest do not show it`;
    };
    const coefficient = (name, kind, value, waits) => (units.known(value) ? `${name} = ${units.text(kind, value)}` : `${name}: not observable yet${waits}`);

    function update(allanData) {
      own = allanData?.axes?.[index] ?? null;
      if (!own) return made.say("No Allan deviation: gyrod does not look for rest of this sensor.");
      if (own.tau_s.length === 0) return made.say(`Not observable yet${seen(allanData)}. It is taken while the sensor stands still.`);
      const n = own.angle_random_walk_radps_sqrt_hz;
      const line = own.tau_s.map((tau) => (units.known(n) ? units.convert("rate", n / Math.sqrt(tau)) : null));
      made.draw([own.tau_s, own.deviation_radps.map((v) => (v > 0 ? units.convert("rate", v) : null)), line]);
      made.note(`Of ${units.time(allanData.at_rest_s)} at rest. ${coefficient("N", "random_walk", n, seen(allanData))}. ${coefficient("B", "instability", own.bias_instability_radps, units.known(n) ? seen(allanData) : "")}.`);
    }
    return { update, remove: made.remove };
  }

  return { rate, spectrum, allan };
})();
