"use strict";
// What is chosen on the page. It stands in the address, so that a link shows another person the same.
const gyrodState = (() => {
  const kAllowed = {
    axis: ["x", "y", "z"],
    unit: ["deg", "rad"],
    span: ["10", "30", "60", "120", "300", "600"],
    sort: ["health", "sensor", "noise", "reduction", "rate"],
  };
  const kDefaults = { sensor: "", axis: "x", unit: "deg", span: "30", sort: "health", search: "", troubled: "" };
  const state = { ...kDefaults };
  const listeners = [];

  function read() {
    const given = new URLSearchParams(location.hash.slice(1));
    for (const key of Object.keys(kDefaults)) {
      const value = given.get(key);
      state[key] = value === null || (kAllowed[key] && !kAllowed[key].includes(value)) ? kDefaults[key] : value;
    }
  }

  function address() {
    const kept = Object.entries(state).filter(([key, value]) => value !== kDefaults[key]);
    return `#${new URLSearchParams(kept)}`;
  }

  /// Calls every listener with the names of what has changed.
  function tell(before) {
    const changed = new Set(Object.keys(state).filter((key) => state[key] !== before[key]));
    if (changed.size > 0) listeners.forEach((listener) => listener(changed));
  }

  /// A chosen sensor is a step of its own in the browser's history, so that "back" leads to the list.
  function set(changes) {
    const before = { ...state };
    Object.assign(state, changes);
    const act = state.sensor !== before.sensor ? "pushState" : "replaceState";
    history[act](null, "", address());
    tell(before);
  }

  function follow() {
    const before = { ...state };
    read();
    tell(before);
  }

  read();
  window.addEventListener("hashchange", follow);
  window.addEventListener("popstate", follow);
  return { state, set, changed: (listener) => listeners.push(listener), kAllowed };
})();
