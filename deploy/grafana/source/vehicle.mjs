// One vehicle: is it the sensor, the bus or gyrod?
import { atLeast, byName, byPattern, chart, coloured, colourOf, dashboard, datasourceVariable, fixed, instant, kDenoised, kRaw, link, query, queryVariable, stat, stateMappings, table, thresholds, timeline } from "./parts.mjs";

const of = '{vehicle="$vehicle"}';
const sensor = '{vehicle="$vehicle",sensor=~"$sensor"}';
const rate = (name, labels = of) => `rate(${name}${labels}[$__rate_interval])`;
const quantile = (share, histogram) => `histogram_quantile(${share}, sum by (le) (${rate(`${histogram}_bucket`)}))`;
const axis = "{{sensor}} {{axis}}";

const atAGlance = [
  stat({
    title: "gyrod",
    targets: [query(`max(gyrod_ready${of})`)],
    mappings: [{ type: "value", options: { 0: { text: "not ready", color: colourOf("stuck"), index: 0 }, 1: { text: "ready", color: colourOf("ok"), index: 1 } } }],
  }),
  stat({ title: "Up for", unit: "s", targets: [query(`max(gyrod_uptime_seconds${of})`)] }),
  stat({ title: "Version", text: "name", targets: [query(`gyrod_build_info${of}`, "{{version}}")] }),
  stat({ title: "Gyros", targets: [query(`sum(gyrod_sensors${of})`)] }),
  stat({
    title: "Troubled",
    targets: [query('sum(gyrod_sensors_by_health{vehicle="$vehicle",state!~"ok|warming_up"})')],
    thresholds: thresholds(1),
  }),
  stat({
    title: "Lost",
    unit: "percentunit",
    decimals: 2,
    targets: [query(`vehicle:gyrod_samples_lost:ratio5m${of}`)],
    thresholds: thresholds(0.005, 0.01),
  }),
  stat({
    title: "Workers in use",
    unit: "percentunit",
    decimals: 0,
    targets: [query(`vehicle:gyrod_workers_busy:ratio5m${of}`)],
    thresholds: thresholds(0.7, 0.9),
  }),
  stat({ title: "Writers that send", targets: [query(`sum(gyrod_bus_matched_writers${of})`)], thresholds: atLeast(1) }),
];

const health = [
  timeline({ title: "Health of each gyro", targets: [query(`gyrod_sensor_health${sensor}`, "{{sensor}}")] }),
  table({
    title: "Gyros, now",
    height: 9,
    targets: [
      instant(`gyrod_sensor_health${sensor}`),
      instant(`gyrod_sensor_sample_rate_hertz${sensor}`),
      instant(`deg(max by (vehicle, sensor) (gyrod_axis_noise_floor_radians_per_second${sensor}))`),
      instant(`deg(max by (vehicle, sensor) (gyrod_axis_output_noise_radians_per_second${sensor}))`),
      instant(`rate(gyrod_sensor_samples_missing_total${sensor}[5m])`),
      instant(`gyrod_sensor_overload_step${sensor}`),
      instant(`gyrod_sensor_noise_source${sensor}`),
      instant(`gyrod_sensor_at_rest${sensor}`),
    ],
    hidden: ["vehicle"],
    names: {
      sensor: "Gyro",
      "Value #A": "State",
      "Value #B": "Sample rate",
      "Value #C": "Noise in, worst axis",
      "Value #D": "Noise out, worst axis",
      "Value #E": "Missing",
      "Value #F": "Overload step",
      "Value #G": "Noise known from",
      "Value #H": "At rest",
    },
    sortBy: "State",
    overrides: [
      byName("State", { mappings: stateMappings, ...coloured }),
      byName("Sample rate", { unit: "hertz" }),
      byPattern("Noise (in|out).*", { unit: "rotdegs" }),
      byName("Missing", { unit: "cps", thresholds: thresholds(1), ...coloured }),
      byName("Overload step", { thresholds: thresholds(1, 2), ...coloured }),
      byName("Noise known from", {
        mappings: [{ type: "value", options: { 0: { text: "nothing" }, 1: { text: "IMF 1" }, 2: { text: "standstill" }, 3: { text: "calibration" } } }],
      }),
      byName("At rest", { mappings: [{ type: "value", options: { 0: { text: "no" }, 1: { text: "yes" } } }] }),
    ],
  }),
];

