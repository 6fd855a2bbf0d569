"use strict";
// What is known of a sensor in numbers: models and floor, the window, counts.
const gyrodFacts = (() => {
  const { element } = gyrodParts;
  const { number } = gyrodCharts;
  const units = gyrodUnits;

  /// Name and value, one under the other; what is not known says so. Nothing is touched whose words stay the same.
  function list(parent, facts) {
    const same = parent.childElementCount === 2 * facts.length && facts.every(([name], i) => parent.children[2 * i].textContent === name);
    if (!same) parent.replaceChildren(...facts.flatMap(([name]) => [element("dt", name), element("dd")]));
    facts.forEach(([, value], i) => {
      const place = parent.children[2 * i + 1];
      if (place.textContent !== value) place.textContent = value;
      place.classList.toggle("soft", value.startsWith("not known") || value.startsWith("not observable"));
    });
  }

  const kSources = {
    none: "nothing: judged by each window",
    imf1: "the signal itself",
    standstill: "learned at rest",
    calibrated: "a calibration",
  };

  function fit(axis) {
    if (!axis.fit) return "not known: this method has no model of the whole window";
    const { normalised_innovation: size, misfit, misfits, fallbacks, wrong_noise: wrong, noise_ratio: ratio, hidden_noise: hidden } = axis.fit;
    const trouble = wrong ? `, does not fit now: ${number(ratio, 2)} times the noise that is believed` : hidden ? ", its noise is unknown, behind a low-pass of its own" : misfit ? ", does not fit now" : "";
    return `innovation ${number(size, 3)} of what the model expects${trouble}; ${units.count(misfits)} misfits, ${units.count(fallbacks)} fallbacks`;
  }

  function models(channel, index) {
    const row = channel.axes[index];
    const { report } = channel;
    const own = report?.axes?.[index];
    const waits = "not known: no window has been denoised yet";
    const bias = channel.bias ? `${units.text("rate", channel.bias.axes_radps[index])}, from ${units.time(channel.bias.seconds)} at rest` : "not known: it takes rest";
    return [
      ["σ of the noise, raw", units.text("rate", row.noise_in_radps)],
      ["σ of the noise, denoised", units.text("rate", row.noise_out_radps)],
      ["reduction", units.known(row.reduction_db) ? units.decibel(row.reduction_db) : "not known yet"],
      ["the level comes from", kSources[channel.noise_source] ?? channel.noise_source],
      ["mean of the window", own ? units.text("rate", own.mean_radps) : waits],
      ["bias at rest", bias],
      ["tone", own ? (own.tone ? `${units.text("rate", own.tone.amplitude_radps)} at ${units.plain(own.tone.frequency_hz)} Hz` : "none found") : waits],
      ["model", own ? fit(own) : waits],
      ["parts of the model", own ? units.count(own.modes) : waits],
      ["j, k", own ? `${own.j}, ${own.k}` : waits],
    ];
  }

  const kSteps = ["0 of 2: none", "1 of 2: models are made less often", "2 of 2: samples pass through undenoised"];

  /// A number of samples, and the time they take.
  const samples = (count, rate_hz) => (units.known(count) ? `${units.count(count)} samples${rate_hz > 0 ? ` (${units.time(count / rate_hz)})` : ""}` : "not known yet");

  function work(channel) {
    const { report } = channel;
    const rate = channel.sample_rate_hz;
    const waits = "not known: no window has been denoised yet";
    return [
      ["sample rate", units.known(rate) ? `${units.plain(rate, 5)} Hz` : "not known yet"],
      ["window", report ? samples(report.window_samples, rate) : waits],
      ["hop", samples(channel.hop_samples, rate)],
      ["lag", report ? samples(report.lag_samples, rate) : waits],
      ["computing a window took", report ? units.time(report.window_time_s) : waits],
      ["window number", report ? units.count(report.model_epoch) : waits],
      ["windows waiting", units.count(channel.queued_windows)],
      ["overload step", kSteps[channel.overload_step] ?? String(channel.overload_step)],
      ["at rest", channel.at_rest === null ? "not known: nobody looks" : channel.at_rest ? "yes" : "no"],
      ["flags", report ? (report.flags.length > 0 ? report.flags.map((f) => f.replaceAll("_", " ")).join(", ") : "none") : waits],
    ];
  }

  /// Every count that the daemon has, under its own name.
  function counts(channel) {
    const flat = [];
    for (const [name, value] of Object.entries(channel.counts ?? {})) {
      if (typeof value === "number") flat.push([name.replaceAll("_", " "), units.count(value)]);
      else if (value && typeof value === "object") {
        for (const [reason, n] of Object.entries(value)) flat.push([`${name.replaceAll("_", " ")}: ${reason.replaceAll("_", " ")}`, units.count(n)]);
      }
    }
    return flat;
  }

  return { list, models, work, counts };
})();
