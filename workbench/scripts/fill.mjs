// Puts a JSON document into the template, as the binary does: node scripts/fill.mjs data.json out.html [template]
import { readFileSync, writeFileSync } from "node:fs";

export const token = "__BPMS_DATA__";

export function fill(template, document) {
  const parts = template.split(token);
  if (parts.length !== 2) throw new Error(`the template holds the token ${parts.length - 1} times instead of once`);
  return parts[0] + JSON.stringify(document).replace(/</g, "\\u003c") + parts[1];
}

const [data, out, template = "dist/report.html"] = process.argv.slice(2);
if (process.argv[1]?.endsWith("fill.mjs")) {
  if (!data || !out) {
    console.error("usage: node scripts/fill.mjs data.json out.html [template]");
    process.exit(2);
  }
  writeFileSync(out, fill(readFileSync(template, "utf8"), JSON.parse(readFileSync(data, "utf8"))));
}
