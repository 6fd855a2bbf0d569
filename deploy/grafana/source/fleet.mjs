// Monday morning: which of the fleet's gyros is degrading?
import { byName, chart, colourOf, coloured, dashboard, datasourceVariable, fixed, instant, kStates, link, linkTo, query, queryVariable, stat, stateMappings, table, thresholds } from "./parts.mjs";

const of = '{vehicle=~"$vehicle"}';
const toVehicle = linkTo("This vehicle", "/d/gyrod-vehicle?var-datasource=${datasource}&var-vehicle=${__data.fields.Vehicle}&${__url_time_range}");
const toSensor = linkTo(
  "This gyro",
  "/d/gyrod-vehicle?var-datasource=${datasource}&var-vehicle=${__data.fields.Vehicle}&var-sensor=${__data.fields.Gyro}&${__url_time_range}",
);
const troubled = `sum(gyrod_sensors_by_health{vehicle=~"$vehicle",state!~"ok|warming_up"})`;

const atAGlance = [
  stat({ title: "Vehicles that answer", targets: [query(`sum(up{job="gyrod",vehicle=~"$vehicle"})`)] }),
  stat({
    title: "Vehicles that do not",
    description: "Off, out of reach, or without gyrod.",
    targets: [query(`sum(1 - up{job="gyrod",vehicle=~"$vehicle"})`)],
    thresholds: thresholds(1),
  }),
  stat({ title: "Gyros", targets: [query(`sum(gyrod_sensors${of})`)] }),
  stat({
    title: "Troubled gyros",
    description: "In a state other than ok and warming_up.",
    targets: [query(troubled)],
    thresholds: thresholds(1),
  }),
  stat({ title: "Samples in", unit: "cps", targets: [query(`sum(rate(gyrod_samples_received_total${of}[$__rate_interval]))`)] }),
  stat({
    title: "Lost, worst vehicle",
    unit: "percentunit",
    decimals: 2,
    targets: [query(`max(vehicle:gyrod_samples_lost:ratio5m${of})`)],
    thresholds: thresholds(0.005, 0.01),
  }),
  stat({
    title: "Added latency p99, worst vehicle",
    unit: "s",
    targets: [query(`max(vehicle:gyrod_added_latency_seconds:p99_5m${of})`)],
    thresholds: thresholds(0.1, 1),
  }),
  stat({
    title: "Workers, busiest vehicle",
    unit: "percentunit",
    decimals: 0,
    targets: [query(`max(vehicle:gyrod_workers_busy:ratio5m${of})`)],
    thresholds: thresholds(0.7, 0.9),
  }),
];

const health = [
  chart({
    title: "Troubled gyros by state of health",
    stacked: true,
    from: 0,
    targets: [query('sum by (state) (gyrod_sensors_by_health{vehicle=~"$vehicle",state!="ok"})', "{{state}}")],
    overrides: kStates.map(({ name }) => byName(name, { color: fixed(colourOf(name)) })),
  }),
  chart({
    title: "Alerts that fire",
    stacked: true,
    from: 0,
    description: "Of deploy/prometheus/rules/alerts.yml. Empty is good.",
    targets: [query('count by (alertname) (ALERTS{alertstate="firing",alertname=~"Gyro.+",vehicle=~"$vehicle"}) or vector(0)', "{{alertname}}")],
  }),
  table({
    title: "Troubled gyros, the worst first",
    width: 24,
    targets: [instant(`gyrod_sensor_health${of} > 1`)],
    names: { vehicle: "Vehicle", sensor: "Gyro", Value: "State" },
    sortBy: "State",
    overrides: [
      byName("State", { mappings: stateMappings, ...coloured }),
      byName("Vehicle", toVehicle),
      byName("Gyro", toSensor),
    ],
  }),
];

