// Headless Chromium driven through its DevTools protocol over a pipe (no network, no packages):
//   const page = await openPage("page.html", { width: 1200, height: 800 });
//   await page.evaluate("1 + 1");  page.complaints;  await page.screenshot("out.png");  await page.close();
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const browser = process.env.CHROMIUM ?? "chromium";

export function haveBrowser() {
  const asked = spawnSync(browser, ["--version"], { encoding: "utf8" });
  return !asked.error && asked.status === 0;
}

// Messages are JSON with a zero byte behind each, out on descriptor 3, back on 4.
class Pipe {
  constructor(child, heard) {
    this.out = child.stdio[3];
    this.waiting = new Map();
    this.last = 0;
    this.heard = heard;
    let rest = Buffer.alloc(0);
    child.stdio[4].on("data", (bytes) => {
      rest = Buffer.concat([rest, bytes]);
      for (let end = rest.indexOf(0); end >= 0; end = rest.indexOf(0)) {
        this.take(JSON.parse(rest.subarray(0, end).toString("utf8")));
        rest = rest.subarray(end + 1);
      }
    });
    child.on("exit", (code) => {
      for (const { reject } of this.waiting.values()) reject(new Error(`${browser} ended with ${code}`));
    });
    child.on("error", (error) => {
      for (const { reject } of this.waiting.values()) reject(error);
    });
  }
  take(message) {
    const asked = this.waiting.get(message.id);
    if (!asked) return this.heard(message);
    this.waiting.delete(message.id);
    if (message.error) asked.reject(new Error(`${asked.method}: ${message.error.message}`));
    else asked.resolve(message.result);
  }
  ask(method, params = {}, sessionId = undefined) {
    const id = ++this.last;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject, method });
      this.out.write(JSON.stringify({ id, method, params, ...(sessionId && { sessionId }) }) + "\0");
    });
  }
}

// What the page complains of: uncaught errors, console errors and warnings of three.js.
function complaint(message) {
  if (message.method === "Runtime.exceptionThrown")
    return message.params.exceptionDetails.exception?.description ?? message.params.exceptionDetails.text;
  if (message.method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(message.params.type))
    return message.params.args.map((a) => a.value ?? a.description).join(" ");
  if (message.method === "Log.entryAdded" && message.params.entry.level === "error") return message.params.entry.text;
  return null;
}

export async function openPage(file, { width = 1200, height = 800 } = {}) {
  const profile = mkdtempSync(join(tmpdir(), "bpms-chromium-"));
  const child = spawn(
    browser,
    [
      "--headless=new", "--no-sandbox", "--disable-gpu-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run", "--disable-background-networking",
      "--disable-component-update", "--disable-sync", "--hide-scrollbars", "--allow-file-access-from-files",
      `--user-data-dir=${profile}`, `--window-size=${width},${height}`, "--remote-debugging-pipe", "about:blank",
    ],
    { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] },
  ); // prettier-ignore
  const complaints = [];
  let loaded = () => undefined;
  const pipe = new Pipe(child, (message) => {
    const words = complaint(message);
    if (words !== null) complaints.push(words);
    if (message.method === "Page.loadEventFired") loaded();
  });
  const { targetInfos } = await pipe.ask("Target.getTargets");
  const { targetId } = targetInfos.find((t) => t.type === "page");
  const { sessionId } = await pipe.ask("Target.attachToTarget", { targetId, flatten: true });
  const ask = (method, params) => pipe.ask(method, params, sessionId);
  for (const domain of ["Page", "Runtime", "Log"]) await ask(`${domain}.enable`);
  await ask("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
  const done = new Promise((resolve) => (loaded = resolve));
  await ask("Page.navigate", { url: pathToFileURL(resolve(file)).href });
  await done;
  return {
    complaints,
    // The value of an expression, as JSON can say it; an error in the page is an error here.
    async evaluate(expression) {
      const { result, exceptionDetails } = await ask("Runtime.evaluate", { expression, returnByValue: true, awaitPromise: true });
      if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
      return result.value;
    },
    async click(x, y) {
      const at = { x, y, button: "left", clickCount: 1 };
      await ask("Input.dispatchMouseEvent", { type: "mousePressed", ...at });
      await ask("Input.dispatchMouseEvent", { type: "mouseReleased", ...at });
    },
    async screenshot(out) {
      const { data } = await ask("Page.captureScreenshot", { format: "png" });
      writeFileSync(out, Buffer.from(data, "base64"));
    },
    async close() {
      const ended = new Promise((resolve) => child.on("exit", resolve));
      await pipe.ask("Browser.close").catch(() => undefined);
      await ended;
      rmSync(profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
    },
  };
}
