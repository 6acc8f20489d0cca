// A PNG of a viewer's page after some of its calls: node scripts/look.mjs page.html out.png WIDTHxHEIGHT ["setColour('length')" ...]
import { openPage } from "./browser.mjs";

const [file, out, size, ...calls] = process.argv.slice(2);
const [width, height] = (size ?? "").split("x").map(Number);
if (!file || !out || !(width > 0 && height > 0)) {
  console.error("usage: node scripts/look.mjs page.html out.png WIDTHxHEIGHT [CALL_OF_BPMSVIEWER ...]");
  process.exit(2);
}
const page = await openPage(file, { width, height });
for (const call of calls) await page.evaluate(`void window.bpmsViewer.${call}`);
await page.evaluate("window.bpmsViewer.frameMs(1)");
await page.screenshot(out);
for (const words of page.complaints) console.error(words);
await page.close();
process.exit(page.complaints.length > 0 ? 1 : 0);
