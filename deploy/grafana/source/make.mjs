// Writes the dashboards: node deploy/grafana/source/make.mjs [FOLDER]
import { writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { fleet } from "./fleet.mjs";
import { vehicle } from "./vehicle.mjs";

const folder = process.argv[2] ?? join(dirname(fileURLToPath(import.meta.url)), "..");
for (const [name, dashboard] of Object.entries({ fleet, vehicle })) {
  writeFileSync(join(folder, `${name}.json`), `${JSON.stringify(dashboard, null, 2)}\n`);
}