const inAndOut = [byPattern(".* in$", { color: fixed(kRaw) }), byPattern(".* out$", { color: fixed(kDenoised) })];
const noise = [
  chart({
    title: "Noise in and out",
    description: "Standard deviation of the input's white noise, and of the noise that is left in the output.",
    unit: "rotdegs",
    from: 0,
    height: 9,
    targets: [
      query(`deg(gyrod_axis_noise_floor_radians_per_second${sensor})`, `${axis} in`),
      query(`deg(gyrod_axis_output_noise_radians_per_second${sensor})`, `${axis} out`),
    ],
    overrides: inAndOut,
  }),
  chart({
    title: "Reduction",
    description: "20 log10(noise in / noise out).",
    unit: "dB",
    from: 0,
    height: 9,
    targets: [
      query(`20 * log10(gyrod_axis_noise_floor_radians_per_second${sensor} / gyrod_axis_output_noise_radians_per_second${sensor})`, axis),
    ],
  }),
  chart({
    title: "Noise against its week",
    description: "Median of the last ten minutes over the median of the last week. GyroNoiseUp tells above 1.5.",
    steps: thresholds(1.3, 1.5),
    targets: [query(`sensor_axis:gyrod_noise_floor:ratio1w${sensor}`, axis)],
  }),
  chart({
    title: "Bias at rest",
    unit: "rotdegs",
    targets: [query(`deg(gyrod_axis_bias_radians_per_second${sensor})`, axis)],
  }),
  chart({
    title: "Angle random walk (N)",
    description: "From the Allan deviation at rest, once it is observable.",
    unit: "suffix: °/√h",
    from: 0,
    targets: [query(`deg(gyrod_axis_angle_random_walk_radians_per_root_second${sensor}) * 60`, axis)],
  }),
  chart({
    title: "Bias instability (B)",
    description: "From the Allan deviation at rest, once it is observable: stops of many minutes.",
    unit: "suffix: °/h",
    from: 0,
    targets: [query(`deg(gyrod_axis_bias_instability_radians_per_second${sensor}) * 3600`, axis)],
  }),
  chart({
    title: "Normalised innovation",
    description: "Mean square of the model's prediction errors over what the model says of them. About 1 is right.",
    targets: [query(`gyrod_axis_normalised_innovation${sensor}`, axis)],
  }),
  chart({
    title: "Model does not fit",
    description: "1: the model does not explain the input, or the noise is not what it is believed to be. GyroModelMisfit tells after ten minutes.",
    from: 0,
    to: 1,
    targets: [query(`gyrod_axis_model_misfit${sensor}`, axis)],
  }),
  chart({
    title: "Strongest tone",
    description: "Periodic disturbance in the model: an engine, a fan. None is good.",
    unit: "hertz",
    targets: [query(`gyrod_axis_tone_hertz${sensor}`, axis)],
  }),
];

const losses = [
  chart({
    title: "Samples of each gyro",
    unit: "cps",
    from: 0,
    targets: [query(rate("gyrod_sensor_samples_received_total", sensor), "{{sensor}}")],
  }),
  chart({
    title: "Missing of each gyro",
    unit: "cps",
    from: 0,
    targets: [query(rate("gyrod_sensor_samples_missing_total", sensor), "{{sensor}}")],
  }),
  chart({
    title: "Refused, by reason",
    unit: "cps",
    stacked: true,
    from: 0,
    targets: [query(`sum by (reason) (${rate("gyrod_samples_rejected_total")})`, "{{reason}}")],
  }),
  chart({
    title: "Gaps, restarts, silences",
    description: "Events in an hour.",
    from: 0,
    targets: [
      query(`increase(gyrod_gaps_total${of}[1h])`, "gaps too long to bridge"),
      query(`increase(gyrod_restarts_total${of}[1h])`, "clocks or counters begun anew"),
      query(`increase(gyrod_silences_total${of}[1h])`, "silences"),
    ],
  }),
  chart({
    title: "Bus",
    from: 0,
    targets: [
      query(`gyrod_bus_matched_writers${of}`, "writers that send"),
      query(`sum by (topic) (gyrod_bus_matched_readers${of})`, "readers of {{topic}}"),
      query(`sum(gyrod_bus_incompatible_peers${of})`, "peers that do not match"),
      query(`increase(gyrod_bus_malformed_messages_total${of}[5m])`, "malformed messages in 5 min"),
      query(`increase(gyrod_bus_refusals_total${of}[5m])`, "refusals in 5 min"),
      query(`increase(gyrod_bus_write_errors_total${of}[5m])`, "write errors in 5 min"),
    ],
  }),
  chart({
    title: "Deadlines missed, liveliness lost",
    description: "Events in an hour, where deadlines or leases are configured.",
    from: 0,
    targets: [
      query(`increase(gyrod_bus_deadlines_missed_total${of}[1h])`, "deadlines missed"),
      query(`increase(gyrod_bus_liveliness_lost_total${of}[1h])`, "liveliness lost"),
    ],
  }),
];

