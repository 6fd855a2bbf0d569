// Sensors that lie still at 100 Hz, and then have a fault: rows of a recording without end.
const kRate_hz = 100;
const kPeriod_ns = 1e9 / kRate_hz;
const kNoise_radps = 0.006;

/** Uniform in (0, 1), the same each time: Lehmer's generator. */
function generator(seed) {
  let state = seed;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

/** Normal, by Box and Muller. */
const normal = (uniform) => () => Math.sqrt(-2 * Math.log(uniform())) * Math.cos(2 * Math.PI * uniform());

const times = (factor) => ({ change: (rates) => rates.map((rate) => factor * rate) });

/** Each may change the rates of sample n, leave it out, or give it the number of one after a reboot. */
const faults = {
  none: {},
  stuck: { change: ([x, , z]) => [x, 0.004, z] },
  saturated: { change: ([x, y, z], n) => [x, y, Math.max(-2, Math.min(2, z + 3 * Math.sin(0.06 * n)))] },
  louder: times(3),
  doubled: times(2),
  moved: { change: ([x, y, z]) => [x + 0.006, y, z] },
  leaky: { isLost: (n) => n % 50 === 7 },
  rebooting: { number: (n) => n % 3000 },
};

/** CSV, some rows at a time; the fault begins after `healthy` samples. */
export function* recording({ fault, healthy, seed }) {
  const { change = (rates) => rates, isLost = () => false, number = (n) => n } = faults[fault];
  const next = normal(generator(seed));
  yield "sequence,stamp_ns,gyro_x_radps,gyro_y_radps,gyro_z_radps\n";
  const kRowsAtOnce = 100;
  for (let begin = 0; ; begin += kRowsAtOnce) {
    let rows = "";
    for (let n = begin; n < begin + kRowsAtOnce; ++n) {
      const still = [0, 0, 0].map(() => kNoise_radps * next());
      const faulty = n >= healthy;
      if (faulty && isLost(n)) continue;
      const rates = faulty ? change(still, n) : still;
      const at = faulty ? number(n) : n;
      rows += `${at},${at * kPeriod_ns},${rates.map((rate) => rate.toFixed(7)).join(",")}\n`;
    }
    yield rows;
  }
}