const ageing = [
  chart({
    title: "Noise against its week: the twenty that rose most",
    description: "Median of the last ten minutes over the median of the last week. GyroNoiseUp tells above 1.5.",
    steps: thresholds(1.3, 1.5),
    targets: [query(`topk(20, sensor_axis:gyrod_noise_floor:ratio1w${of})`, "{{vehicle}} {{sensor}} {{axis}}")],
  }),
  table({
    title: "The same, now",
    width: 12,
    height: 8,
    targets: [instant(`topk(20, sensor_axis:gyrod_noise_floor:ratio1w${of})`)],
    names: { vehicle: "Vehicle", sensor: "Gyro", axis: "Axis", Value: "Noise against its week" },
    sortBy: "Noise against its week",
    overrides: [
      byName("Noise against its week", { decimals: 2, thresholds: thresholds(1.3, 1.5), ...coloured }),
      byName("Vehicle", toVehicle),
      byName("Gyro", toSensor),
    ],
  }),
  chart({
    title: "Noise of all gyros: median, 90 % and 99 % of the fleet",
    unit: "rotdegs",
    from: 0,
    targets: [0.5, 0.9, 0.99].map((share) =>
      query(`deg(quantile(${share}, gyrod_axis_noise_floor_radians_per_second${of}))`, `${100 * share} %`),
    ),
  }),
  chart({
    title: "Noise reduction of all gyros: median and the worst tenth",
    unit: "percentunit",
    from: 0,
    to: 1,
    targets: [
      query(`quantile(0.5, gyrod_axis_noise_reduction_ratio${of})`, "median"),
      query(`quantile(0.1, gyrod_axis_noise_reduction_ratio${of})`, "worst tenth"),
    ],
  }),
];

const perVehicle = (expr) => instant(expr.replaceAll("OF", of));
const vehicles = [
  table({
    title: "Vehicles",
    height: 12,
    targets: [
      perVehicle('max by (vehicle) (up{job="gyrod",vehicle=~"$vehicle"})'),
      perVehicle("sum by (vehicle) (gyrod_sensorsOF)"),
      perVehicle('sum by (vehicle) (gyrod_sensors_by_health{vehicle=~"$vehicle",state!~"ok|warming_up"})'),
      perVehicle("sum by (vehicle) (rate(gyrod_samples_received_totalOF[5m]))"),
      perVehicle("vehicle:gyrod_samples_lost:ratio5mOF"),
      perVehicle("vehicle:gyrod_added_latency_seconds:p99_5mOF"),
      perVehicle("vehicle:gyrod_workers_busy:ratio5mOF"),
      perVehicle("max by (vehicle) (gyrod_uptime_secondsOF)"),
      perVehicle("max by (vehicle, version) (gyrod_build_infoOF)"),
    ],
    hidden: ["Value #I"],
    names: {
      vehicle: "Vehicle",
      "Value #A": "Answers",
      "Value #B": "Gyros",
      "Value #C": "Troubled",
      "Value #D": "Samples in",
      "Value #E": "Lost",
      "Value #F": "Latency p99",
      "Value #G": "Workers",
      "Value #H": "Up for",
      version: "Version",
    },
    sortBy: "Troubled",
    overrides: [
      byName("Vehicle", toVehicle),
      byName("Answers", {
        mappings: [{ type: "value", options: { 0: { text: "no", color: colourOf("stuck"), index: 0 }, 1: { text: "yes", color: colourOf("ok"), index: 1 } } }],
        ...coloured,
      }),
      byName("Troubled", { thresholds: thresholds(1), ...coloured }),
      byName("Samples in", { unit: "cps" }),
      byName("Lost", { unit: "percentunit", decimals: 2, thresholds: thresholds(0.005, 0.01), ...coloured }),
      byName("Latency p99", { unit: "s", thresholds: thresholds(0.1, 1), ...coloured }),
      byName("Workers", { unit: "percentunit", decimals: 0, thresholds: thresholds(0.7, 0.9), ...coloured }),
      byName("Up for", { unit: "s" }),
    ],
  }),
];

export const fleet = dashboard({
  uid: "gyrod-fleet",
  title: "gyrod: fleet",
  description: "Health, noise and losses of all gyros of all vehicles.",
  from: "now-24h",
  variables: [
    datasourceVariable,
    queryVariable("vehicle", "Vehicle", 'label_values(up{job="gyrod"}, vehicle)', { multi: true, includeAll: true, allValue: ".*" }),
  ],
  links: [link("One vehicle", "/d/gyrod-vehicle?var-datasource=${datasource}")],
  rows: [
    ["At a glance", atAGlance],
    ["Health", health],
    ["Ageing", ageing],
    ["Vehicles", vehicles],
  ],
});
