// Every expression that we ship: of the dashboards, with their variables filled in, and the series that a rule looks at.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { deployed } from "./rig.mjs";

/** Expressions of a dashboard's panels, variables and annotations, with `values` for its variables. */
export function dashboardExpressions(name, values) {
  const dashboard = JSON.parse(readFileSync(join(deployed, "grafana", name), "utf8"));
  const filled = (expr) => Object.entries(values).reduce((text, [variable, value]) => text.replaceAll(`$${variable}`, value), expr);
  const panels = dashboard.panels.flatMap(({ title, targets = [] }) => targets.map(({ expr }) => ({ where: `${name}, ${title}`, expr: filled(expr) })));
  const lists = dashboard.templating.list
    .filter(({ type }) => type === "query")
    .map((variable) => {
      // label_values(SELECTOR, LABEL) is Grafana's own.
      const [, selector, label] = filled(variable.query.query).match(/^label_values\((.*), (\w+)\)$/);
      return { where: `${name}, variable ${variable.name}`, expr: `count by (${label}) (${selector})` };
    });
  const marks = dashboard.annotations.list.map((mark) => ({ where: `${name}, ${mark.name}`, expr: filled(mark.expr), rare: true }));
  return [...panels, ...lists, ...marks];
}

/** Selectors in an expression: a name with a ':' or an '_', or up, and what may follow in braces. */
export const selectorsOf = (expr) => expr.match(/\b(?:(?:sensor_axis|vehicle):\w+(?::\w+)?|gyrod_\w+|process_start_time_seconds|up)\b(?:\{[^}]*\})?/g) ?? [];
