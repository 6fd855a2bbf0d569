"use strict";
// Numbers for people, with their units. The API speaks rad/s and s; here is the only place that knows deg/s and minutes.
const gyrodUnits = (() => {
  const { number } = gyrodCharts;
  const kDegrees = 180 / Math.PI;
  const known = (value) => value !== null && value !== undefined && !Number.isNaN(value);

  /// What is shown in either unit: [factor, text], from rad/s, (rad/s)/√Hz and so on.
  const kUnits = {
    deg: {
      rate: [kDegrees, "deg/s"],
      density: [kDegrees, "(deg/s)/√Hz"],
      random_walk: [60 * kDegrees, "deg/√h"],
      instability: [3600 * kDegrees, "deg/h"],
      rate_random_walk: [3600 * 60 * kDegrees, "deg/h/√h"],
    },
    rad: {
      rate: [1, "rad/s"],
      density: [1, "(rad/s)/√Hz"],
      random_walk: [1, "rad/√s"],
      instability: [1, "rad/s"],
      rate_random_walk: [1, "rad/s/√s"],
    },
  };
  let chosen = kUnits.deg;

  const use = (unit) => (chosen = kUnits[unit]);
  const unit = (kind) => chosen[kind][1];
  const convert = (kind, value) => (known(value) ? value * chosen[kind][0] : null);
  const text = (kind, value, digits = 3) => (known(value) ? `${number(convert(kind, value), digits)} ${unit(kind)}` : "not known yet");
  /// Of what an event or a state names its unit in the API's words.
  const bare = (kind, value, digits = 3) => number(convert(kind, value), digits);

  const plain = (value, digits = 3) => String(Number(value.toPrecision(digits)));
  /// A time from microseconds to days.
  function time(value, digits = 3) {
    if (!known(value)) return "not known yet";
    const size = Math.abs(value);
    if (size === 0) return "0 s";
    if (size < 1e-3) return `${plain(value * 1e6, digits)} µs`;
    if (size < 1) return `${plain(value * 1e3, digits)} ms`;
    if (size < 120) return `${plain(value, digits)} s`;
    if (size < 7200) return `${plain(value / 60, 2)} min`;
    if (size < 172800) return `${plain(value / 3600, 2)} h`;
    return `${plain(value / 86400, 2)} days`;
  }

  const count = (value) => (known(value) ? Math.round(value).toLocaleString("en").replaceAll(",", "\u202f") : "not known yet");
  const perSecond = (value) => (!known(value) ? "not known yet" : value >= 1000 ? count(value) : plain(value));
  const decibel = (value) => (known(value) ? `${value.toFixed(1).replace("-", "−")} dB` : "–");
  const clock = (time_s) => new Date(time_s * 1000).toLocaleTimeString("en-GB");
  const moment = (time_s) => {
    const at = new Date(time_s * 1000);
    const day = at.toDateString() === new Date().toDateString() ? "" : `${at.toISOString().slice(0, 10)} `;
    return day + at.toLocaleTimeString("en-GB");
  };

  return { known, use, unit, convert, text, bare, plain, time, count, perSecond, decibel, clock, moment };
})();
