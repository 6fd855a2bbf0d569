// What both dashboards are built of. Colours of the states are those of the live page in the dark, in shades where several have one.
export const kStates = [
  { name: "ok", colour: "#5cc98e" },
  { name: "warming_up", colour: "#62aaff" },
  { name: "degraded", colour: "#f7cf93" },
  { name: "lossy", colour: "#f0b45a" },
  { name: "drifting", colour: "#cf8d2c" },
  { name: "noisy", colour: "#ff8a7a" },
  { name: "saturated", colour: "#ef5f4c" },
  { name: "stuck", colour: "#c93a2a" },
  { name: "silent", colour: "#9aa6b8" },
];
export const kDenoised = "#62aaff";
export const kRaw = "#8490a2";
const kWarn = colourOf("lossy");
const kBad = colourOf("stuck");
const kDatasource = { type: "prometheus", uid: "${datasource}" };

export function colourOf(state) {
  return kStates.find(({ name }) => name === state).colour;
}

/** Words and colours in place of the numbers 0 to 8. */
export const stateMappings = [
  {
    type: "value",
    options: Object.fromEntries(kStates.map(({ name, colour }, index) => [index, { text: name, color: colour, index }])),
  },
];

const noThreshold = { mode: "absolute", steps: [{ color: colourOf("ok"), value: null }] };

/** Green below `warn`, then the colour of a warning, then, from `bad` on, that of trouble. */
export function thresholds(warn, bad) {
  const steps = [
    { color: colourOf("ok"), value: null },
    { color: kWarn, value: warn },
  ];
  if (bad !== undefined) steps.push({ color: kBad, value: bad });
  return { mode: "absolute", steps };
}

/** The other way about: trouble below `least`. */
export const atLeast = (least) => ({
  mode: "absolute",
  steps: [
    { color: kBad, value: null },
    { color: colourOf("ok"), value: least },
  ],
});

/** A query whose answer changes with time, or, with `instant`, is the newest. */
export const query = (expr, legendFormat = "", more = {}) => ({ datasource: kDatasource, expr, legendFormat, editorMode: "code", ...more });
export const instant = (expr, legendFormat) => query(expr, legendFormat, { instant: true, range: false, format: "table" });

export const override = (matcher, properties) => ({
  matcher,
  properties: Object.entries(properties).map(([id, value]) => ({ id, value })),
});
export const byName = (name, properties) => override({ id: "byName", options: name }, properties);
export const byPattern = (pattern, properties) => override({ id: "byRegexp", options: pattern }, properties);
export const fixed = (colour) => ({ mode: "fixed", fixedColor: colour });

const refIds = (targets) => targets.map((target, n) => ({ refId: String.fromCharCode(65 + n), ...target }));

function panel(type, { title, description, targets, width, height, options, defaults, overrides = [], transformations }) {
  return {
    type,
    title,
    description,
    datasource: kDatasource,
    gridPos: { x: 0, y: 0, w: width, h: height },
    targets: refIds(targets),
    ...(transformations && { transformations }),
    fieldConfig: { defaults, overrides },
    options,
  };
}

const reduceOptions = { calcs: ["lastNotNull"], fields: "", values: false };

export const stat = ({ unit = "short", decimals, mappings, thresholds: steps = noThreshold, text = "auto", width = 3, height = 4, ...rest }) =>
  panel("stat", {
    ...rest,
    width,
    height,
    defaults: { unit, decimals, mappings, thresholds: steps, color: { mode: "thresholds" }, noValue: "unknown" },
    options: {
      colorMode: "value",
      graphMode: "none",
      justifyMode: "auto",
      orientation: "auto",
      percentChangeColorMode: "standard",
      reduceOptions,
      showPercentChange: false,
      textMode: text,
      wideLayout: true,
    },
  });

export const chart = ({ unit = "short", stacked = false, from, to, steps, width = 12, height = 8, ...rest }) =>
  panel("timeseries", {
    ...rest,
    width,
    height,
    defaults: {
      unit,
      min: from,
      max: to,
      thresholds: steps ?? noThreshold,
      color: { mode: "palette-classic" },
      noValue: "unknown",
      custom: {
        drawStyle: "line",
        lineInterpolation: "linear",
        lineWidth: 1,
        fillOpacity: stacked ? 60 : 0,
        showPoints: "never",
        spanNulls: false,
        stacking: { mode: stacked ? "normal" : "none", group: "A" },
        thresholdsStyle: { mode: steps ? "dashed" : "off" },
      },
    },
    options: {
      legend: { displayMode: "list", placement: "bottom", showLegend: true, calcs: [] },
      tooltip: { mode: "multi", sort: "desc" },
    },
  });

