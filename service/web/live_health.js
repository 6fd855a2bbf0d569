"use strict";
// States of health: their letters, words and evidence. Each has a letter of its own, so that nobody needs to tell colours.
const gyrodHealth = (() => {
  const { element } = gyrodParts;
  const units = gyrodUnits;

  /// Worst first. tone: the colour, of live.css.
  const kStates = {
    silent: { letter: "S", tone: "grey", means: "no samples" },
    stuck: { letter: "K", tone: "red", means: "the converter gives one value again and again" },
    saturated: { letter: "C", tone: "red", means: "motion beyond the range: the rate is clipped" },
    noisy: { letter: "N", tone: "red", means: "noisier at rest than it was" },
    drifting: { letter: "D", tone: "amber", means: "its bias has moved" },
    lossy: { letter: "L", tone: "amber", means: "samples are missing or refused" },
    degraded: { letter: "G", tone: "amber", means: "gyrod is overloaded" },
    warming_up: { letter: "W", tone: "blue", means: "the window is not full yet" },
    ok: { letter: "O", tone: "green", means: "none of these" },
  };
  const kOrder = Object.keys(kStates);
  const kUnknown = { letter: "?", tone: "grey", means: "a state that this page does not know" };
  const state = (name) => kStates[name] ?? kUnknown;
  const words = (name) => name.replaceAll("_", " ");
  const rank = (name) => (kOrder.includes(name) ? kOrder.indexOf(name) : -1);
  const troubled = (name) => name !== "ok" && name !== "warming_up";

  /// What speaks for the state of an axis, with the limit it is held against.
  const kEvidence = {
    silent: (v, l) =>
      v > l ? `${units.time(v)} since the last sample, limit ${units.time(l)}` : "its writer is gone, or has missed a deadline",
    stuck: (v, l) => `one value for ${units.time(v)}, limit ${units.time(l)}`,
    saturated: (v, l) => `at the limit of its range ${units.time(v)} ago, held for ${units.time(l)}`,
    noisy: (v, l) => `${units.plain(v)} times its usual noise, limit ${units.plain(l)}`,
    drifting: (v, l) => `bias off by ${units.text("rate", v)}, limit ${units.text("rate", l)}`,
    lossy: (v, l) => `${units.plain(100 * v)} % missing or refused, limit ${units.plain(100 * l)} %`,
    degraded: (v) => (v >= 2 ? "samples pass through undenoised" : "models are made less often"),
    warming_up: (v, l) => `${units.count(v)} of ${units.count(l)} samples of the window`,
    ok: () => "",
  };
  function evidence(axis) {
    if (!units.known(axis.value) || !units.known(axis.limit)) return "";
    return kEvidence[axis.health]?.(axis.value, axis.limit) ?? "";
  }

  function paint(dot, name) {
    const { letter, tone, means } = state(name);
    if (dot.dataset.health === name) return;
    dot.textContent = letter;
    dot.dataset.health = name;
    dot.dataset.tone = tone;
    dot.title = `${words(name)}: ${means}`;
  }

  /// The state as a round sign with its letter.
  function dot(name) {
    const made = element("span", undefined, "dot");
    made.setAttribute("aria-hidden", "true");
    paint(made, name);
    return made;
  }

  return { kOrder, state, words, rank, troubled, evidence, paint, dot };
})();
