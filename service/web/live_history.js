"use strict";
// The last minutes of one sensor at full rate: what /samples sends, first all of it, then what is new.
const gyrodHistory = (() => {
  const kColumns = ["x", "y", "z"].flatMap((axis) => [`${axis}_min`, `${axis}_max`]);

  const emptyPart = () => ({ t_s: [], ...Object.fromEntries(kColumns.map((name) => [name, []])) });

  function append(part, more, shift) {
    // What overlaps is told anew: a stream that comes back may begin a little earlier.
    const from = more.t_s.length > 0 ? more.t_s[0] + shift : Infinity;
    let keep = part.t_s.length;
    while (keep > 0 && part.t_s[keep - 1] >= from - 1e-9) keep -= 1;
    part.t_s.length = keep;
    for (const t of more.t_s) part.t_s.push(t + shift);
    for (const name of kColumns) {
      part[name].length = keep;
      for (const value of more[name]) part[name].push(value);
    }
  }

  function forget(part, before) {
    const first = part.t_s.findIndex((t) => t >= before);
    const drop = first < 0 ? part.t_s.length : first;
    if (drop === 0) return;
    for (const values of Object.values(part)) values.splice(0, drop);
  }

  /// Joins stretches that touch, leaves out those that ended before `before`.
  function merged(stretches, before) {
    const out = [];
    for (const [from, to] of stretches.filter((s) => s[1] >= before).sort((a, b) => a[0] - b[0])) {
      const last = out.at(-1);
      if (last && from <= last[1] + 1e-6) last[1] = Math.max(last[1], to);
      else out.push([from, to]);
    }
    return out;
  }

  /// @param span_s how much is kept
  function make(span_s) {
    let base = null; // ns, BigInt: times are s since then, so that they fit a double
    let raw = emptyPart();
    let denoised = emptyPart();
    let rest = [];
    let gaps = [];
    let watched_s = null;

    function take(data) {
      const from = data.from_ns === null ? (base ?? 0n) : BigInt(data.from_ns);
      if (!data.append || base === null) {
        [base, raw, denoised, rest, gaps] = [from, emptyPart(), emptyPart(), [], []];
      }
      const shift = Number(from - base) / 1e9;
      watched_s = data.watched_s;
      append(raw, data.raw, shift);
      append(denoised, data.denoised, shift);
      const newest = raw.t_s.at(-1) ?? denoised.t_s.at(-1) ?? 0;
      forget(raw, newest - span_s);
      forget(denoised, newest - span_s);
      const moved = (list) => (list ?? []).map(([a, b]) => [a + shift, b + shift]);
      rest = merged([...rest, ...moved(data.rest)], newest - span_s);
      gaps = merged([...gaps, ...moved(data.gaps)], newest - span_s);
    }

    /// One axis for a chart: times relative to the newest sample. Between alignment and gap there is a difference: uPlot draws on over an
    /// undefined value and stops at a null.
    function columns(axis, factor) {
      const newest = raw.t_s.at(-1) ?? denoised.t_s.at(-1) ?? 0;
      const scaled = (values) => values.map((v) => (v === null ? null : v * factor));
      const table = (part) => [part.t_s.map((t) => t - newest), scaled(part[`${axis}_max`]), scaled(part[`${axis}_min`])];
      const holes = gaps.map(([a, b]) => (a + b) / 2 - newest);
      const nothing = holes.map(() => null);
      const tables = [table(raw), table(denoised)];
      const data = uPlot.join(tables);
      const relative = (list) => list.map(([a, b]) => [a - newest, b - newest]);
      return { data: holes.length === 0 ? data : broken(data, holes, nothing), rest: relative(rest), gaps: relative(gaps), any: raw.t_s.length > 0 };
    }

    /// A row of nulls in the middle of each gap.
    function broken(data, holes, nothing) {
      const breaks = [holes, nothing, nothing, nothing, nothing];
      const times = [...data[0], ...breaks[0]];
      const order = times.map((_, i) => i).sort((a, b) => times[a] - times[b]);
      return data.map((values, c) => {
        const all = [...values, ...breaks[c]];
        return order.map((i) => all[i]);
      });
    }

    return { take, columns, watched: () => watched_s };
  }

  return { make };
})();
