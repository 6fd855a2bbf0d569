// The dashboards are what their source makes, and what Grafana's own types allow. GYROD_GRAFANA_NPM: folder with node_modules.
import { spawnSync } from "node:child_process";
import { copyFileSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import assert from "node:assert/strict";
import test, { after } from "node:test";

const here = dirname(fileURLToPath(import.meta.url));
const deployed = join(here, "../../deploy/grafana");
const modules = join(process.env.GYROD_GRAFANA_NPM, "node_modules");
const scratch = mkdtempSync(join(tmpdir(), "gyrod-dashboards-"));
after(() => rmSync(scratch, { recursive: true }));

const run = (...command) => spawnSync(process.execPath, command, { encoding: "utf8", cwd: scratch });
const text = (name) => readFileSync(join(deployed, name), "utf8");

symlinkSync(modules, join(scratch, "node_modules"));
copyFileSync(join(here, "dashboard.ts"), join(scratch, "dashboard.ts"));

/** What the compiler says of dashboards by name. */
function compile(dashboards) {
  const files = Object.entries(dashboards).map(([name, json]) => {
    writeFileSync(join(scratch, `${name}.ts`), `import type { OurDashboard } from "./dashboard";\nexport const dashboard: OurDashboard = ${json};\n`);
    return `${name}.ts`;
  });
  const options = ["--noEmit", "--strict", "--skipLibCheck", "--target", "es2022", "--module", "esnext", "--moduleResolution", "bundler"];
  return run(join(modules, "typescript/bin/tsc"), ...options, ...files);
}

test("the files are what their source makes", () => {
  const made = run(join(deployed, "source/make.mjs"), scratch);
  assert.equal(made.status, 0, made.stderr);
  for (const name of ["fleet.json", "vehicle.json"]) {
    assert.ok(readFileSync(join(scratch, name), "utf8") === text(name), `${name} is old: run node deploy/grafana/source/make.mjs`);
  }
});

test("Grafana's types allow them, and would not allow others", () => {
  const fleet = text("fleet.json");
  const wrong = {
    mode: fleet.replace('"mode": "absolute"', '"mode": "absolut"'),
    unknown: fleet.replace('"schemaVersion"', '"shemaVersion"'),
    option: fleet.replace('"graphMode": "none"', '"graphMode": "some"'),
    panel: fleet.replace('"type": "timeseries"', '"type": "timeserie"'),
    number: fleet.replace('"graphTooltip": 1', '"graphTooltip": 7'),
  };
  const { stdout } = compile({ fleet, vehicle: text("vehicle.json"), ...wrong });
  const refused = new Set(stdout.split("\n").filter((line) => line.includes("error")).map((line) => line.split(".ts(")[0]));
  assert.deepEqual([...refused].sort(), Object.keys(wrong).sort(), stdout);
});

test("panels do not lie on one another, and every variable that they name is there", () => {
  const builtIn = ["__rate_interval", "__url_time_range", "__data"];
  for (const name of ["fleet.json", "vehicle.json"]) {
    const dashboard = JSON.parse(text(name));
    const taken = new Set();
    for (const { title, gridPos } of dashboard.panels) {
      for (let x = gridPos.x; x < gridPos.x + gridPos.w; ++x) {
        for (let y = gridPos.y; y < gridPos.y + gridPos.h; ++y) {
          assert.ok(x < 24 && !taken.has(`${x},${y}`), `${name}: ${title} at ${x}, ${y}`);
          taken.add(`${x},${y}`);
        }
      }
    }
    const known = new Set([...builtIn, ...dashboard.templating.list.map((variable) => variable.name)]);
    for (const [, variable] of JSON.stringify(dashboard).matchAll(/\$\{?(\w+)/g)) {
      assert.ok(known.has(variable), `${name}: no variable ${variable}`);
    }
  }
});