export const timeline = ({ width = 24, height = 8, ...rest }) =>
  panel("state-timeline", {
    ...rest,
    width,
    height,
    defaults: {
      mappings: stateMappings,
      thresholds: noThreshold,
      color: { mode: "thresholds" },
      noValue: "unknown",
      custom: { fillOpacity: 80, lineWidth: 0 },
    },
    options: {
      alignValue: "left",
      legend: { displayMode: "list", placement: "bottom", showLegend: false, calcs: [] },
      mergeValues: true,
      rowHeight: 0.85,
      showValue: "auto",
      tooltip: { mode: "single", sort: "none" },
    },
  });

/** Several instant queries joined to one row for each set of labels. `names`: of the columns, in their order. */
export const table = ({ names, sortBy, hidden = [], width = 24, height = 9, ...rest }) =>
  panel("table", {
    ...rest,
    width,
    height,
    transformations: [
      { id: "merge", options: {} },
      {
        id: "organize",
        options: {
          excludeByName: Object.fromEntries(["Time", "__name__", "job", "instance", ...hidden].map((name) => [name, true])),
          indexByName: Object.fromEntries(Object.keys(names).map((name, n) => [name, n])),
          renameByName: names,
        },
      },
    ],
    defaults: {
      thresholds: noThreshold,
      color: { mode: "thresholds" },
      noValue: "unknown",
      custom: { align: "auto", cellOptions: { type: "auto" }, inspect: false },
    },
    options: { cellHeight: "sm", frameIndex: 0, showHeader: true, sortBy: [{ displayName: sortBy, desc: true }] },
  });

export const coloured = { "custom.cellOptions": { type: "color-text" } };
export const linkTo = (title, url) => ({ links: [{ title, url, targetBlank: false }] });

const variable = (name, label, more) => ({ name, label, hide: 0, skipUrlSync: false, ...more });

export const datasourceVariable = variable("datasource", "Data source", {
  type: "datasource",
  query: "prometheus",
  multi: false,
  includeAll: false,
  refresh: 1,
});

export const queryVariable = (name, label, expr, more = {}) =>
  variable(name, label, {
    type: "query",
    datasource: kDatasource,
    query: { query: expr, refId: "variable" },
    refresh: 2,
    sort: 7,
    multi: false,
    includeAll: false,
    ...more,
  });

export const link = (title, url) => ({
  title,
  url,
  type: "link",
  icon: "external link",
  tooltip: "",
  tags: [],
  asDropdown: false,
  includeVars: false,
  keepTime: true,
  targetBlank: false,
});

/** Rows of panels, [title, panels], laid out from the left to the right, 24 columns wide. */
function laidOut(rows) {
  const all = [];
  let y = 0;
  let id = 1;
  for (const [title, panels] of rows) {
    all.push({ type: "row", id: id++, title, collapsed: false, gridPos: { x: 0, y: y++, w: 24, h: 1 }, panels: [] });
    let x = 0;
    let tallest = 0;
    for (const one of panels) {
      if (x + one.gridPos.w > 24) {
        y += tallest;
        x = tallest = 0;
      }
      all.push({ id: id++, ...one, gridPos: { ...one.gridPos, x, y } });
      x += one.gridPos.w;
      tallest = Math.max(tallest, one.gridPos.h);
    }
    y += tallest;
  }
  return all;
}

export const dashboard = ({ uid, title, description, variables, links, rows, from }) => ({
  uid,
  title,
  description,
  tags: ["gyrod"],
  schemaVersion: 39,
  editable: true,
  graphTooltip: 1,
  refresh: "15s",
  time: { from, to: "now" },
  timezone: "browser",
  links,
  templating: { list: variables },
  annotations: {
    list: [
      {
        name: "Restarts of gyrod",
        datasource: kDatasource,
        enable: true,
        iconColor: colourOf("noisy"),
        expr: 'changes(process_start_time_seconds{job="gyrod",vehicle=~"$vehicle"}[$__rate_interval]) > 0',
        titleFormat: "gyrod of {{vehicle}} started",
      },
    ],
  },
  panels: laidOut(rows),
});
