// deploy/prometheus in a hurry: a minute of its rules takes a second, so that half an hour of faults takes half a minute. What is looked for and what it
// is compared with stay as they are. That the rules are right at their own pace too is proved by promtool (alerts_test.yml).
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { deployed } from "./rig.mjs";

export const kHaste = 60;
const kUnits_ms = { ms: 1, s: 1e3, m: 60e3, h: 3600e3, d: 86400e3 };

const shorter = (duration) => duration.replace(/(\d+)(ms|s|m|h|d)\b/g, (_, n, unit) => `${Math.round((n * kUnits_ms[unit]) / kHaste)}ms`);

/** Shorter: ranges in brackets and waiting times. A week stays: all that there is. */
export const hasty = (text) =>
  text.replace(/\[[^\]]*\]/g, shorter).replace(/^(.*\b(?:for|interval|scrape_interval|evaluation_interval): )(.*)$/gm, (_, key, rest) => key + shorter(rest));

/** Hasty copies of the rules in `folder`. */
export function writeHastyRules(folder) {
  mkdirSync(folder);
  const rules = join(deployed, "prometheus/rules");
  for (const name of readdirSync(rules)) {
    // An hour of history, as samples.
    const text = readFileSync(join(rules, name), "utf8").replace("> 240", "> 40");
    writeFileSync(join(folder, name), hasty(text));
  }
}
