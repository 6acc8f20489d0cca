// A PNG of a page by headless Chromium's own command line:
//   node scripts/screenshot.mjs page.html out.png [--only FIGURE_ID[,ID]] [--width 1100] [--height 900] [--scale 1] [--wait MS]
// With --only the page shows that figure alone; then, without --height, the picture is cut to what is not white.
import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { trimPng } from "./trim_png.mjs";

const usage = "usage: node scripts/screenshot.mjs page.html out.png [--only ID] [--width W] [--height H] [--scale S] [--wait MS]";

function options(words) {
  const files = [];
  const named = {};
  for (let i = 0; i < words.length; ++i) {
    if (words[i].startsWith("--")) named[words[i].slice(2)] = words[++i];
    else files.push(words[i]);
  }
  return { files, named };
}

const { files, named } = options(process.argv.slice(2));
const [page, out] = files;
if (!page || !out || !existsSync(page)) {
  console.error(page && out ? `error: ${page}: no such file` : usage);
  process.exit(page && out ? 3 : 2);
}
const width = Number(named.width ?? 1100);
const height = Number(named.height ?? (named.only ? 4000 : 900));
const largest = 8192; // beyond, Chromium's software drawing repeats the picture
if (!(width > 0 && height > 0 && Math.max(width, height) * Number(named.scale ?? 1) <= largest)) {
  console.error(`error: a picture may be at most ${largest} pixels wide and high; take parts with --only`);
  process.exit(2);
}
const profile = mkdtempSync(join(tmpdir(), "bpms-chromium-"));
const url = pathToFileURL(resolve(page)).href + (named.only ? `#only=${named.only}` : "");
const browser = process.env.CHROMIUM ?? "chromium";
const result = spawnSync(
  browser,
  [
    "--headless=new", "--no-sandbox", "--disable-gpu-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--hide-scrollbars", "--allow-file-access-from-files",
    `--force-device-scale-factor=${named.scale ?? 1}`, `--user-data-dir=${profile}`, `--window-size=${width},${height}`,
    `--virtual-time-budget=${named.wait ?? 8000}`, `--screenshot=${resolve(out)}`, url,
  ],
  { encoding: "utf8", timeout: 180_000 },
); // prettier-ignore
rmSync(profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
if (result.error || result.status !== 0 || !existsSync(out)) {
  console.error(`error: ${browser}: ${result.error?.message ?? result.stderr.split("\n").slice(-4).join("\n")}`);
  process.exit(3);
}
if (named.only && !named.height) trimPng(resolve(out), 8);
