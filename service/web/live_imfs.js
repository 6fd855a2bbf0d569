"use strict";
// The decomposition of the newest window: a row an IMF.
const gyrodImfs = (() => {
  const { element, table } = gyrodParts;
  const { number } = gyrodCharts;
  const units = gyrodUnits;

  const svg = (tag, attributes) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    return made;
  };

  const kWidth = 110;
  const kDecades = [-2, 4]; // of energy over the noise line
  const place = (excess) => {
    const [low, high] = kDecades;
    return Math.min(Math.max(((Math.log10(excess) - low) / (high - low)) * kWidth, 3), kWidth - 3);
  };

  /// Where an IMF's energy lies against white noise: the line is the noise line, the stripe what chance allows, the spot the IMF.
  function gauge(imf) {
    if (!(imf.excess > 0)) return element("span", "noise line not known", "soft");
    const made = svg("svg", { width: kWidth, height: 16, role: "img", "aria-label": `${number(imf.excess, 3)} times the noise line` });
    made.append(svg("line", { x1: 0, x2: kWidth, y1: 8, y2: 8, class: "gauge-scale" }));
    if (imf.noise_excess_high > 0) {
      const [from, to] = [place(Math.max(imf.noise_excess_low, 1e-9)), place(imf.noise_excess_high)];
      made.append(svg("rect", { x: from, y: 3, width: Math.max(to - from, 1), height: 10, class: "gauge-chance" }));
    }
    made.append(svg("line", { x1: place(1), x2: place(1), y1: 1, y2: 15, class: "gauge-line" }));
    made.append(svg("circle", { cx: place(imf.excess), cy: 8, r: 4, class: `gauge-${imf.class}` }));
    return made;
  }

  function model(imf) {
    const { model: m } = imf;
    if (!m) return "none";
    const orders = { ar: `AR(${m.ar_order})`, ma: `MA(${m.ma_order})`, arma: `ARMA(${m.ar_order}, ${m.ma_order})`, white: "white noise" };
    return `${orders[m.family] ?? m.family}${m.used ? "" : ", not used"}`;
  }

  const kMeaning = { noise: "dropped", mixed: "filtered", signal: "kept" };

  function update(parent, axis, own) {
    parent.replaceChildren();
    if (!own || own.imfs.length === 0) {
      const why = own ? "this method takes no modes out, or the window is too short for them" : "no window of this sensor has been denoised yet";
      parent.append(element("p", `No decomposition: ${why}.`, "waiting"));
      return;
    }
    const unit = units.unit("rate");
    const windowed = !own.fit; // a model method takes from the modes what it models; nothing is dropped or kept
    const heads = ["IMF", "taken for", "mean period", "energy against the noise line", "excess", `RMS, ${unit}`, "PCC", "variance of ACF", "model", `innovation σ, ${unit}`];
    const rows = own.imfs.map((imf, i) => ({
      cells: [
        String(i + 1),
        { text: windowed ? `${imf.class}, ${kMeaning[imf.class] ?? ""}` : imf.class, className: `class-${imf.class}`, colour: `--${imf.class}` },
        units.time(imf.mean_period_s),
        gauge(imf),
        imf.excess > 0 ? `× ${number(imf.excess, 3)}` : "not known",
        number(units.convert("rate", imf.rms_radps), 3),
        number(imf.pcc, 3),
        number(imf.acf_variance, 3),
        model(imf),
        imf.model ? number(units.convert("rate", imf.model.innovation_std_radps), 3) : "–",
      ],
    }));
    table(parent, `Modes of the newest window, ${axis} axis: j = ${own.j}, k = ${own.k}`, heads, rows, [0, 1, 3, 8]);
    if (own.imfs.some((imf) => imf.pcc === null)) parent.append(element("p", "–: not asked for by the method and screening in use.", "note"));
    parent.append(element("p", `Energy: the upright line is what white noise of this sensor's level has in the mode (excess 1), the stripe what chance allows around it. ${windowed ? "Noise is dropped, mixed is filtered, signal is kept." : "The models of motion and noise are made of what the modes show."}`, "note"));
  }

  return { update };
})();