const gyrodItself = [
  chart({
    title: "Samples in and out",
    unit: "cps",
    from: 0,
    targets: [
      query(`sum(${rate("gyrod_samples_received_total")})`, "samples in"),
      query(`sum(${rate("gyrod_samples_published_total")})`, "samples out"),
      query(`sum(${rate("gyrod_samples_passed_through_total")})`, "passed through undenoised"),
    ],
    overrides: inAndOut,
  }),
  chart({
    title: "Added latency",
    description: "What computing and waiting add to lag and hop.",
    unit: "s",
    from: 0,
    targets: [
      query(quantile(0.5, "gyrod_added_latency_seconds"), "p50"),
      query(quantile(0.99, "gyrod_added_latency_seconds"), "p99"),
    ],
  }),
  chart({
    title: "Time of a window",
    unit: "s",
    from: 0,
    targets: [
      query(quantile(0.5, "gyrod_window_duration_seconds"), "p50"),
      query(quantile(0.99, "gyrod_window_duration_seconds"), "p99"),
    ],
  }),
  chart({
    title: "Workers and queue",
    from: 0,
    targets: [
      query(`gyrod_workers${of}`, "workers"),
      query(`gyrod_workers_busy${of}`, "busy"),
      query(`gyrod_queued_windows${of}`, "windows that wait"),
    ],
  }),
  chart({
    title: "In flight",
    description: "Accepted and not released yet. Up to lag + hop samples a gyro is normal.",
    from: 0,
    targets: [query(`gyrod_samples_in_flight${of}`, "samples")],
  }),
  chart({
    title: "Overload",
    description: "Steps in an hour. 1: a hop widened. 2: a gyro's samples began to pass through.",
    from: 0,
    targets: [
      query(`increase(gyrod_hops_widened_total${of}[1h])`, "hops widened"),
      query(`increase(gyrod_overloads_total${of}[1h])`, "passed through"),
    ],
  }),
];

export const vehicle = dashboard({
  uid: "gyrod-vehicle",
  title: "gyrod: vehicle",
  description: "One vehicle: its gyros, its bus, and gyrod itself.",
  from: "now-1h",
  variables: [
    datasourceVariable,
    queryVariable("vehicle", "Vehicle", 'label_values(up{job="gyrod"}, vehicle)'),
    queryVariable("sensor", "Gyro", 'label_values(gyrod_sensor_health{vehicle="$vehicle"}, sensor)', { multi: true, includeAll: true, allValue: ".*" }),
    queryVariable("instance", "Address", 'label_values(up{job="gyrod",vehicle="$vehicle"}, instance)', { hide: 2 }),
  ],
  links: [
    link("Fleet", "/d/gyrod-fleet?var-datasource=${datasource}"),
    { ...link("Live page", "http://${instance}/"), targetBlank: true, tooltip: "gyrod's own page, where the vehicle can be reached from here" },
  ],
  rows: [
    ["At a glance", atAGlance],
    ["Health", health],
    ["Noise", noise],
    ["Losses and bus", losses],
    ["gyrod itself", gyrodItself],
  ],
});
